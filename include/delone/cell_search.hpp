// SPDX-License-Identifier: BSD-3-Clause
// Which cells contain a point, among any cells: those of another program, of a mesh with gaps and overlaps.
#pragma once

#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/point_locator.hpp>
#include <delone/points.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

namespace delone {

/// Searches simplices of full dimension d that need not fit together: they may overlap, leave gaps, and have
/// either orientation. A flat cell contains no query. PointLocator is for triangulations that delone has
/// made.
///
/// Exact: a query is in a cell if no orientation says otherwise. Method: a tree of bounding boxes, and d+1
/// orientations for each cell whose box contains the query. `const` members may be called from several
/// threads at once.
class DELONE_EXPORT CellSearch {
 public:
  /// Called once for each query, in no particular order, with cells in increasing order; valid during the
  /// call.
  using Visit = std::function<void(std::size_t query, std::span<const SignedIndex> cells)>;

  /// Of m cells of d+1 rows each. Refers to both arguments, which must outlive it. Throws
  /// Errc::invalid_argument (a row that does not exist, naming the cell; a number of rows that is not a
  /// multiple of d+1), not_finite (a point of a cell), out_of_memory, cancelled. O(m·log m).
  CellSearch(PointsView points, std::span<const SignedIndex> cells);
  CellSearch(CellSearch&&) noexcept;
  CellSearch& operator=(CellSearch&&) noexcept;
  ~CellSearch();

  std::size_t num_cells() const;
  /// The flat cells, increasing.
  std::span<const SignedIndex> flat_cells() const;

  /// The cells that contain each of q queries (q×d coordinates), their borders included. With a radius r ≥ 0
  /// the cells within r of it, and maybe some that are farther by a rounding error. Throws
  /// Errc::bad_dimension, not_finite (rows() names the queries), invalid_argument (the radius),
  /// out_of_memory, cancelled.
  void find(std::span<const double> queries, double radius, const Visit& visit,
            const Execution& how = {}) const;

  /// The first cell that contains each query, with the meaning that arrays have for PointLocator::locate();
  /// Location::Kind::outside_hull stands for queries in no cell. All distances are 0. Throws as find();
  /// invalid_argument for arrays of other sizes.
  void locate(std::span<const double> queries, const LocatedArrays& to, const Execution& how = {}) const;

 private:
  struct DELONE_HIDDEN Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace delone
