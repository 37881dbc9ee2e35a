// SPDX-License-Identifier: BSD-3-Clause
// Exact regular triangulations (weighted Delaunay triangulations) in any dimension: built from a range of
// weighted points, or point by point.
#pragma once

#include <delone/triangulation.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace delone {

/// The regular triangulation of weighted points in R^D (of R^d, d an argument of the constructor, for D =
/// dynamic): the dual of their power diagram, and the lower boundary of the convex hull of the points (x,
/// |x|² − weight). With equal weights it is the Delaunay triangulation; a constant added to all weights
/// changes nothing, as long as that addition is exact.
///
/// A weight is the square of a radius if points stand for balls, but it may be any finite double, negative
/// ones included.
///
/// *Hidden points.* A point whose lifted image lies above that boundary has no cell of the power diagram and
/// is not a vertex. Of several points in one place the heaviest counts, the others are hidden; points with
/// equal coordinates and weight are duplicates of one vertex, or hidden with it. Edits may turn hidden points
/// into vertices; edits and insertions may hide vertices. Both keep their ids.
///
/// Exact for all finite doubles, ties perturbed as in Triangulation (Devillers and Teillaud,
/// doi:10.1016/j.comgeo.2010.09.010): the result, with its hidden points, is a function of the set of
/// weighted points. For the terms see Edelsbrunner and Shah, "Incremental topological flipping works for
/// regular triangulations", doi:10.1007/BF01975867. Cost as for Triangulation; each hidden point costs a
/// walk.
///
/// The members of Triangulation answer for the visible vertices; locate() ignores weights.
template <int D = dynamic>
class Regular : public Triangulation {
  static_assert(D >= 0, "the dimension of the space is at least 1, or delone::dynamic");

 public:
  using Point = detail::OwnPoint<D>;

  /// Of no points.
  explicit Regular(const Options& options = {}) requires(D != dynamic)
      : Triangulation(TriangulationKind::regular, D, options) {}
  /// Of points and one weight for each. Throws as insert_range().
  Regular(AnyPoints<D> points, std::span<const double> weights,
          const Options& options = {}) requires(D != dynamic)
      : Regular(options) {
    insert_range(std::move(points), weights);
  }
  /// Of no points. Throws Errc::bad_dimension unless dimension ≥ 1.
  explicit Regular(int dimension, const Options& options = {}) requires(D == dynamic)
      : Triangulation(TriangulationKind::regular, dimension, options) {}
  /// Of points of R^dimension. Throws Errc::bad_dimension unless dimension ≥ 1, and as insert_range().
  Regular(AnyPoints<D> points, std::span<const double> weights, int dimension,
          const Options& options = {}) requires(D == dynamic)
      : Regular(dimension, options) {
    insert_range(std::move(points), weights);
  }
  Regular(PointsView points, std::span<const double> weights,
          const Options& options = {}) requires(D == dynamic)
      : Regular(points, weights, points.dimension(), options) {}

  /// Inserts n weighted points as the next n rows. Throws as Delaunay::insert_range(); bad_dimension also
  /// unless there is one weight per point, not_finite also for a weight.
  void insert_range(AnyPoints<D> points, std::span<const double> weights) { insert_points(points, weights); }
  /// Inserts one weighted point as the next row; `hint` is a cell near it. Cost and errors as for
  /// Delaunay::insert(), not_finite also for the weight.
  InsertResult insert(const AnyPoint<D>& point, double weight, std::optional<CellId> hint = std::nullopt) {
    return insert_point(point, weight, hint);
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
  /// Errc::bad_dimension if two lists that belong together differ in length.
  void edit(const Edit<D>& edit) { apply(edit); }
  /// Reweights one row, or several. Cost and errors as for move(); bad_dimension unless there is one weight
  /// per row.
  void set_weight(std::size_t row, double weight) {
    apply(RowEdits{.reweight = std::span(&row, 1), .weights = std::span(&weight, 1)});
  }
  void set_weights(std::span<const std::size_t> rows, std::span<const double> weights) {
    apply(RowEdits{.reweight = rows, .weights = weights});
  }

  /// A deep copy in which cells and vertices have the same ids: a snapshot for readers while the original is
  /// edited. The copy has nothing to undo. Throws Errc::out_of_memory. O(cells·k + points·d).
  Regular clone() const { return Regular(detail::Clone{}, *this); }

  /// The coordinates of a finite vertex, and its weight. O(1). Throws Errc::invalid_argument if v is not one.
  detail::Coordinates<D> point(VertexId v) const { return detail::Coordinates<D>(Triangulation::point(v)); }
  double weight(VertexId v) const { return weight_of(v); }
  /// Where the query lies, exactly, whatever its weight. Errors as for Triangulation::locate().
  Location locate(const AnyPoint<D>& query, std::optional<CellId> hint = std::nullopt) const {
    return Triangulation::locate(query.coordinates(), hint);
  }
  /// A finite cell that contains the point of a hidden row and is not in conflict with it: the proof that it
  /// is hidden. Cost: a walk from the hint. Throws Errc::invalid_argument if the row is not hidden or does
  /// not exist, or the hint is not a cell.
  CellId hiding_cell(std::size_t row, std::optional<CellId> hint = std::nullopt) const {
    return find_hiding_cell(row, hint);
  }
  /// The cells in conflict with the query: those that its insertion with that weight would destroy. Empty if
  /// it would be hidden, for a duplicate of a vertex, and for a point outside the affine hull. Throws as
  /// Delaunay::conflict_zone(); not_finite also for the weight.
  std::vector<CellId> conflict_zone(const AnyPoint<D>& query, double weight,
                                    std::optional<CellId> hint = std::nullopt) const {
    return conflict_zone_of(query, weight, hint);
  }
  /// The side of the power sphere of a finite cell that the weighted query lies on, exactly: inside if the
  /// cell is in conflict with it, on for the vertices of the cell. See delone::in_power_sphere(). Throws as
  /// Delaunay::in_sphere(); not_finite also for the weight.
  Side in_power_sphere(CellId cell, const AnyPoint<D>& query, double weight) const {
    return side_of_sphere(cell, query, weight);
  }

 private:
  Regular(detail::Clone tag, const Regular& other) : Triangulation(tag, other) {}
};

/// From a range of points whose type tells their dimension, and weights.
template <class Range>
requires(detail::dimension_of_range<Range>() > 0)
    Regular(Range&&, std::span<const double>, const Options& = {})
->Regular<detail::dimension_of_range<Range>()>;

/// From points and their dimension, chosen at run time.
template <class Range>
Regular(Range&&, std::span<const double>, int, const Options& = {}) -> Regular<dynamic>;

}  // namespace delone
