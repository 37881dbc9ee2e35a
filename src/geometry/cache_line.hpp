// SPDX-License-Identifier: BSD-3-Clause
// Arrays that are loaded into SIMD registers start at a cache line, so that no load straddles two.
#pragma once

#include <cstddef>
#include <cstdint>

namespace delone::geometry {

constexpr std::size_t cache_line = 64;

/// The number of entries by which memory must be larger than the array that at_cache_line() finds in it.
template <class T>
constexpr std::size_t cache_line_of = cache_line / sizeof(T);

/// The first address from here on that is the start of a cache line.
template <class T>
T* at_cache_line(T* from) {
  return reinterpret_cast<T*>((reinterpret_cast<std::uintptr_t>(from) + cache_line - 1) / cache_line *
                              cache_line);
}

}  // namespace delone::geometry
