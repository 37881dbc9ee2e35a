// SPDX-License-Identifier: BSD-3-Clause
// A large array of trivial entries that grows without being copied: where memory can be mapped, its pages are
// moved to a larger range of addresses; elsewhere it is reallocated.
#pragma once

#include "base/platform.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <utility>

namespace delone::internal {

/// Entries that were never written are unspecified. Where memory can be mapped, they take up no memory.
template <class T>
class GrowableArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit GrowableArray(Pages pages = Pages::usual) : pages_(pages) {}
  GrowableArray(GrowableArray&& other) noexcept
      : entries_(std::exchange(other.entries_, nullptr)),
        capacity_(std::exchange(other.capacity_, 0)),
        prepared_(std::exchange(other.prepared_, 0)),
        pages_(other.pages_),
        price_(other.price_) {}
  GrowableArray& operator=(GrowableArray&& other) noexcept {
    std::swap(entries_, other.entries_);
    std::swap(capacity_, other.capacity_);
    std::swap(prepared_, other.prepared_);
    std::swap(pages_, other.pages_);
    std::swap(price_, other.price_);
    return *this;
  }
  ~GrowableArray() {
    if (is_mapped())
      platform::unmap(entries_, bytes());
    else
      std::free(entries_);
  }

  T* data() { return entries_; }
  const T* data() const { return entries_; }
  T& operator[](std::size_t i) { return entries_[i]; }
  const T& operator[](std::size_t i) const { return entries_[i]; }
  std::size_t capacity() const { return capacity_; }

  /// Makes room for at least `size` entries, keeping the present ones. Throws std::bad_alloc, and then
  /// changes nothing.
  void reserve(std::size_t size) {
    if (size <= capacity_) return;
    if (size > static_cast<std::size_t>(-1) / 4 / sizeof(T)) throw std::bad_alloc();
    const std::size_t new_bytes = rounded_up(size * sizeof(T));
    void* moved = nullptr;
    if (!platform::maps_memory || new_bytes < mapped_from) {
      moved = std::realloc(entries_, new_bytes);
      if (moved == nullptr) throw std::bad_alloc();
    } else {
      moved = is_mapped() ? platform::remap(entries_, bytes(), new_bytes) : platform::map(new_bytes);
      if (moved == nullptr) throw std::bad_alloc();
      if (!is_mapped()) {
        std::copy(entries_, entries_ + capacity_, static_cast<T*>(moved));
        std::free(entries_);
      }
      if (pages_ == Pages::large) platform::use_large_pages(moved, new_bytes, true);
      prepared_ = std::min(prepared_, capacity_);
    }
    entries_ = static_cast<T*>(moved);
    capacity_ = new_bytes / sizeof(T);
  }

  /// Gives back memory beyond the first `size` entries, and keeps those. Small arrays stay as they are.
  void shrink(std::size_t size) noexcept {
    if (bytes() < mapped_from || size >= capacity_) return;
    const std::size_t new_bytes = rounded_up(std::max(size * sizeof(T), mapped_from));
    if (new_bytes >= bytes()) return;
    void* const moved =
        is_mapped() ? platform::remap(entries_, bytes(), new_bytes) : std::realloc(entries_, new_bytes);
    if (moved == nullptr) return;
    entries_ = static_cast<T*>(moved);
    capacity_ = new_bytes / sizeof(T);
    prepared_ = std::min(prepared_, capacity_);
  }

  /// Says that the entries before `size`, for which there is room, will soon be written. Pages that were
  /// never touched are fetched many at a time, as a page fault for each would be slower.
  void prepare(std::size_t size) {
    if (size > prepared_) [[unlikely]]
      populate(size);
  }

  /// Says that the entries first … last − 1 are not needed any more: they are unspecified from then on. A
  /// page is given back to the system when the whole of it is in one such range.
  void discard(std::size_t first, std::size_t last) {
    if (!is_mapped()) return;
    constexpr std::size_t page = platform::usual_page;
    const std::size_t begin = (first * sizeof(T) + page - 1) / page * page;
    const std::size_t end = last * sizeof(T) / page * page;
    if (begin < end) platform::discard(reinterpret_cast<char*>(entries_) + begin, end - begin);
  }

 private:
  /// Memory of this size or more is mapped, in multiples of large pages; smaller arrays come from the heap.
  static constexpr std::size_t mapped_from = std::size_t{1} << 20;

  static std::size_t rounded_up(std::size_t bytes) {
    constexpr std::size_t page = platform::large_page;
    return bytes < mapped_from ? bytes : (bytes + page - 1) / page * page;
  }
  /// What has been allocated: the last bytes are not used if entries do not fill them.
  std::size_t bytes() const { return rounded_up(capacity_ * sizeof(T)); }
  bool is_mapped() const { return platform::maps_memory && bytes() >= mapped_from; }

  [[gnu::noinline]] void populate(std::size_t size) {
    const std::size_t prepared = std::exchange(prepared_, capacity_);  // also where pages cannot be fetched
    if (!is_mapped()) return;
    if (pages_ == Pages::large && !PriceOfLargePages::are_worth_trying(platform::clock_seconds()))
      avoid_large_pages();
    // The unit in which pages are fetched.
    const std::size_t portion = pages_ == Pages::large ? platform::large_page : std::size_t{256} << 10;
    const std::size_t begin = prepared * sizeof(T) / portion * portion;
    const std::size_t end = std::min((size * sizeof(T) / portion + 1) * portion, bytes());
    const double start = platform::thread_seconds();
    if (platform::populate(reinterpret_cast<char*>(entries_) + begin, end - begin))
      prepared_ = end / sizeof(T);
    if (pages_ == Pages::usual) return;
    const double seconds = platform::thread_seconds() - start;
    if (!price_.pay(seconds, (end - begin) / platform::large_page, platform::clock_seconds()))
      avoid_large_pages();
  }
  /// For pages that are not there yet.
  void avoid_large_pages() {
    pages_ = Pages::usual;
    platform::use_large_pages(entries_, bytes(), false);
  }

  T* entries_ = nullptr;
  std::size_t capacity_ = 0;
  std::size_t prepared_ = 0;
  Pages pages_;
  PriceOfLargePages price_;
};

}  // namespace delone::internal
