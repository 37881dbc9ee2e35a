// SPDX-License-Identifier: BSD-3-Clause
// Vectors of many megabytes that are written from one end to the other.
#pragma once

#include "base/platform.hpp"

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace delone::internal {

/// Fetches the pages of a range that is about to be written: large ones as long as they are cheap. REQUIRES
/// memory that can be mapped, and whole large pages.
void fetch_pages(char* begin, std::size_t bytes);

/// Makes room for `size` entries, and fetches the pages, as arrays of cells do
/// (docs/decisions/0009-large-pages-while-they-are-cheap.md): for vectors that are about to be filled. Throws
/// std::bad_alloc.
template <class T>
void reserve_large(std::vector<T>& items, std::size_t size) {
  if (size <= items.capacity()) return;
  items.reserve(size);
  if constexpr (platform::maps_memory) {
    constexpr std::size_t page = platform::large_page;
    const auto begin = reinterpret_cast<std::uintptr_t>(items.data() + items.size());
    const auto end = reinterpret_cast<std::uintptr_t>(items.data() + items.capacity());
    const std::uintptr_t first = (begin + page - 1) / page * page, last = end / page * page;
    if (last > first + 4 * page) fetch_pages(reinterpret_cast<char*>(first), last - first);
  }
}

/// Gives back most of the memory that entries took that are not there any more.
template <class T>
void shrink_large(std::vector<T>& items) noexcept {
  if (items.capacity() <= 2 * items.size() + 4096) return;
  try {
    items.shrink_to_fit();
  } catch (const std::bad_alloc&) {  // it stays
  }
}

/// The same as reserve_large(), and new entries are zeros.
template <class T>
void resize_large(std::vector<T>& items, std::size_t size) {
  reserve_large(items, size);
  items.resize(size);
}

}  // namespace delone::internal
