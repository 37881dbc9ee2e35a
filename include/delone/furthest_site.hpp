// SPDX-License-Identifier: BSD-3-Clause
// Exact furthest-site Delaunay triangulations in any dimension: built from a range of points, or point by
// point.
#pragma once

#include <delone/triangulation.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace delone {

/// The furthest-site Delaunay triangulation of points in R^D (of R^d, d an argument of the
/// constructor, for D = dynamic): the cells whose spheres
/// have no point outside; the upper boundary of the convex hull of the points (x, |x|²), seen from above. It
/// is the dual of the diagram that assigns to each point of space the site furthest from it.
///
/// Its cells tile the convex hull of the points, and its vertices are the extreme points. All others are
/// *hidden*: points inside the hull, and those within its facets and edges. Edits may make them vertices, and
/// vertices hidden; insertions may hide vertices. Both keep their ids.
///
/// Exact for all finite doubles. Ties are perturbed as in Triangulation, with lifts −|x|² in place of |x|²,
/// so that the result is a function of the set of points. Input that spans only a k-flat is triangulated
/// inside its flat, duplicates are merged. For the notion see Aurenhammer, "Voronoi diagrams — a survey of a
/// fundamental geometric data structure", doi:10.1145/116873.116880. Cost: as for the convex hull of the
/// points, and a walk for each hidden point.
///
/// The members of Triangulation are those of the vertices that are left; in_sphere() is the side of the
/// sphere as ever, and a cell is in conflict with points *outside* its sphere. To check its
/// to_data(), set CheckOptions::furthest_site.
template <int D = dynamic>
class FurthestSite : public Triangulation {
  static_assert(D >= 0, "the dimension of the space is at least 1, or delone::dynamic");

 public:
  using Point = detail::OwnPoint<D>;

  /// Of no points.
  explicit FurthestSite(const Options& options = {}) requires(D != dynamic)
      : Triangulation(TriangulationKind::furthest_site, D, options) {}
  /// Of points; errors, and containers that are moved in, as for Delaunay::insert_range().
  explicit FurthestSite(AnyPoints<D> points, const Options& options = {}) requires(D != dynamic)
      : FurthestSite(options) {
    insert_points(points);
  }
  /// Of no points. Throws Errc::bad_dimension unless dimension ≥ 1.
  explicit FurthestSite(int dimension, const Options& options = {}) requires(D == dynamic)
      : Triangulation(TriangulationKind::furthest_site, dimension, options) {}
  FurthestSite(AnyPoints<D> points, int dimension, const Options& options = {}) requires(D == dynamic)
      : FurthestSite(dimension, options) {
    insert_points(points);
  }
  explicit FurthestSite(PointsView points, const Options& options = {}) requires(D == dynamic)
      : FurthestSite(points, points.dimension(), options) {}

  /// Inserts n points as the next n rows; errors, and containers that are moved in, as for
  /// Delaunay::insert_range().
  void insert_range(AnyPoints<D> points) { insert_points(points); }
  /// Inserts one point as the next row; `hint` is a cell near it.
  InsertResult insert(const AnyPoint<D>& point, std::optional<CellId> hint = std::nullopt) {
    return insert_point(point, 0.0, hint);
  }

  using Triangulation::remove;
  /// Moves a row to another place, or many to as many. Cost: that of a removal and an insertion. Errors as
  /// for remove(), and as for insert_range().
  void move(std::size_t row, const AnyPoint<D>& to) {
    apply(RowEdits{.move = std::span(&row, 1), .to = to.coordinates()});
  }
  void move(std::span<const std::size_t> rows, AnyPoints<D> to) { edit({.move = rows, .to = std::move(to)}); }
  /// Removes, moves, weighs anew and inserts rows, all or none. Throws as remove() and insert_range() do, and
  /// Errc::bad_dimension where lists do not match. Where much changes, cells are built anew, with up to
  /// Options::threads threads. Tells Options::progress.
  void edit(const Edit<D>& edit) { apply(edit); }

  /// A deep copy, with cells and vertices of the same ids: a snapshot that readers may keep while this one is
  /// edited. Nothing of it can be undone. Throws Errc::out_of_memory. O(cells·k + points·d).
  FurthestSite clone() const { return FurthestSite(detail::Clone{}, *this); }

  /// The coordinates of a finite vertex.
  detail::Coordinates<D> point(VertexId v) const { return detail::Coordinates<D>(Triangulation::point(v)); }
  Location locate(const AnyPoint<D>& query, std::optional<CellId> hint = std::nullopt) const {
    return Triangulation::locate(query.coordinates(), hint);
  }
  /// The cells in conflict with q, those whose spheres have q outside: an insertion of q would destroy them,
  /// ties perturbed as an insertion would. Empty if q would be hidden, for a duplicate of a vertex, and for a
  /// point outside the affine hull.
  std::vector<CellId> conflict_zone(const AnyPoint<D>& query,
                                    std::optional<CellId> hint = std::nullopt) const {
    return conflict_zone_of(query, 0.0, hint);
  }
  /// The side of the sphere through the vertices of a finite cell that q lies on, exactly.
  Side in_sphere(CellId cell, const AnyPoint<D>& query) const { return side_of_sphere(cell, query, 0.0); }

 private:
  FurthestSite(detail::Clone tag, const FurthestSite& other) : Triangulation(tag, other) {}
};

/// From a range of points whose type tells their dimension.
template <class Range>
requires(detail::dimension_of_range<Range>() > 0) FurthestSite(Range&&, const Options& = {})
->FurthestSite<detail::dimension_of_range<Range>()>;

/// From points and their dimension, chosen at run time.
template <class Range>
FurthestSite(Range&&, int, const Options& = {}) -> FurthestSite<dynamic>;

}  // namespace delone
