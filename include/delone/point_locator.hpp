// SPDX-License-Identifier: BSD-3-Clause
// Batches of queries to one triangulation: in which cell, with which barycentric coordinates, nearest to
// which vertex.
#pragma once

#include <delone/cell_numbers.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace delone {

/// What location means for a query.
///
/// With a tolerance τ > 0, the answer for a query x is that of a point x' with |x − x'| ≤ τ:
///   1. If x is a vertex, x' = x.
///   2. If a cell whose least height exceeds τ (a thick one) lies within τ of x, x' is the nearest point of
///      all these cells; of several at the same distance the one whose face comes first, by
///      its rows in increasing order.
///   3. Otherwise, if x is in the convex hull, x' = x.
///   4. Otherwise, if x is within τ of the hull, x' is the nearest point of the hull.
///   5. Otherwise x is outside.
/// The least height of a cell is the least distance of a vertex from the affine hull of the others. Distances
/// are those of R^d: flat input has queries within τ of its flat, too. So a sliver of a height below τ, which
/// rounding of the points has made, answers only if nothing else is near. Which cells are thick, and whether
/// one is within τ, is decided exactly. x' is exact up to rounding; see LocatedPoint.
///
/// Method: best-first search over the cells that meet the ball of radius τ, with certified bounds, and exact
/// fractions if these do not decide; Wolfe's algorithm (1976, doi:10.1007/BF01580381) in each cell. Cost:
/// O(1) for a query in a thick cell; otherwise it depends on the cells in the ball.
struct LocateOptions {
  /// τ ≥ 0, a distance in the units of the coordinates, at most the longest side of the bounding box of the
  /// vertices unless that is 0. 0: exact location.
  double tolerance = 0;
  /// Answer queries outside, at any distance, for the nearest point of the convex hull. The descent to it
  /// visits O(1) cells for a query near the hull, and may visit O(n^(1/k)) otherwise.
  bool project = false;
  /// Whether LocatedPoint::barycentric is needed. If not, only the sign of its numbers is meaningful, which
  /// saves exact arithmetic for queries in slivers.
  bool coordinates = true;
};

/// Where a query x lies (exactly), and its barycentric coordinates (rounded). With a tolerance, or if x is
/// projected, the answer is about the point x' of LocateOptions instead.
struct LocatedPoint {
  Location::Kind kind = Location::Kind::outside_affine_hull;
  /// A finite cell that contains the query; outside the hull the infinite cell of a hull facet that has the
  /// query strictly beyond it; invalid_cell outside the affine hull.
  CellId cell = invalid_cell;
  /// k+1 numbers ≥ 0 with sum 1, up to rounding: the query is the sum of the vertices of the cell times
  /// these. None is off by more than 2⁻³⁶, whatever the shape of the cell; mostly it is a few units of 2⁻⁵³.
  /// A number is 0 exactly if the facet opposite that vertex contains the query: the vertices with positive
  /// numbers span the smallest face that contains it. Empty outside. Valid during the call to which it is
  /// passed.
  std::span<const double> barycentric;
  /// An upper bound on the distance |x − x'|, where x' is the point with these coordinates; at most the
  /// tolerance, unless x is projected. 0 if x' = x.
  double distance = 0;
};

/// Arrays for the answers to q queries, in the order of the queries. Each has the size that is written beside
/// it, or is empty: then it is not wanted.
struct LocatedArrays {
  std::span<Location::Kind> kinds = {};  ///< q: LocatedPoint::kind
  /// q: the row of the cell by the numbers that are given; −1 outside.
  std::span<SignedIndex> cells = {};
  std::span<double> barycentric = {};  ///< q×(k+1): LocatedPoint::barycentric; NaN outside
  std::span<double> distances = {};    ///< q: LocatedPoint::distance
};

/// The places of q queries, in their order.
struct DELONE_EXPORT_TYPE LocatedPoints {
  std::vector<Location::Kind> kinds;  ///< q
  std::vector<SignedIndex> cells;     ///< q, rows of cells; −1 outside
  /// The input rows that span the smallest face that contains query i, increasing: entries face_offsets[i] …
  /// face_offsets[i+1]−1 of face_rows. None outside.
  std::vector<std::int64_t> face_offsets{0};
  std::vector<SignedIndex> face_rows;
};

/// Answers queries about a triangulation, to which it refers: valid until the next insertion or edit. `const`
/// members may be called from several threads at once. A batch is visited along a Hilbert curve in stretches,
/// in which each walk starts where the one before ended; answers come with the number of their query. The
/// stretches depend on the batch alone, and so does the choice of a cell for queries on a face of several
/// cells. Answers do not depend on Execution::threads. With other values than 1 several threads call the
/// callbacks at once, still once for each query.
///
/// Method: the visibility walk with signs of orientations. For k = d ≤ 6 all signs for one cell come from one
/// table of minors with a certified bound, and from exact arithmetic if it does not suffice. Cost: for a
/// batch as dense as the vertices O(1) cells per query, and O(q log q) comparisons.
class DELONE_EXPORT PointLocator {
 public:
  using Visit = std::function<void(std::size_t query, const LocatedPoint& where)>;

