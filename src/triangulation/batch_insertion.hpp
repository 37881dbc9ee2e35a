// SPDX-License-Identifier: BSD-3-Clause
// A batch of rows into a triangulation, all of them or none.
//
// What insertions share is settled before the first one: the grid, the frame, the affine dimension, and the
// id and the point of every vertex. Only duplicates are met on the way: the walk to a duplicate ends at its
// vertex, so finding them costs nothing. If there are any, vertices are renumbered in the end, so that ids
// have no gaps.
#pragma once

#include "base/build_limits.hpp"
#include "base/progress_meter.hpp"
#include "triangulation/triangulation_impl.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace delone {

class Triangulation::Impl::BatchInsertion {
 public:
  /// `order`: in which rows are to be inserted; `rounds`: where its rounds end that cover the whole set.
  /// `limits` hears if cells are made in another way than by inserting points.
  BatchInsertion(Impl& impl, std::vector<Index> order, std::vector<std::size_t> rounds,
                 internal::BuildLimits& limits);
  /// Unless all rows have been inserted, everything is as it was.
  ~BatchInsertion();
  BatchInsertion(const BatchInsertion&) = delete;
  BatchInsertion& operator=(const BatchInsertion&) = delete;

  /// Stores the rows: coordinates, and weights where points have weights. They are not needed any more after
  /// it.
  void take(std::span<const double> rows);
  void insert_all();

 private:
  /// What the batch changes, as it was.
  struct Before {
    kernel::AffineHull affine_hull;
    std::size_t num_coordinates, num_rows, num_row_of_vertex, num_rows_inserted;
    Index only_vertex;
    bool had_engine, had_ids_of_threads;
    std::unique_ptr<TriangulationEngine> engine;  ///< if the batch has made another one
  };

  void include(std::span<const double> rows);
  void spanning_rows_first(std::span<const double> rows);
  void start();
  void jump();
  void seed();
  bool wrap(std::span<const Index> simplex);
  std::vector<Index> merge_duplicates();
  void insert_at_only_vertex(std::span<Index> at);
  void insert(std::span<Index> at);
  void place_in_order(std::span<const Index> at);
  Index next_spanning();
  void finish();

  std::size_t row(std::size_t place) const { return before_.num_rows + order_[place]; }
  const double* point_at(std::size_t place) const;

  Impl& impl_;
  internal::BuildLimits& limits_;
  Before before_;
  std::vector<Index> order_;         // of rows, the places in which they are stored
  std::vector<std::size_t> rounds_;  // where rounds of the order end
  std::vector<double> low_, high_;   // the box of the rows
  std::size_t num_spanning_ = 0;     // at the first places, each raises the affine dimension
  std::size_t place_ = 0;            // of the first row that is not inserted yet
  std::vector<std::pair<Index, Index>>
      duplicates_;  // of rows, found beforehand, and the rows that they repeat
  internal::ProgressMeter progress_;
  unsigned threads_ = 1;
  bool is_done_ = false;
};

}  // namespace delone
