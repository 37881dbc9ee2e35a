// SPDX-License-Identifier: BSD-3-Clause
// Natural neighbors of queries, their coordinates, and interpolation with them.
#pragma once

#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/interpolation.hpp>
#include <delone/point_locator.hpp>
#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace delone {

/// The natural neighbors of a query and its Sibson coordinates. Valid during the call that they are passed
/// to.
struct NaturalNeighbors {
  Location::Kind kind = Location::Kind::outside_affine_hull;
  /// The point whose neighbors these are, d numbers: the query, or x' of the options of find().
  std::span<const double> point;
  /// The vertices with positive coordinates: one if the point is a vertex, none outside the hull.
  std::span<const VertexId> vertices;
  /// Their coordinates, > 0 with sum 1 up to rounding. Sum of the vertices times these: the point.
  std::span<const double> weights;
  /// The gradients of the coordinates, d numbers for each vertex, if find() computes them. On the boundary of
  /// the hull and in flat input: tangent to the smallest face of the hull that contains the query. Empty at a
  /// vertex, where they do not exist.
  std::span<const double> gradients;
};

/// Sibson coordinates with respect to a Delaunay triangulation, in any dimension. Insert the query: the
/// fraction of its new Voronoi region that belonged to a vertex before is its coordinate with respect to that
/// vertex: Sibson, "A vector identity for the Dirichlet tessellation", doi:10.1017/S0305004100056589. The
/// coordinates are continuous in the hull, and smooth except at the vertices and on the spheres of cells. On
/// a face of the hull they are those of the vertices within the face, the limit of those of points nearby.
///
/// None is off by more than 2⁻³⁶ in up to 3 dimensions and 2⁻³⁰ in more (of the flat of the points), whatever
/// the shape of cells; mostly by a few units of 2⁻⁵³. So the sum of vertices times weights is off, on each
/// axis, by at most that times Σ |p − q| over the natural neighbors. Nothing depends on how ties between
/// cospherical points are broken, up to this error.
///
/// Method: the centers of the cells that an insertion of the query would replace and create, without
/// inserting; volumes by exterior products with a certified bound, and integers if it does not suffice. Cost
/// per query: O(f) with the number f of faces of these cells, some 100 in the plane, 1000 in space. That is
/// some thirty times the time of a linear interpolation in the plane, a hundred times in space, and each
/// further dimension takes more than ten times as long. On the boundary of the hull a query takes two to four
/// times as long as inside, and in flat input (k < d) four to ten times as long as in R^k.
///
/// Refers to the triangulation: valid until the next insertion or edit. `const` members may be called from
/// several threads at once.
class DELONE_EXPORT NaturalNeighborCoordinates {
 public:
  /// Computes the centers of all finite cells, d doubles each. Throws Errc::unsupported unless the
  /// triangulation is a Delaunay<D>, out_of_memory, and cancelled.
  explicit NaturalNeighborCoordinates(const Triangulation& triangulation, const Execution& how = {});
  NaturalNeighborCoordinates(NaturalNeighborCoordinates&&) noexcept;
  NaturalNeighborCoordinates& operator=(NaturalNeighborCoordinates&&) noexcept;
  ~NaturalNeighborCoordinates();

  using Visit = std::function<void(std::size_t query, const NaturalNeighbors& found)>;
  /// Finds the neighbors of q queries (q×d coordinates) and calls `visit` once for each, in no particular
  /// order. What `visit` throws ends the batch and is passed on. Throws as PointLocator::locate().
  void find(std::span<const double> queries, const Visit& visit, bool with_gradients = false,
            const Execution& how = {}) const;
  /// The same at the points x' of LocateOptions. Where x' = x the coordinates are those of x, also beside
  /// slivers: at a depth under the border like the height of a sliver there, points at its far ends may be
  /// natural neighbors, and gradients across the border are huge. Elsewhere x' is on the boundary of a cell,
  /// and is rounded to a point in the hull: the nearest possible one without a tolerance; with one, 2⁻³⁰ of
  /// the way from x' to the centroid of the cell, or less to stay within the tolerance up to rounding, so
  /// that slivers across the border have no influence. If rounding leaves the hull nevertheless, as in tilted
  /// flats, the coordinates are the barycentric ones of x' in its cell.
  void find(std::span<const double> queries, const LocateOptions& options, const Visit& visit,
            bool with_gradients = false, const Execution& how = {}) const;

