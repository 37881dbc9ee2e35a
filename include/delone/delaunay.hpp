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
  /// Of points; a container that is moved in is consumed: see insert_range(), which also says what is thrown.
  explicit Delaunay(AnyPoints<D> points, const Options& options = {}) requires(D != dynamic)
      : Delaunay(options) {
    insert_points(points);
  }
  /// Of no points. Throws Errc::bad_dimension unless dimension ≥ 1.
  explicit Delaunay(int dimension, const Options& options = {}) requires(D == dynamic)
      : Triangulation(TriangulationKind::delaunay, dimension, options) {}
  Delaunay(AnyPoints<D> points, int dimension, const Options& options = {}) requires(D == dynamic)
      : Delaunay(dimension, options) {
    insert_points(points);
  }
  explicit Delaunay(PointsView points, const Options& options = {}) requires(D == dynamic)
      : Delaunay(points, points.dimension(), options) {}

  /// Inserts n points as the next n rows, all of them or none: after any error (not_finite, bad_dimension,
  /// cancelled, too_many, out_of_memory) the triangulation is as it was. The memory of a container that is
  /// moved in is released before most cells are created: the peak is lower by the size of the points. After
  /// not_finite and bad_dimension the container is as it was, too.
  void insert_range(AnyPoints<D> points) { insert_points(points); }
  /// Inserts one point as the next row; `hint` is a cell near it. Expected cost with a good hint: the size of
  /// the conflict zone; without: also a walk past a few cells, from a vertex close by
  /// (docs/decisions/0006-walks-start-at-a-vertex-close-by.md). A batch is still faster.
  InsertResult insert(const AnyPoint<D>& point, std::optional<CellId> hint = std::nullopt) {
    return insert_point(point, 0.0, hint);
  }

  using Triangulation::remove;
  /// Moves a row to another place, or many to as many. Cost of a small step inside, after which the cells
  /// around are still those of the result: about that of an insertion there; else that of a removal and an
  /// insertion. Errors as for remove(), and as for insert_range().
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
  Delaunay clone() const { return Delaunay(detail::Clone{}, *this); }

  /// The coordinates of a finite vertex.
  detail::Coordinates<D> point(VertexId v) const { return detail::Coordinates<D>(Triangulation::point(v)); }
  Location locate(const AnyPoint<D>& query, std::optional<CellId> hint = std::nullopt) const {
    return Triangulation::locate(query.coordinates(), hint);
  }
  /// The cells in conflict with q: those an insertion of q would destroy, ties perturbed as an insertion
  /// would. Empty for a duplicate of a vertex and for a point outside the affine hull.
  std::vector<CellId> conflict_zone(const AnyPoint<D>& query,
                                    std::optional<CellId> hint = std::nullopt) const {
    return conflict_zone_of(query, 0.0, hint);
  }
  /// The side of the sphere through the vertices of a finite cell that q lies on, exactly.
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
