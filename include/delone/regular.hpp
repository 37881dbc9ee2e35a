// SPDX-License-Identifier: BSD-3-Clause
// Exact regular triangulations (weighted Delaunay triangulations) in any dimension: built from a range of
// weighted points, or point by point.
#pragma once

#include <delone/delaunay.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <ranges>
#include <span>
#include <vector>

namespace delone {

/// The regular triangulation of weighted points in R^d, d chosen at run time: the dual of their power
/// diagram, and the lower boundary of the convex hull of the points (x, |x|² − weight). With equal weights it
/// is the Delaunay triangulation; a constant added to all weights changes nothing, as long as that addition
/// is exact.
///
/// A weight is the square of a radius if points stand for balls, but it may be any finite double, negative
/// ones included.
///
/// *Hidden points.* A point whose lifted image lies above that boundary has no cell of the power diagram, and
/// is no vertex. The heaviest of several points in one place counts, the others are hidden; points with equal
/// coordinates and weight are duplicates of one vertex, or hidden with it. A point that is hidden stays so,
/// whatever is inserted later; a vertex may become hidden: its id is not used again, and the ids of vertices
/// then have gaps (Complex::finite_vertices()).
///
/// Exact for all finite doubles, ties perturbed as in Triangulation (Devillers and Teillaud,
/// doi:10.1016/j.comgeo.2010.09.010): the result, with its hidden points, is a function of the set of
/// weighted points. For the notions see Edelsbrunner and Shah, "Incremental topological flipping works for
/// regular triangulations", doi:10.1007/BF01975867. Cost as for Triangulation; hidden points take a walk
/// each.
///
/// The members of Triangulation are those of the vertices that are left. insert(), insert_range(),
/// conflict_zone() and in_sphere() without a weight take 0; locate() looks at coordinates only.
class RegularTriangulation : public Triangulation {
 public:
  /// The triangulation of no points. Throws Errc::bad_dimension unless dimension ≥ 1.
  explicit RegularTriangulation(int dimension, const Options& options = {});
  /// The triangulation of n×d coordinates, row-major, and n weights. Throws as insert_range().
  RegularTriangulation(std::span<const double> coordinates, std::span<const double> weights, int dimension,
                       const Options& options = {});
  RegularTriangulation(PointsView points, std::span<const double> weights, const Options& options = {});

  using Triangulation::insert;
  using Triangulation::insert_range;
  /// Inserts n weighted points as the next n rows. Errors as for Triangulation::insert_range(), bad_dimension
  /// also if there are not as many weights as points, not_finite also for a weight.
  void insert_range(std::span<const double> coordinates, std::span<const double> weights);
  /// Inserts one weighted point as the next row; `hint` is a cell near it.
  InsertResult insert(std::span<const double> point, double weight,
                      std::optional<CellId> hint = std::nullopt);

  /// The weight of a finite vertex. O(1).
  double weight(VertexId v) const;

  /// Whether the point of an input row, row < num_rows(), is hidden. O(1).
  bool is_hidden(std::size_t row) const;
  /// How many rows are hidden: num_points() = num_vertices() + num_duplicates() + num_hidden(). O(rows).
  std::size_t num_hidden() const;
  /// The rows that are hidden, increasing. O(rows).
  std::vector<std::size_t> hidden_rows() const;
  /// A finite cell whose closure contains the point of a hidden row, and that is not in conflict with it:
  /// proof of its being hidden. Cost: a walk from the hint. Errors: invalid_argument if the row is not
  /// hidden.
  CellId hiding_cell(std::size_t row, std::optional<CellId> hint = std::nullopt) const;

  using Triangulation::conflict_zone;
  /// The cells in conflict with q: those an insertion of q with that weight would destroy. Empty if it would
  /// be hidden, for a duplicate of a vertex, and for a point outside the affine hull.
  std::vector<CellId> conflict_zone(std::span<const double> query, double weight,
                                    std::optional<CellId> hint = std::nullopt) const;

  /// The sign of |q − c|² − r² − weight, where |v − c|² − r² is the weight of v for all vertices v of a
  /// finite cell, exactly: negative if the cell is in conflict with q, zero for its vertices. Errors as for
  /// in_sphere().
  Sign in_power_sphere(CellId cell, std::span<const double> query, double weight) const;
};

/// The regular triangulation of weighted points in R^D. Compiled for D = 1…8; larger D uses the
/// run-time-dimension engine.
template <int D>
class Regular : public RegularTriangulation {
  static_assert(D >= 1, "the dimension of the space is at least 1");

 public:
  using Point = std::array<double, D>;

  explicit Regular(const Options& options = {}) : RegularTriangulation(D, options) {}
  /// From any contiguous range of points of D doubles each, or of doubles (D per point), and their weights.
  template <std::ranges::contiguous_range Range>
  requires std::ranges::sized_range<Range> Regular(const Range& points, std::span<const double> weights,
                                                   const Options& options = {})
      : RegularTriangulation(detail::as_coordinates<D>(points), weights, D, options) {}

  template <std::ranges::contiguous_range Range>
  requires std::ranges::sized_range<Range>
  void insert_range(const Range& points, std::span<const double> weights) {
    RegularTriangulation::insert_range(detail::as_coordinates<D>(points), weights);
  }
};

}  // namespace delone