  struct DELONE_HIDDEN Impl;

 private:
  friend class NaturalNeighborInterpolator;
  /// Each thread that works has its own visitor.
  void find_by_threads(std::span<const double> queries, const LocateOptions& options,
                       const std::function<Visit()>& make_visit, bool with_gradients, unsigned threads) const;

  std::unique_ptr<Impl> impl_;
};

/// Natural neighbor interpolation of values at scattered points, in any dimension. At a vertex it has the
/// given value.
///
/// Without `smooth`: the sum of values times Sibson coordinates. Continuous, exact for linear functions up to
/// rounding, and continuously differentiable except at the vertices; nowhere above the largest or below the
/// least value of the natural neighbors.
///
/// With `smooth`: the interpolant of Sibson, "A brief description of natural neighbour interpolation" (in V.
/// Barnett, Interpreting Multivariate Data, 1981), which also has given or estimated gradients at the
/// vertices, and is continuously differentiable there, too. Exact for quadratic functions a + b·x + c·|x|² if
/// the gradients are. The gradient at a vertex inside the hull is estimated by least squares over its
/// neighbors with the weights λ/r², where r is the distance and λ the coordinate of the vertex with respect
/// to the other vertices, as Sibson does, so it is exact for these functions. For a vertex on the boundary of
/// the hull, which has no such coordinates, the weights are 1/r⁴, and it is exact for linear ones; likewise
/// for one just inside, whose neighbors in some direction have weights of less than 2⁻²⁰ of the largest.
/// Cost: a small triangulation of the neighbors of each vertex.
class DELONE_EXPORT NaturalNeighborInterpolator {
 public:
  /// `values`: as for LinearInterpolator. `site_gradients`: n×columns×d numbers, one row for each input row,
  /// or none: then gradients are estimated when they are needed, in the constructor if `smooth`. Throws
  /// Errc::bad_dimension unless there are that many numbers, cancelled, and as NaturalNeighborCoordinates.
  NaturalNeighborInterpolator(const Triangulation& triangulation, std::span<const double> values,
                              std::size_t columns = 1, bool smooth = false,
                              std::span<const double> site_gradients = {}, const Execution& how = {});

  std::size_t columns() const { return columns_; }
  bool is_smooth() const { return smooth_; }
  const NaturalNeighborCoordinates& coordinates() const { return coordinates_; }

  /// The values at q queries (q×d coordinates) as q×columns numbers. Throws as
  /// LinearInterpolator::evaluate(). With a tolerance, or projected, the values are those at the point that
  /// NaturalNeighborCoordinates::find() uses for the query.
  void evaluate(std::span<const double> queries, std::span<double> result,
                const EvaluateOptions& options = {}, const Execution& how = {}) const;
  /// The gradients at q queries, q×columns×d numbers. At a vertex: the given or estimated gradient there,
  /// which is that of the interpolant if it is smooth. On the boundary of the hull only the part along the
  /// smallest face that contains the query is that of the interpolant. Outside as LinearInterpolator. Throws
  /// as evaluate().
  void gradients(std::span<const double> queries, std::span<double> result,
                 const EvaluateOptions& options = {}, const Execution& how = {}) const;
  /// The given or estimated gradient at a finite vertex, columns×d numbers. Throws Errc::bad_dimension for a
  /// result of another size, and as Triangulation::point().
  void site_gradient(VertexId v, std::span<double> result) const;

 private:
  const Triangulation& triangulation_;
  NaturalNeighborCoordinates coordinates_;
  std::size_t columns_;
  bool smooth_;
  std::vector<double> values_;          // by vertex id
  std::vector<double> site_gradients_;  // by vertex id; empty if estimated one by one
};

}  // namespace delone
