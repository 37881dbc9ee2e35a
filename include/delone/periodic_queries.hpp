// SPDX-License-Identifier: BSD-3-Clause
// Batches of queries to a periodic triangulation: in which cell, nearest to which point, and interpolation of
// values across the border of the box.
//
// Queries may be anywhere in R^d. A query is put on the grid of the points, or, if the set has a unit, on a
// grid that is finer than the unit. Answers are exact for the query on the grid, and move with it: a query
// translated by a lattice vector has the same answers with other offsets. In a direction that is not
// periodic, a query farther away than the grid reaches is rounded to 53 bits.
//
// All throw Errc::bad_dimension if the number of coordinates is no multiple of d, not_finite (rows() names
// the queries), invalid_argument for a query more than 2^29 periods away (rows() names it), too_many,
// out_of_memory, cancelled, and unsupported if offsets do not fit into 32 bits. Answers do not depend on
// Execution::threads.
#pragma once

#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/interpolation.hpp>
#include <delone/periodic.hpp>
#include <delone/point_locator.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace delone {

/// Arrays for the places of q queries, in their order. Each array has the size written beside it, or is empty
/// if it is not wanted.
struct PeriodicLocatedArrays {
  std::span<Location::Kind> kinds = {};  ///< q
  std::span<SignedIndex> cells = {};     ///< q, rows of cells(); −1 outside
  /// q×r: the cell translated by Σ offset_j · lattice vector j contains the query; 0 outside.
  std::span<std::int32_t> offsets = {};
  /// q×(k+1), as LocatedPoint::barycentric, in the order of the vertices of the cell; NaN outside
  std::span<double> barycentric = {};
};

/// The places of q queries, in their order.
struct DELONE_EXPORT_TYPE PeriodicLocatedPoints {
  std::vector<Location::Kind> kinds;  ///< q
  std::vector<SignedIndex> cells;     ///< q, rows of cells(); −1 outside
  std::vector<std::int32_t> offsets;  ///< q×r: of the cells; 0 outside
  /// The points that span the smallest face that contains query i: entries face_offsets[i] …
  /// face_offsets[i+1]−1 of face_rows, and their translations, r numbers each. Increasing by row and
  /// translation; none outside.
  std::vector<std::int64_t> face_offsets{0};
  std::vector<SignedIndex> face_rows;
  std::vector<std::int32_t> face_lattice;
};

/// Arrays for the points nearest to q queries; empty ones are not wanted.
struct PeriodicNearestArrays {
  std::span<SignedIndex> rows = {};  ///< q: rows of points(); −1 without points
  /// q×r: the nearest is the point of the row translated by Σ offset_j · lattice vector j.
  std::span<std::int32_t> offsets = {};
  /// q: |x − p|, the least of all translates; of weighted points the power |x − p|² − weight. NaN without
  /// points.
  std::span<double> distances = {};
};

/// Answers queries about a periodic triangulation, to which it refers. `const` members may be called from
/// several threads at once.
///
/// Method: the query's translate in the box is located among the points of the box and their images
/// (PointLocator). Where that cell is not known to be one of the periodic triangulation, translates are tried
/// at which the points of the cell are in the box. Cost: for many points as PointLocator, and a few µs for a
/// query on a face, at a vertex or near the border of the box; with few points all are near it.
class DELONE_EXPORT PeriodicPointLocator {
 public:
  /// O(cells), as it makes the arrays of the triangulation. Throws Errc::out_of_memory, cancelled.
  explicit PeriodicPointLocator(const PeriodicTriangulation& triangulation, const Execution& how = {});
  PeriodicPointLocator(PeriodicPointLocator&&) noexcept;
  PeriodicPointLocator& operator=(PeriodicPointLocator&&) noexcept;
  ~PeriodicPointLocator();

  /// Locates q queries (q×d coordinates), exactly. Of several cells that contain a query, the one of the
  /// smallest row is found, and of its translates the one of the lexicographically smallest offset. Also
  /// throws Errc::invalid_argument for arrays of other sizes.
  void locate(std::span<const double> queries, const PeriodicLocatedArrays& to,
              const Execution& how = {}) const;
  /// The same, with faces instead of coordinates.
  PeriodicLocatedPoints locate(std::span<const double> queries, const Execution& how = {}) const;

  /// Finds the nearest of all translates of all points (the minimum image), exactly; with weights the one of
  /// least power. Of several it is the one of the smallest row, and of its translates the one of the
  /// lexicographically smallest offset. The first call makes a table of all edges. Throws as locate().
  void nearest(std::span<const double> queries, const PeriodicNearestArrays& to,
               const Execution& how = {}) const;

  struct DELONE_HIDDEN Impl;

