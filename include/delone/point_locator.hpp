// SPDX-License-Identifier: BSD-3-Clause
// Many questions to one triangulation: in which cell, with which barycentric coordinates, next to which
// vertex.
#pragma once

#include <delone/export.hpp>
#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace delone {

/// How queries are located.
///
/// With a tolerance τ > 0, the answer for a query x is that of a point x' with |x − x'| ≤ τ:
///   1. If x is a vertex, x' = x.
///   2. If a cell whose least height exceeds τ (a thick one) lies within τ of x, x' is the nearest point of
///      all these cells; of several at the same distance that whose face comes first, by its rows in increasing
///      order.
///   3. Otherwise, if x is in the convex hull, x' = x.
///   4. Otherwise, if x is within τ of the hull, x' is the nearest point of the hull.
///   5. Otherwise x is outside.
/// The least height of a cell is the least distance of a vertex from the affine hull of the others. Distances
/// are those of R^d: flat input has queries within τ of its flat, too. So a sliver that rounding of the
/// points has made, of a height below τ, answers only where nothing else is near. Which cells are thick, and
/// whether one is within τ, is decided exactly. x' is exact up to rounding; see LocatedPoint.
///
/// Method: best-first search over the cells that meet the ball of radius τ, with certified bounds, and exact
/// fractions where these do not decide; Wolfe's algorithm (1976, doi:10.1007/BF01580381) in each cell. Cost:
/// nothing but one look at a mark for a query in a thick cell; otherwise it depends on the cells in the ball.
struct LocateOptions {
  /// τ ≥ 0, a distance in the units of the coordinates, at most the longest side of the bounding box of the
  /// vertices unless that is 0. 0: exact location.
  double tolerance = 0;
  /// Give queries outside, at any distance, the nearest point of the convex hull. The descent to it visits
  /// O(1) cells for a query near the hull, and may visit O(n^(1/k)) otherwise.
  bool project = false;
  /// Whether LocatedPoint::barycentric is wanted. If not, it only tells which coordinates are positive: for
  /// queries in slivers this saves exact arithmetic.
  bool coordinates = true;
  /// At most so many threads; 0: as many as there are cores for this process (affinity mask, quota of the
  /// container), where the batch is large enough to gain by them. The answers do not depend on it. With other
  /// values than 1 the callbacks are called from several threads at once, once for each query as before.
  unsigned threads = 1;
};

/// Where a query x lies (exactly), and its barycentric coordinates (rounded). With a tolerance, or if x is
/// projected, this is said of the point x' of LocateOptions instead.
struct LocatedPoint {
  Location::Kind kind = Location::Kind::outside_affine_hull;
  /// A finite cell that contains the query; outside the hull the infinite cell of a hull facet that has the
  /// query strictly beyond it; invalid_cell outside the affine hull.
  CellId cell = invalid_cell;
  /// k+1 numbers ≥ 0 with sum 1, up to rounding: the query is the sum of the vertices of the cell times
  /// these. None is off by more than 2⁻³⁶, whatever the shape of the cell; mostly it is a few units of 2⁻⁵³.
  /// A number is 0 exactly if the facet opposite that vertex contains the query: the vertices with positive
  /// numbers span the smallest face that contains it. Empty outside. Valid during the call that it is passed
  /// to.
  std::span<const double> barycentric;
  /// An upper bound on the distance |x − x'|, where x' is the point with these coordinates; at most the
  /// tolerance, unless x is projected. 0 if x' = x.
  double distance = 0;
};

/// Answers queries about a triangulation, which it refers to: valid until the next insertion or edit. `const`
/// members may be called from several threads at once. A batch is visited along a Hilbert curve, in stretches
/// each of whose walks starts where the one before ended; answers are given with the number of their query.
/// Which stretches threads share depends on the batch alone, and so do the cells that answer for queries on
/// faces of several. `threads` of the members below is that of LocateOptions.
///
/// Method: the visibility walk with signs of orientations. For k = d ≤ 6 all of a cell come from one table of
/// minors with a certified bound, those that it cannot tell from exact arithmetic. Cost: for a batch as dense
/// as the vertices O(1) cells per query, and O(q log q) comparisons.
class DELONE_EXPORT PointLocator {
 public:
  using Visit = std::function<void(std::size_t query, const LocatedPoint& where)>;

  explicit PointLocator(const Triangulation& triangulation);
  PointLocator(PointLocator&&) noexcept;
  PointLocator& operator=(PointLocator&&) noexcept;
  ~PointLocator();

  /// Locates q queries (q×d coordinates) and calls `visit` once for each, in no particular order. What
  /// `visit` throws ends the batch and is passed on: of several exceptions in several threads the one that
  /// one thread would have met. Throws bad_dimension, not_finite (rows() names the
  /// queries), out_of_memory.
  void locate(std::span<const double> queries, const Visit& visit) const;
  /// The same with a tolerance. Throws invalid_argument for one that is negative, NaN, infinite or larger
  /// than the set of points. Which cells are thick is kept, for the tolerance used last: a byte per cell.
  void locate(std::span<const double> queries, const LocateOptions& options, const Visit& visit) const;

  /// For each of q queries, calls `visit` for the finite cells within `radius` of it, roughly the nearest
  /// first, until it returns false. All cells within the radius are visited, and maybe some that are farther
  /// by a rounding. REQUIRES a finite radius ≥ 0. Method and errors: as locate() with a tolerance.
  void cells_within(std::span<const double> queries, double radius,
                    const std::function<bool(std::size_t query, CellId cell)>& visit,
                    unsigned threads = 1) const;

  /// For each of q queries the vertex of least distance; of a regular triangulation, of least power |x − p|²
  /// − weight: the site whose region of the diagram contains the query. Exact; of several the one with the
  /// first input row. invalid_vertex if there is no vertex. `visit` as for locate(). The first call makes a
  /// table of all edges, O(cells·k). Throws as locate(), and unsupported for a furthest-site triangulation.
  void nearest(std::span<const double> queries,
               const std::function<void(std::size_t query, VertexId nearest)>& visit,
               unsigned threads = 1) const;

  /// The k nearest vertices of each query, or all if there are fewer, nearest first; of equally near ones
  /// those with smaller first rows first. Exact. By power for a regular triangulation, and else as above.
  /// Valid during the call that they are passed to. Method: best-first search over edges, O(k·e·log(k·e))
  /// per query for e edges at a vertex. Throws as above, and invalid_argument for k = 0.
  void nearest(std::span<const double> queries, std::size_t k,
               const std::function<void(std::size_t query, std::span<const VertexId> nearest)>& visit,
               unsigned threads = 1) const;

  /// The vertices joined to each vertex by an edge, the infinite vertex excluded, increasing: those of v are
  /// entries offsets[v] … offsets[v+1]−1 of `vertices`; for v up to num_vertex_slots(). Made on first use,
  /// O(cells·k).
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
  void each_nearest(std::span<const double> queries, unsigned threads, Each each) const;

  std::unique_ptr<Impl> impl_;
};

/// The sign of |q − a|² − weight_a − (|q − b|² − weight_b), exactly: negative if q is nearer to a. All
/// finite, as many coordinates of each. Stages: binary64 with a certified bound, then integers. O(d).
DELONE_EXPORT Sign compare_distances(std::span<const double> q, std::span<const double> a,
                                     std::span<const double> b, double weight_a = 0, double weight_b = 0);

}  // namespace delone
