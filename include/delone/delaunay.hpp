// SPDX-License-Identifier: BSD-3-Clause
// Exact Delaunay triangulations in any dimension: built from a range of points, or point by point.
#pragma once

#include <delone/triangulation.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace delone {

/// The Delaunay triangulation of points in R^D; of R^d, d an argument of the constructor, for D = dynamic.
/// Compiled for 1…8 dimensions; larger ones use the run-time-dimension engine. Method, guarantees and cost:
/// Triangulation.
template <int D = dynamic>
class Delaunay : public Triangulation {
  static_assert(D >= 0, "the dimension of the space is at least 1, or delone::dynamic");

 public:
  using Point = detail::OwnPoint<D>;

  /// Of no points.
  explicit Delaunay(const Options& options = {}) requires(D != dynamic)
      : Triangulation(TriangulationKind::delaunay, D, options) {}
  /// Of points; a container that is moved in is consumed. Throws as insert_range().
  explicit Delaunay(AnyPoints<D> points, const Options& options = {}) requires(D != dynamic)
      : Delaunay(options) {
    insert_points(points);
  }
  /// Of no points. Throws Errc::bad_dimension unless dimension ≥ 1.
  explicit Delaunay(int dimension, const Options& options = {}) requires(D == dynamic)
      : Triangulation(TriangulationKind::delaunay, dimension, options) {}
  /// Of points of R^dimension. Throws Errc::bad_dimension unless dimension ≥ 1, and as insert_range().
  Delaunay(AnyPoints<D> points, int dimension, const Options& options = {}) requires(D == dynamic)
      : Delaunay(dimension, options) {
    insert_points(points);
  }
  explicit Delaunay(PointsView points, const Options& options = {}) requires(D == dynamic)
      : Delaunay(points, points.dimension(), options) {}

  /// Inserts n points as the next n rows, all of them or none. Throws Errc::not_finite, bad_dimension,
  /// cancelled, too_many (the ids of this build are exhausted), out_of_memory, time_limit; the triangulation
  /// is then unchanged. The memory of a container that is moved in is released before most cells are created:
  /// the peak is lower by the size of the points. After not_finite and bad_dimension the container is
  /// unchanged, too.
  void insert_range(AnyPoints<D> points) { insert_points(points); }
  /// Inserts one point as the next row; `hint` is a cell near it. Expected cost with a good hint: the size of
  /// the conflict zone; without: also a walk past a few cells, from a vertex close by
  /// (docs/decisions/0006-walks-start-at-a-vertex-close-by.md). A batch is still faster. Throws
  /// Errc::not_finite, bad_dimension, invalid_argument (the hint is not a cell), too_many, out_of_memory; the
  /// triangulation is then unchanged.
  InsertResult insert(const AnyPoint<D>& point, std::optional<CellId> hint = std::nullopt) {
    return insert_point(point, 0.0, hint);
  }

  using Triangulation::remove;
  /// Moves one row, or several. A small step in the interior that leaves the cells around it valid costs
  /// about as much as an insertion there, any other as much as a removal and an insertion. Throws as remove()
  /// and insert_range(), and Errc::bad_dimension unless there is one point per row.
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
  Delaunay clone() const { return Delaunay(detail::Clone{}, *this); }

  /// The coordinates of a finite vertex. Throws Errc::invalid_argument if v is not one.
  detail::Coordinates<D> point(VertexId v) const { return detail::Coordinates<D>(Triangulation::point(v)); }
  /// Where the query lies, exactly; cost and errors as Triangulation::locate().
  Location locate(const AnyPoint<D>& query, std::optional<CellId> hint = std::nullopt) const {
    return Triangulation::locate(query.coordinates(), hint);
  }
  /// The cells in conflict with the query: those that its insertion would destroy, ties broken as an
  /// insertion breaks them. Empty for a duplicate of a vertex and for a point outside the affine hull. Cost:
  /// a walk from the hint, and the size of the zone. Throws Errc::bad_dimension, not_finite, invalid_argument
  /// (the hint is not a cell), out_of_memory.
  std::vector<CellId> conflict_zone(const AnyPoint<D>& query,
                                    std::optional<CellId> hint = std::nullopt) const {
    return conflict_zone_of(query, 0.0, hint);
  }
  /// The side of the sphere through the vertices of a finite cell that the query lies on, exactly. O(k³).
  /// Throws Errc::bad_dimension, not_finite, and invalid_argument if the cell is not a finite one or the
  /// query is outside the affine hull of the points.
  Side in_sphere(CellId cell, const AnyPoint<D>& query) const { return side_of_sphere(cell, query, 0.0); }

 private:
  Delaunay(detail::Clone tag, const Delaunay& other) : Triangulation(tag, other) {}
};

/// From a range of points whose type tells their dimension.
template <class Range>
requires(detail::dimension_of_range<Range>() > 0) Delaunay(Range&&, const Options& = {})
->Delaunay<detail::dimension_of_range<Range>()>;

/// From points and their dimension, chosen at run time.
template <class Range>
Delaunay(Range&&, int, const Options& = {}) -> Delaunay<dynamic>;

}  // namespace delone
