// SPDX-License-Identifier: BSD-3-Clause
// Arrays that are loaded into the processor's vectors start at a line of the cache, so that no load straddles
// two.
#pragma once

#include <cstddef>
#include <cstdint>

namespace delone::geometry {

constexpr std::size_t cache_line = 64;

/// So many entries are to spare in memory that at_cache_line() is asked about.
template <class T>
constexpr std::size_t cache_line_of = cache_line / sizeof(T);

/// The first entry from here on that is at the start of a line.
template <class T>
T* at_cache_line(T* from) {
  return reinterpret_cast<T*>((reinterpret_cast<std::uintptr_t>(from) + cache_line - 1) / cache_line *
                              cache_line);
}

}  // namespace delone::geometry
