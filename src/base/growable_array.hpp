// SPDX-License-Identifier: BSD-3-Clause
// A large array of trivial entries that grows without being copied: on Linux its pages are moved to a larger
// range of addresses; elsewhere it is reallocated.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#include <time.h>
#endif

namespace delone {

/// The size of the pages to ask the system for: large ones as long as they are not dear
/// (docs/decisions/0009-large-pages-while-they-are-cheap.md).
enum class Pages { usual, large };

/// Keeps account of what large pages cost more than as much memory in usual ones. An account for each array,
/// but what one has found out is known to all of the process for a while.
class PriceOfLargePages {
 public:
  /// Whether it is still low enough to go on, after what `large_pages` of them have cost. `now`: seconds of
  /// any clock.
  bool pay(double seconds, std::size_t large_pages, double now) {
    debt_ = std::max(debt_ + seconds - usual_price * static_cast<double>(large_pages), 0.0);
    if (debt_ <= most_debt) return true;
    found_dear_at_.store(now, std::memory_order_relaxed);
    return false;
  }
  /// Whether no array has found them dear of late.
  static bool are_worth_trying(double now) {
    return now - found_dear_at_.load(std::memory_order_relaxed) > for_a_while;
  }

 private:
  static constexpr double usual_price = 600e-6, most_debt = 3e-3, for_a_while = 1;  // seconds
  inline static std::atomic<double> found_dear_at_ = -std::numeric_limits<double>::infinity();
  double debt_ = 0;
};

/// Entries beyond those ever written are unspecified. Memory that was never touched costs nothing on Linux.
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
  ~GrowableArray() { release(); }

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
    const std::size_t bytes = rounded_up(size * sizeof(T));
#ifdef __linux__
    if (bytes >= mapped_from) {
      void* moved;
      if (is_mapped()) {
        moved = mremap(entries_, rounded_up(capacity_ * sizeof(T)), bytes, MREMAP_MAYMOVE);
        if (moved == MAP_FAILED) throw std::bad_alloc();
      } else {
        moved = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (moved == MAP_FAILED) throw std::bad_alloc();
        std::copy(entries_, entries_ + capacity_, static_cast<T*>(moved));
        std::free(entries_);
      }
      if (pages_ == Pages::large) madvise(moved, bytes, MADV_HUGEPAGE);  // a wish: failure is no error
      entries_ = static_cast<T*>(moved);
      prepared_ = std::min(prepared_, capacity_);
      capacity_ = bytes / sizeof(T);
      return;
    }
#endif
    void* moved = std::realloc(entries_, bytes);
    if (moved == nullptr) throw std::bad_alloc();
    entries_ = static_cast<T*>(moved);
    capacity_ = bytes / sizeof(T);
  }

  /// Says that the entries before `size`, of which there is room for, will soon have been written. Pages that
  /// were never touched are fetched many at a time: one by one, each costs the processor an exception.
  void prepare(std::size_t size) {
    if (size > prepared_) [[unlikely]]
      populate(size);
  }

  /// Says that the entries first … last − 1 are not needed any more: they are unspecified from then on.
  /// Memory is given back to the system in whole pages, each when the whole of it was in one range.
  void discard([[maybe_unused]] std::size_t first, [[maybe_unused]] std::size_t last) {
#ifdef __linux__
    if (!is_mapped()) return;
    const std::size_t begin = (first * sizeof(T) + small_page - 1) / small_page * small_page,
                      end = last * sizeof(T) / small_page * small_page;
    if (begin < end) madvise(reinterpret_cast<char*>(entries_) + begin, end - begin, MADV_DONTNEED);
#endif
  }

 private:
  /// From this size on, memory is mapped; smaller arrays come from the heap.
  static constexpr std::size_t mapped_from = std::size_t{1} << 20;
  static constexpr std::size_t large_page = std::size_t{2} << 20;
  static constexpr std::size_t small_page = std::size_t{64} << 10;  // of any machine
  /// What is populated at a time.
  std::size_t portion() const { return pages_ == Pages::large ? large_page : std::size_t{256} << 10; }

  static std::size_t rounded_up(std::size_t bytes) {
    // Mapped ranges are whole large pages, and a multiple of the entry's size where that matters: the rest is
    // left unused.
    return bytes < mapped_from ? bytes : (bytes + large_page - 1) / large_page * large_page;
  }
  [[gnu::noinline]] void populate([[maybe_unused]] std::size_t size) {
    [[maybe_unused]] const std::size_t prepared =
        std::exchange(prepared_, capacity_);  // also where it cannot be done
#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
    if (!is_mapped()) return;
    if (pages_ == Pages::large && !PriceOfLargePages::are_worth_trying(seconds_of(CLOCK_MONOTONIC)))
      avoid_large_pages();
    const std::size_t begin = prepared * sizeof(T) / portion() * portion();
    const std::size_t end =
        std::min((size * sizeof(T) / portion() + 1) * portion(), rounded_up(capacity_ * sizeof(T)));
    const double start = seconds_of(CLOCK_THREAD_CPUTIME_ID);
    if (madvise(reinterpret_cast<char*>(entries_) + begin, end - begin, MADV_POPULATE_WRITE) == 0)
      prepared_ = end / sizeof(T);
    if (pages_ == Pages::usual) return;
    const double price = seconds_of(CLOCK_THREAD_CPUTIME_ID) - start;
    if (!price_.pay(price, (end - begin) / large_page, seconds_of(CLOCK_MONOTONIC))) avoid_large_pages();
#endif
  }
#ifdef __linux__
  static double seconds_of(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }
  /// For pages to come.
  void avoid_large_pages() {
    pages_ = Pages::usual;
    madvise(entries_, rounded_up(capacity_ * sizeof(T)), MADV_NOHUGEPAGE);
  }
#endif
  void release() {
#ifdef __linux__
    if (is_mapped()) {
      munmap(entries_, rounded_up(capacity_ * sizeof(T)));
      return;
    }
#endif
    std::free(entries_);
  }
  bool is_mapped() const { return rounded_up(capacity_ * sizeof(T)) >= mapped_from; }

  T* entries_ = nullptr;
  std::size_t capacity_ = 0;
  std::size_t prepared_ = 0;
  Pages pages_;
  PriceOfLargePages price_;
};

}  // namespace delone