 private:
  friend class PeriodicLinearInterpolator;

  std::unique_ptr<const Impl> impl_;
};

/// The function that is linear in every cell of a periodic triangulation and has given values at its
/// vertices: periodic and continuous. At a vertex it has the given value exactly. Refers to the
/// triangulation.
class DELONE_EXPORT PeriodicLinearInterpolator {
 public:
  /// `values`: as for LinearInterpolator, one row for each point. Throws Errc::bad_dimension unless there are
  /// that many numbers, and as PeriodicPointLocator.
  PeriodicLinearInterpolator(const PeriodicTriangulation& triangulation, std::span<const double> values,
                             std::size_t columns = 1, const Execution& how = {});

  std::size_t columns() const { return columns_; }

  /// The values at q queries as q×columns numbers, as LinearInterpolator::evaluate(). Outside, where r < d,
  /// what the options say; Errc::unsupported for Outside::project and a tolerance.
  void evaluate(std::span<const double> queries, std::span<double> result,
                const EvaluateOptions& options = {}, const Execution& how = {}) const;
  /// The gradients, q×columns×d numbers, as LinearInterpolator::gradients().
  void gradients(std::span<const double> queries, std::span<double> result,
                 const EvaluateOptions& options = {}, const Execution& how = {}) const;

 private:
  const PeriodicTriangulation& triangulation_;
  PeriodicPointLocator locator_;
  std::size_t columns_;
  std::vector<double> values_;  // by row
};

/// The natural neighbors of q queries: entries starts[i] … starts[i+1]−1 of the other arrays are those of
/// query i, increasing by row and offset.
struct DELONE_EXPORT_TYPE PeriodicNaturalNeighbors {
  std::vector<std::int64_t> starts{0};
  std::vector<SignedIndex> rows;
  std::vector<std::int32_t> offsets;  ///< r for each: the translation of the point
  std::vector<double> weights;        ///< > 0; the sum for a query is 1 up to rounding
};

/// Sibson coordinates with respect to a periodic Delaunay triangulation: see NaturalNeighborCoordinates, also
/// for their accuracy. Refers to the triangulation.
///
/// Method: that of NaturalNeighborCoordinates, if the cells in conflict with the query have points in the
/// box. Otherwise these cells are collected across the border, and their points are triangulated, which takes
/// several times as long.
class DELONE_EXPORT PeriodicNaturalNeighborCoordinates {
 public:
  /// Computes the centers of all cells, d doubles each. Throws Errc::unsupported if points have weights, and
  /// as PeriodicPointLocator.
  explicit PeriodicNaturalNeighborCoordinates(const PeriodicTriangulation& triangulation,
                                              const Execution& how = {});
  PeriodicNaturalNeighborCoordinates(PeriodicNaturalNeighborCoordinates&&) noexcept;
  PeriodicNaturalNeighborCoordinates& operator=(PeriodicNaturalNeighborCoordinates&&) noexcept;
  ~PeriodicNaturalNeighborCoordinates();

  PeriodicNaturalNeighbors find(std::span<const double> queries, const Execution& how = {}) const;

  struct DELONE_HIDDEN Impl;

 private:
  friend class PeriodicNaturalNeighborInterpolator;

  std::unique_ptr<const Impl> impl_;
};

/// The sum of values times Sibson coordinates: see NaturalNeighborInterpolator without `smooth`. Refers to
/// the triangulation.
class DELONE_EXPORT PeriodicNaturalNeighborInterpolator {
 public:
  /// `values`: as for PeriodicLinearInterpolator. Throws as PeriodicNaturalNeighborCoordinates, and
  /// Errc::bad_dimension.
  PeriodicNaturalNeighborInterpolator(const PeriodicTriangulation& triangulation,
                                      std::span<const double> values, std::size_t columns = 1,
                                      const Execution& how = {});

  std::size_t columns() const { return columns_; }
  const PeriodicNaturalNeighborCoordinates& coordinates() const { return coordinates_; }

  /// The values at q queries as q×columns numbers. Throws as PeriodicLinearInterpolator::evaluate().
  void evaluate(std::span<const double> queries, std::span<double> result,
                const EvaluateOptions& options = {}, const Execution& how = {}) const;
  /// The gradients, q×columns×d numbers, as NaturalNeighborInterpolator::gradients(): at a point, where the
  /// function has none, one that is estimated from its neighbors. Throws as evaluate().
  void gradients(std::span<const double> queries, std::span<double> result,
                 const EvaluateOptions& options = {}, const Execution& how = {}) const;

 private:
  const PeriodicTriangulation& triangulation_;
  PeriodicNaturalNeighborCoordinates coordinates_;
  std::size_t columns_;
  std::vector<double> values_;
};

}  // namespace delone
