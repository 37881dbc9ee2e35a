// SPDX-License-Identifier: BSD-3-Clause
// Consecutive numbers for several workers: each takes those of a stretch of its own, one after the other, and
// when it has none left, the back half of the longest stretch of another.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::engine {

class WorkRanges {
 public:
  explicit WorkRanges(unsigned workers) : ranges_(workers) {}

  /// Cuts begin … end − 1 into stretches of equal length. REQUIRES that nobody takes numbers meanwhile.
  void assign(std::size_t begin, std::size_t end) {
    offset_ = begin;
    const std::size_t n = end - begin, parts = ranges_.size();
    for (std::size_t w = 0; w < parts; ++w) ranges_[w].bounds = packed(n * w / parts, n * (w + 1) / parts);
  }

  /// The next number for a worker. Returns whether there is one.
  bool next(unsigned worker, std::size_t& number) {
    do {
      std::uint64_t bounds = ranges_[worker].bounds.load(std::memory_order_relaxed);
      while (begin(bounds) < end(bounds)) {
        if (!ranges_[worker].bounds.compare_exchange_weak(bounds, packed(begin(bounds) + 1, end(bounds)),
                                                          std::memory_order_relaxed))
          continue;
        number = offset_ + begin(bounds);
        return true;
      }
    } while (steal(worker));
    return false;
  }

 private:
  struct alignas(128) Range {
    std::atomic<std::uint64_t> bounds = 0;  // both relative to offset_, in 32 bits each
  };
  static std::uint64_t packed(std::size_t begin, std::size_t end) {
    return static_cast<std::uint64_t>(begin) << 32 | static_cast<std::uint64_t>(end);
  }
  static std::size_t begin(std::uint64_t bounds) { return static_cast<std::size_t>(bounds >> 32); }
  static std::size_t end(std::uint64_t bounds) { return static_cast<std::size_t>(bounds & 0xffffffff); }

  /// Moves the back half of the longest stretch to the worker, which has none. Returns whether there is one.
  bool steal(unsigned worker) {
    for (;;) {
      std::size_t longest = 0, from = 0;
      for (std::size_t w = 0; w < ranges_.size(); ++w) {
        const std::uint64_t bounds = ranges_[w].bounds.load(std::memory_order_relaxed);
        if (begin(bounds) < end(bounds) && end(bounds) - begin(bounds) > longest) {
          longest = end(bounds) - begin(bounds);
          from = w;
        }
      }
      if (longest == 0) return false;
      std::uint64_t bounds = ranges_[from].bounds.load(std::memory_order_relaxed);
      if (begin(bounds) >= end(bounds)) continue;
      const std::size_t middle = begin(bounds) + (end(bounds) - begin(bounds)) / 2;
      if (!ranges_[from].bounds.compare_exchange_strong(bounds, packed(begin(bounds), middle),
                                                        std::memory_order_relaxed))
        continue;
      ranges_[worker].bounds.store(packed(middle, end(bounds)), std::memory_order_relaxed);
      return true;
    }
  }

  std::vector<Range> ranges_;
  std::size_t offset_ = 0;
};

}  // namespace delone::engine