  explicit PointLocator(const Triangulation& triangulation);
  PointLocator(PointLocator&&) noexcept;
  PointLocator& operator=(PointLocator&&) noexcept;
  ~PointLocator();

  /// Locates q queries (q×d coordinates) and calls `visit` once for each, in no particular order. An
  /// exception from `visit` ends the batch and is passed on; of several exceptions in several threads it is
  /// the one that a single thread would have met. Throws Errc::bad_dimension, not_finite (rows() names the
  /// queries), too_many, out_of_memory, cancelled.
  template <std::invocable<std::size_t, const LocatedPoint&> F>
  void locate(std::span<const double> queries, F&& visit, const Execution& how = {}) const {
    locate(queries, LocateOptions{}, Visit(std::forward<F>(visit)), how);
  }
  /// The same with a tolerance. Also throws Errc::invalid_argument for a tolerance that is negative, NaN,
  /// infinite or larger than the set of points. Keeps a table of thick cells for the last tolerance: a byte
  /// per cell.
  void locate(std::span<const double> queries, const LocateOptions& options, const Visit& visit,
              const Execution& how = {}) const;

  /// The same as arrays; `numbers` are those of the cells. If no barycentric coordinates are wanted, none are
  /// computed. Also throws Errc::invalid_argument for arrays of other sizes.
  void locate(std::span<const double> queries, const LocateOptions& options, const CellNumbers& numbers,
              const LocatedArrays& to, const Execution& how = {}) const;
  /// The same, with faces instead of coordinates.
  LocatedPoints locate(std::span<const double> queries, const LocateOptions& options,
                       const CellNumbers& numbers, const Execution& how = {}) const;

  /// For each of q queries, calls `visit` for the finite cells within `radius` of it, roughly the nearest
  /// first, until it returns false. All cells within the radius are visited, and maybe some that are farther
  /// by a rounding error. Method and errors as for locate() with a tolerance; Errc::invalid_argument unless
  /// the radius is finite and ≥ 0.
  void cells_within(std::span<const double> queries, double radius,
                    const std::function<bool(std::size_t query, CellId cell)>& visit,
                    const Execution& how = {}) const;

  /// For each of q queries the vertex of least distance; of a regular triangulation, of least power |x − p|²
  /// − weight: the site whose region of the diagram contains the query. Exact; of several the one with the
  /// first input row; invalid_vertex if there are no vertices. `visit` as for locate(). The first call makes
  /// a table of all edges, O(cells·k). Throws as locate(), and Errc::unsupported for a furthest-site
  /// triangulation.
  void nearest(std::span<const double> queries,
               const std::function<void(std::size_t query, VertexId nearest)>& visit,
               const Execution& how = {}) const;

  /// The k nearest vertices of each query, or all if there are fewer, nearest first; of equally near ones
  /// those with smaller first rows first. Exact. By power for a regular triangulation, otherwise as above.
  /// The list is valid during the call to which it is passed. Method: best-first search over edges,
  /// O(k·e·log(k·e)) per query for e edges at a vertex. Throws as above, and Errc::invalid_argument for k =
  /// 0.
  void nearest(std::span<const double> queries, std::size_t k,
               const std::function<void(std::size_t query, std::span<const VertexId> nearest)>& visit,
               const Execution& how = {}) const;

  /// The vertices joined to each vertex by an edge, the infinite vertex excluded, increasing: those of v are
  /// entries offsets[v] … offsets[v+1]−1 of `vertices`; for v < num_vertex_slots(). Made on first use,
  /// O(cells·k); throws Errc::out_of_memory.
  struct Edges {
    std::vector<std::size_t> offsets;
    std::vector<VertexId> vertices;
  };
  const Edges& edges() const;

  struct DELONE_HIDDEN Impl;

 private:
  friend class LinearInterpolator;
  friend class NaturalNeighborCoordinates;

  template <class Each>
  void each_nearest(std::span<const double> queries, const Execution& how, Each each) const;

  std::unique_ptr<Impl> impl_;
};

/// The sign of |q − a|² − weight_a − (|q − b|² − weight_b), exactly: negative if q is nearer to a. Binary64
/// with a certified bound decides, otherwise integers. O(d). Throws Errc::bad_dimension unless q, a and b
/// have equally many coordinates, and not_finite.
DELONE_EXPORT Sign compare_distances(std::span<const double> q, std::span<const double> a,
                                     std::span<const double> b, double weight_a = 0, double weight_b = 0);

}  // namespace delone
