// SPDX-License-Identifier: BSD-3-Clause
// Exact furthest-site Delaunay triangulations in any dimension: built from a range of points, or point by
// point.
#pragma once

#include <delone/delaunay.hpp>

#include <array>
#include <cstddef>
#include <ranges>
#include <span>
#include <vector>

namespace delone {

/// The furthest-site Delaunay triangulation of points in R^d, d chosen at run time: the cells whose spheres
/// have no point outside; the upper boundary of the convex hull of the points (x, |x|²), seen from above. It
/// is the dual of the diagram that assigns to each point of space the site furthest from it.
///
/// Its cells tile the convex hull of the points, and its vertices are the extreme points. All others are
/// *hidden*: points inside the hull, and those within its facets and edges. A point that is hidden stays so;
/// a vertex may become hidden by later insertions: its id is not used again, and the ids of vertices then
/// have gaps (Complex::finite_vertices()).
///
/// Exact for all finite doubles. Ties are perturbed as in Triangulation, with lifts −|x|² in place of |x|²,
/// so that the result is a function of the set of points. Input that spans only a k-flat is triangulated
/// inside its flat, duplicates are merged. For the notion see Aurenhammer, "Voronoi diagrams — a survey of a
/// fundamental geometric data structure", doi:10.1145/116873.116880. Cost: as for the convex hull of the
/// points, and a walk for each hidden point.
///
/// The members of Triangulation are those of the vertices that are left; in_sphere() is the side of the
/// sphere as ever, and a cell is in conflict with points *outside* its sphere. Of to_data(), `check` is to be
/// told CheckOptions::furthest_site.
class FurthestSiteTriangulation : public Triangulation {
 public:
  /// The triangulation of no points. Throws Errc::bad_dimension unless dimension ≥ 1.
  explicit FurthestSiteTriangulation(int dimension, const Options& options = {});
  /// The triangulation of n×d coordinates, row-major. Throws as insert_range().
  FurthestSiteTriangulation(std::span<const double> coordinates, int dimension, const Options& options = {});
  FurthestSiteTriangulation(PointsView points, const Options& options = {});

  /// Whether the point of an input row, row < num_rows(), is hidden: not extreme. O(1).
  bool is_hidden(std::size_t row) const;
  /// How many rows are hidden: num_points() = num_vertices() + num_duplicates() + num_hidden(). O(rows).
  std::size_t num_hidden() const;
  /// The rows that are hidden, increasing. O(rows).
  std::vector<std::size_t> hidden_rows() const;
};

/// The furthest-site Delaunay triangulation of points in R^D. Compiled for D = 1…8; larger D uses the
/// run-time-dimension engine.
template <int D>
class FurthestSite : public FurthestSiteTriangulation {
  static_assert(D >= 1, "the dimension of the space is at least 1");

 public:
  using Point = std::array<double, D>;

  explicit FurthestSite(const Options& options = {}) : FurthestSiteTriangulation(D, options) {}
  /// From any contiguous range of points of D doubles each, or of doubles (D per point).
  template <std::ranges::contiguous_range Range>
  requires std::ranges::sized_range<Range> &&
      (!std::same_as<std::remove_cvref_t<Range>, FurthestSite>)explicit FurthestSite(
          const Range& points, const Options& options = {})
      : FurthestSiteTriangulation(detail::as_coordinates<D>(points), D, options) {}

  template <std::ranges::contiguous_range Range>
  requires std::ranges::sized_range<Range>
  void insert_range(const Range& points) { Triangulation::insert_range(detail::as_coordinates<D>(points)); }
};

}  // namespace delone
