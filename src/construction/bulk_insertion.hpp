// SPDX-License-Identifier: BSD-3-Clause
// Many points become vertices at once.
//
// What insertions share is settled before the first one: the grid, the frame, the affine dimension, and the
// id and the point of every vertex. Only duplicates are met on the way: the walk to a duplicate ends at its
// vertex, so finding them costs nothing.
#pragma once

#include "base/build_limits.hpp"
#include "construction/state.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace delone::construction {

/// Part of a transaction: state.record notes what changes.
class BulkInsertion {
 public:
  /// `order`: in which rows are to be inserted; `rounds`: where stretches of it end, each of which covers the
  /// whole set. `keeps_slots`: cells of the present engine keep their slots, so one thread inserts into it;
  /// those of a new engine may be sorted afterwards. `margin`: how far a new frame reaches beyond the rows,
  /// in its extents. `tick` is told how many rows have been inserted.
  BulkInsertion(State& state, std::vector<Index> order, std::vector<std::size_t> rounds, bool keeps_slots,
                double margin, internal::BuildLimits& limits, std::function<void(std::size_t)> tick);
  BulkInsertion(const BulkInsertion&) = delete;
  BulkInsertion& operator=(const BulkInsertion&) = delete;

  /// Copies the rows, of as many numbers as points have: that of order()[i] becomes the point of vertex
  /// first() + i. `rows` is not needed afterwards.
  void take(std::span<const double> rows);
  /// Makes all cells.
  void run();

  Index first() const { return first_; }
  /// The rows in the order of their vertices, without the repeating ones of duplicates().
  std::span<const Index> order() const { return order_; }
  /// For each of these, the vertex at its point, or invalid_index if it is hidden.
  std::span<const Index> at() const { return at_; }
  bool is_duplicate(std::size_t place) const {
    return at_[place] != first_ + place && at_[place] != invalid_index;
  }
  /// Pairs of a row that repeats another one and that one, if they were found before wrapping.
  std::span<const std::pair<Index, Index>> duplicates() const { return duplicates_; }
  /// How many threads have inserted rows.
  unsigned threads() const { return threads_; }

 private:
  void find_spanning(std::span<const double> rows);
  void find_box(unsigned threads);
  Index next_spanning();
  void start();
  void jump();
  void seed();
  bool wrap(std::span<const Index> simplex);
  std::vector<Index> merge_duplicates();
  void insert_at_only_vertex();
  void insert_rest();
  const double* point_at(std::size_t place) const {
    return state_.sites.point(first_ + static_cast<Index>(place));
  }

  State& state_;
  internal::BuildLimits& limits_;
  const bool keeps_slots_;
  const double margin_;
  std::vector<Index> order_;         // of rows, the places in which they are stored
  std::vector<std::size_t> rounds_;  // where rounds of the order end
  std::function<void(std::size_t)> tick_;
  Index first_;
  std::vector<double> low_, high_;  // the box of the rows
  std::size_t num_spanning_ = 0;    // at the first places, each raises the affine dimension
  std::size_t num_done_ = 0;        // places
  std::vector<Index> at_;
  std::vector<std::pair<Index, Index>> duplicates_;
  unsigned threads_ = 1;
};

}  // namespace delone::construction
