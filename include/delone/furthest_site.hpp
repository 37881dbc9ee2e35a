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

/// The furthest-site Delaunay triangulation of points in R^D (of R^d, d an argument of the constructor, for D
/// = dynamic): the cells whose spheres have no point outside. It is the upper boundary of the convex hull of
/// the points (x, |x|²), seen from above, and the dual of the diagram that assigns to each point of space the
/// site furthest from it: FurthestVoronoi.
///
/// Its cells tile the convex hull of the points, and its vertices are the extreme points. All others are
/// *hidden*: points inside the hull, and those within its facets and edges. Edits may turn hidden points into
/// vertices; edits and insertions may hide vertices. Both keep their ids.
///
/// Exact for all finite doubles. Ties are perturbed as in Triangulation, with lifts −|x|² in place of |x|²,
/// so that the result is a function of the set of points. Input that spans only a k-flat is triangulated
/// inside its flat, duplicates are merged. For the term see Aurenhammer, "Voronoi diagrams — a survey of a
/// fundamental geometric data structure", doi:10.1145/116873.116880. Cost: as for the convex hull of the
/// points, and a walk for each hidden point.
///
/// The members of Triangulation answer for the visible vertices. in_sphere() is the side of the sphere as
/// usual, but a cell is in conflict with points *outside* its sphere.
template <int D = dynamic>
class FurthestSite : public Triangulation {
  static_assert(D >= 0, "the dimension of the space is at least 1, or delone::dynamic");

 public:
  using Point = detail::OwnPoint<D>;

  /// Of no points.
  explicit FurthestSite(const Options& options = {}) requires(D != dynamic)
      : Triangulation(TriangulationKind::furthest_site, D, options) {}
  /// Of points. Errors and moved containers as for Delaunay::insert_range().
  explicit FurthestSite(AnyPoints<D> points, const Options& options = {}) requires(D != dynamic)
      : FurthestSite(options) {
    insert_points(points);
  }
  /// Of no points. Throws Errc::bad_dimension unless dimension ≥ 1.
  explicit FurthestSite(int dimension, const Options& options = {}) requires(D == dynamic)
      : Triangulation(TriangulationKind::furthest_site, dimension, options) {}
  /// Of points of R^dimension. Throws Errc::bad_dimension unless dimension ≥ 1, and as insert_range().
  FurthestSite(AnyPoints<D> points, int dimension, const Options& options = {}) requires(D == dynamic)
      : FurthestSite(dimension, options) {
    insert_points(points);
  }
  explicit FurthestSite(PointsView points, const Options& options = {}) requires(D == dynamic)
      : FurthestSite(points, points.dimension(), options) {}

  /// Inserts n points as the next n rows. Errors and moved containers as for Delaunay::insert_range().
  void insert_range(AnyPoints<D> points) { insert_points(points); }
  /// Inserts one point as the next row; `hint` is a cell near it. Cost and errors as for Delaunay::insert().
  InsertResult insert(const AnyPoint<D>& point, std::optional<CellId> hint = std::nullopt) {
    return insert_point(point, 0.0, hint);
  }

  using Triangulation::remove;
  /// Moves one row, or several. Cost: that of a removal and an insertion. Throws as remove() and
  /// insert_range(), and Errc::bad_dimension unless there is one point per row.
  void move(std::size_t row, const AnyPoint<D>& to) {
    apply(RowEdits{.move = std::span(&row, 1), .to = to.coordinates()});
  }
  void move(std::span<const std::size_t> rows, AnyPoints<D> to) { edit({.move = rows, .to = std::move(to)}); }
  /// Removes, moves, reweights and inserts rows: all or none. If much changes, all cells are rebuilt, by up
  /// to Options::threads threads. Reports to Options::progress. Throws as remove() and insert_range();
  /// Errc::bad_dimension if two lists that belong together differ in length, and invalid_argument for
  /// weights, which this triangulation does not have.
  void edit(const Edit<D>& edit) { apply(edit); }

  /// A deep copy in which cells and vertices have the same ids: a snapshot for readers while the original is
  /// edited. The copy has nothing to undo. Throws Errc::out_of_memory. O(cells·k + points·d).
  FurthestSite clone() const { return FurthestSite(detail::Clone{}, *this); }

  /// The coordinates of a finite vertex. Throws Errc::invalid_argument if v is not one.
  detail::Coordinates<D> point(VertexId v) const { return detail::Coordinates<D>(Triangulation::point(v)); }
  /// Where the query lies, exactly; cost and errors as Triangulation::locate().
  Location locate(const AnyPoint<D>& query, std::optional<CellId> hint = std::nullopt) const {
    return Triangulation::locate(query.coordinates(), hint);
  }
  /// The cells in conflict with the query, those whose spheres have it outside: its insertion would destroy
  /// them, ties broken as an insertion breaks them. Empty if the query would be hidden, for a duplicate of a
  /// vertex, and for a point outside the affine hull. Throws as Delaunay::conflict_zone().
  std::vector<CellId> conflict_zone(const AnyPoint<D>& query,
                                    std::optional<CellId> hint = std::nullopt) const {
    return conflict_zone_of(query, 0.0, hint);
  }
  /// The side of the sphere through the vertices of a finite cell that the query lies on, exactly. O(k³).
  /// Throws Errc::bad_dimension, not_finite, and invalid_argument if the cell is not a finite one or the
  /// query is outside the affine hull of the points.
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
