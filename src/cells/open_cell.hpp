// SPDX-License-Identifier: BSD-3-Clause
// A cell with open facets, beyond which geometry/ searches while engine/ wraps a set of points.
#pragma once

#include <delone/types.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace delone::cells {

struct OpenCell {
  const Index* vertices;
  std::uint32_t open_slots;  ///< bit i: the facet opposite vertex i is open
};

/// How many vertices may be compared exactly in searches that several threads share. Whether that is exceeded
/// in the end does not depend on timing.
class ComparisonLimit {
 public:
  void reset(std::size_t most) {
    most_ = most;
    count_.store(0, std::memory_order_relaxed);
  }
  /// Counts some more; false if these are too many.
  bool allows(std::size_t more) { return count_.fetch_add(more, std::memory_order_relaxed) + more <= most_; }
  std::size_t count() const { return count_.load(std::memory_order_relaxed); }

 private:
  std::size_t most_ = std::numeric_limits<std::size_t>::max();
  std::atomic<std::size_t> count_ = 0;
};

}  // namespace delone::cells
