// SPDX-License-Identifier: BSD-3-Clause
// The cached functionals of all cells: for each cell a linear function h of rows that vanishes at the cell's
// vertices, with a certified threshold. A point is in conflict iff h < 0 at its row. Rows have k + 1 entries
// and a reference entry, for which all finite functionals have the coefficient 1:
//
// Lifted, (X, 1 | ℓ): the image of a point in the frame and its lift.
//   Finite cell: h = ℓ + g·X + c, the power with respect to the circumsphere, up to the frame's scaling.
//   Infinite cell: h = g·X + c with one coefficient ±1, positive on the side of the hull.
// Not lifted, (X | 1): the image of a point of R^(k+1) relative to a point inside the hull. All cells are
// finite: h = 1 + g·X.
//
// A value beyond the threshold has the sign of h. The threshold also bounds the error of a value, except for
// flat cells, whose spheres are far larger than the frame's box: there the error may grow with the value, by
// threshold/bend.
//
// Knows images and lifts, but neither vertices nor exact arithmetic. Proofs: docs/predicates.md, "The filter"
// and "The pencil".
#pragma once

#include "cells/cell_memory.hpp"
#include "cells/horizon_facet.hpp"
#include "geometry/certificate.hpp"
#include "geometry/frame.hpp"
#include "geometry/lattice.hpp"
#include "geometry/near_kernel.hpp"
#include "geometry/pair.hpp"
#include "geometry/simplex_kernel.hpp"
#include "geometry/star_kernel.hpp"
#include "geometry/vertex_rows.hpp"
#include "kernel/buffer.hpp"

#include <delone/types.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace delone::geometry {

using cells::CellMemory;
using cells::HorizonFacet;

/// K is the dimension of the cells, or 0 when it is chosen at run time.
template <int K, bool Lifted = true>
class Functionals {
 public:
  explicit Functionals(CellMemory<K>& memory) : memory_(memory) {}

  /// Computes the constants of a frame. All functionals must be recomputed after it.
  void set_frame(const Frame& frame, const std::vector<int>& axes) requires(Lifted);
  /// The same for rows that are not lifted, whose entries are in [−1, 1] and off by at most one rounding.
  void set_frame() requires(!Lifted);

  /// The functionals at one row, with a copy of all that evaluations read.
  class Evaluator {
   public:
    Evaluator(const CellMemory<K>& memory, const double* row, double per_bend)
        : records_(memory.records()),
          row_(static_cast<std::size_t>(memory.dimension()) + 1),
          per_bend_(per_bend),
          k_(memory.dimension()) {
      int r = 0;
      for (; r < k(); r += 2) store_pair(row_.data() + r, load_pair(row + r));
      if (r == k()) row_.data()[r] = row[r];
    }
    /// h̃ of a cell.
    [[gnu::always_inline]] double value(Index cell) const {
      return value_of(records_.functional(cell), packed(cell), row_.data(), k());
    }
    /// A value beyond it has the sign of h, for all points of the frame's box; a value within it is off by at
    /// most the threshold.
    double threshold(Index cell) const { return certificate::threshold(packed(cell)); }
    /// A bound on the error of a value.
    double error(Index cell, double value) const {
      return threshold(cell) * (1 + std::fabs(value) * per_bend_);
    }

   private:
    int k() const { return K > 0 ? K : k_; }
    std::uint64_t packed(Index cell) const {
      return std::bit_cast<std::uint64_t>(*records_.certificate(cell));
    }

    cells::CellRecords<K, const double> records_;
    kernel::Buffer<double, K + (K > 0)> row_;
    double per_bend_;
    int k_;
  };
  Evaluator evaluator(const double* row) const { return {memory_, row, per_bend_}; }
  /// h̃ of one cell at a row.
  double value(Index cell, const double* row) const {
    return value_of(functional(cell), packed(cell), row, k());
  }

  double threshold(Index cell) const { return certificate::threshold(packed(cell)); }
  /// The k + 1 coefficients of h̃ before the reference entry.
  const double* coefficients(Index cell) const { return functional(cell); }
  /// Thresholds of several cells for one row alone, smaller if the row is near the vertices of the cell.
  /// `rows`: of all vertices. Cost O(k²) per cell.
  void thresholds_at(std::span<const Index> cells, const VertexRows& rows, const double* row,
                     double* thresholds) const requires(Lifted);
  /// Whether a value within the threshold proves that h is exactly zero. False for NaN.
  bool proves_zero(Index cell, double value, const LatticeBounds& bounds) const {
    const double largest_error = 2 * threshold(cell);
    if (!(2 * std::fabs(value) <= largest_error)) return false;
    if (largest_error <= bounds.least_value(is_infinite(cell))) return true;
    // The bound from the box is too small for most spheres of a fine grid. Where the lower bound on the
    // determinant is already too large, the upper bound need not be computed.
    const auto proved_with = [&](double determinant) {
      return largest_error * determinant <= bounds.numerator;
    };
    return spheres_ && !is_infinite(cell) && proved_with(certificate::determinant(packed(cell))) &&
           proved_with(largest_determinant(cell));
  }
  bool is_infinite(Index cell) const { return certificate::infinite(packed(cell)); }

  /// Computes a functional by elimination from the rows (k images and the lift) of the finite vertices, the
  /// apex first. `positive`: for an infinite cell, the sign of the coefficient ±1 is that of the edge
  /// vectors' determinant, else its opposite. Returns the sign of that determinant, zero if it is not
  /// certain. A cyclic shift of the vertices may reverse the sign, so it is that of the cell's vertices only
  /// if the apex is in slot 0.
  template <bool Infinite>
  Sign solve(Index cell, const double* rows, bool positive) requires(Lifted);
  /// The same for up to simplex_lanes finite cells at once, given their vertices; `rows`: of all vertices.
  /// Where a sign is zero, the functional must be computed by itself.
  void solve(std::span<const Index> cells, std::span<const Index* const> vertices, const double* rows,
             Sign* signs) requires(Lifted);
  /// The same for rows that are not lifted, k + 1 of them.
  void solve(Index cell, const double* rows) requires(!Lifted);
  /// Says nothing of a cell.
  void give_up(Index cell, bool infinite);
  /// Copies the functional of a cell and its certificate, k + 2 numbers, and puts them back.
  void save(Index cell, double* to) const {
    *std::copy_n(functional(cell), k() + 1, to) = *memory_.records().certificate(cell);
  }
  void put_back(Index cell, const double* from) {
    std::copy_n(from, k() + 1, functional(cell));
    *memory_.records().certificate(cell) = from[k() + 1];
  }

  /// Computes the functionals of a star's cells from those of the cells on the two sides of each facet: the
  /// functionals that vanish on the facet are a pencil, and the new one is its member that vanishes at the
  /// new vertex. `rows`: of all vertices. Returns the facets whose certificates would be too weak: their
  /// cells must be solved for. A cell may be created in the slot of the dead cell of its facet or of an
  /// earlier one, which is not read afterwards.
  std::span<const std::uint32_t> combine(std::span<const HorizonFacet> facets, const VertexRows& rows,
                                         const double* query_row, const LatticeBounds& bounds) {
    const auto records = memory_.records();
    const std::size_t num_weak = combine_star({facets, k(), Lifted, memory_.layout().vertex_ids(),
                                               records.functional(0), records.certificate(0), rows, query_row,
                                               frame_constants(), scratch_.data(), weak_.data()});
    const auto adopted = std::remove_if(weak_.begin(), weak_.begin() + static_cast<std::ptrdiff_t>(num_weak),
                                        [&](std::uint32_t f) { return adopt(facets[f], query_row, bounds); });
    const auto weak = std::span(weak_).first(static_cast<std::size_t>(adopted - weak_.begin()));
    if constexpr (Lifted && can_certify_by_edges(K))
      return weak.first(certify_by_edges(facets, weak, rows, query_row));
    return weak;
  }
  /// Makes room for a star. Throws std::bad_alloc.
  void reserve_star(std::size_t facets) {
    if (weak_.size() < facets) weak_.resize(2 * facets);
    scratch_.resize(star_scratch(k()));
  }

 private:
  int k() const { return memory_.dimension(); }
  [[gnu::always_inline]] static double value_of(const double* g, std::uint64_t packed, const double* row,
                                                int k) {
    const int varying = Lifted ? k : k + 1;  // the other entries are 1
    Pair sums{Lifted ? g[k] : 1.0, 0};
    for (int r = 0; r + 1 < varying; r += 2) sums += load_pair(g + r) * load_pair(row + r);
    double h = sums[0] + sums[1];
    if (varying % 2 == 1) h += g[varying - 1] * row[varying - 1];
    if constexpr (!Lifted) return h;
    const std::uint64_t finite = certificate::finite_mask(packed);
    return h + std::bit_cast<double>(std::bit_cast<std::uint64_t>(row[k]) & finite);
  }
  const double* functional(Index cell) const { return memory_.records().functional(cell); }
  double* functional(Index cell) { return memory_.records().functional(cell); }
  std::uint64_t packed(Index cell) const {
    return std::bit_cast<std::uint64_t>(*memory_.records().certificate(cell));
  }
  void certify(Index cell, double threshold, double error, double determinant, bool infinite) {
    *memory_.records().certificate(cell) =
        std::bit_cast<double>(certificate::pack(threshold, error, determinant, infinite));
  }

  /// solve<false>() in the plane.
  Sign solve_triangle(Index cell, const double* rows) requires(Lifted&& K == 2);

  /// An upper bound on the determinant of the edge vectors of a finite cell, from the radius of its sphere.
  /// REQUIRES spheres_.
  double largest_determinant(Index cell) const;
  /// If the new vertex is exactly on the sphere of the survivor, the new cell has the same sphere: copies the
  /// functional and returns true.
  bool adopt(const HorizonFacet& facet, const double* query_row, const LatticeBounds& bounds);

  /// Certifies functionals of a star's cells by their values at the vertices and the determinants and
  /// cofactors of their edges at the new vertex, where elimination could hardly do better. Moves the `weak`
  /// facets that remain to the front and returns their number.
  std::size_t certify_by_edges(std::span<const HorizonFacet> facets, std::span<std::uint32_t> weak,
                               const VertexRows& rows, const double* query_row) requires(Lifted);
  NearTask near_task(std::span<const Index> cells, const VertexRows& rows, const double* row) const;
  /// A bound on the sum of the magnitudes of the functional's terms in the box.
  double magnitude(Index cell) const {
    return sum_of_magnitudes(cell, Lifted && is_infinite(cell) ? 0 : largest_lift_);
  }
  /// The same, given the contribution of the reference entry.
  double sum_of_magnitudes(Index cell, double sum) const {
    for (int r = 0; r <= k(); ++r) sum += std::fabs(functional(cell)[r]);
    return sum;
  }

  FrameConstants frame_constants() const {
    return {evaluation_error_, largest_lift_, finite_spread_, infinite_spread_, largest_radius_,
            spheres_,          bend_,         per_bend_,      flatness_,        extent_ratio_.data()};
  }

  CellMemory<K>& memory_;            // per cell: k coefficients, the constant, the certificate
  std::vector<double> scratch_;      // of combine() and solve()
  std::vector<std::uint32_t> weak_;  // of combine()

  // Constants of the frame.
  double largest_lift_ = 0;
  double evaluation_error_ = 0;  // relative to the sum of the magnitudes of a functional's terms
  double finite_spread_ = 0;  // Σ|barycentric coordinates| − 1 is at most finite_spread·R^(k−1)/det in the
                              // box, with spheres_; else the power of R is in it
  double largest_radius_ = 0;
  double bend_ = 0;  // bounds the heights of lifts over planes that touch them; 0: not known, or not lifted
  double per_bend_ = 0;                // 1/bend, or 0
  double flatness_ = 0;                // see FrameConstants
  double infinite_spread_ = 0;         // the same for infinite cells, over det
  std::vector<double> extent_ratio_;   // per axis, the frame's scale over that of lifts
  std::vector<double> lift_weight_;    // per axis, of the square of an image in the lift: 1/extent_ratio²
  double edge_error_ = 0;              // of edges between rows, and of their heights over planes
  double largest_in_unit_sphere_ = 0;  // determinant of the edge vectors of a simplex in a unit sphere
  bool spheres_ = false;               // whether the spheres of finite cells bound where their vertices are
};

template <int K, bool Lifted>
bool Functionals<K, Lifted>::adopt(const HorizonFacet& facet, const double* query_row,
                                   const LatticeBounds& bounds) {
  if constexpr (Lifted)
    if (facet.survivor_opposite == index(infinite_vertex))
      return false;  // the plane of the facet is no sphere of the new cell
  if (!proves_zero(facet.survivor, facet.survivor_value, bounds)) return false;
  const bool infinite = is_infinite(facet.survivor);
  const double* source = functional(facet.survivor);
  std::copy_n(source, k() + 1, functional(facet.created));
  const double error_at_query =
      std::fabs(evaluator(query_row).value(facet.survivor)) + evaluation_error_ * magnitude(facet.survivor);
  certify(facet.created, threshold(facet.survivor),
          std::max(error_at_query, certificate::error(packed(facet.survivor))),
          bounds.least_determinant(infinite), infinite);
  return true;
}

template <int K, bool Lifted>
double Functionals<K, Lifted>::largest_determinant(Index cell) const {
  const double* source = functional(cell);
  double magnitude = largest_lift_ + std::fabs(source[k()]), gradient_square = 0;
  for (int r = 0; r < k(); ++r) {
    magnitude += std::fabs(source[r]);
    const double t = source[r] * extent_ratio_[static_cast<std::size_t>(r)];
    gradient_square += t * t;
  }
  const double radius_square = 0.25 * gradient_square - source[k()] + certificate::error(packed(cell)) +
                               8 * 0x1p-53 * (magnitude + gradient_square);
  double bound = largest_in_unit_sphere_ * (k() % 2 == 1 ? std::sqrt(radius_square) : 1);
  for (int r = 1; r < k(); r += 2) bound *= radius_square;
  return bound;
}

template <int K, bool Lifted>
void Functionals<K, Lifted>::set_frame() requires(!Lifted) {
  const double n = k() + 1;
  largest_lift_ = 1;
  evaluation_error_ = 1.01 * (n + 8) * 0x1p-53;
  extent_ratio_.assign(static_cast<std::size_t>(k()), 1.0);
  // Rows x = Σλ_i·v_i: by Cramer's rule and Hadamard's inequality |λ_i| ≤ (√n)^n/det.
  finite_spread_ = 1.001 * n * std::pow(n, n / 2);
  spheres_ = false;
}

template <int K, bool Lifted>
void Functionals<K, Lifted>::set_frame(const Frame& frame, const std::vector<int>& axes) requires(Lifted) {
  const double n = k();
  largest_lift_ = frame.largest_lift();
  evaluation_error_ = 1.01 * (n + frame.ambient() + 8) * 0x1p-53;
  spheres_ = k() == frame.ambient() && frame.form() != kernel::RowForm::furthest_point;
  extent_ratio_.clear();
  lift_weight_.clear();
  edge_error_ = 2.1 * (n + 3) * std::sqrt(n) * 0x1p-53;
  double diagonal = 0, volume_ratio = 1;
  for (const int axis : axes) {
    const double ratio = frame.extent_ratio(axis);
    extent_ratio_.push_back(ratio);
    lift_weight_.push_back(1 / (ratio * ratio));
    diagonal += 1 / (ratio * ratio);
    volume_ratio /= ratio;
  }
  // The largest (n−1)-simplex in a ball is regular: (n−1)!·volume = n^(n/2)/(n−1)^((n−1)/2)·R^(n−1).
  const double regular = std::pow(n, n / 2) / std::pow(std::max(n - 1, 1.0), (n - 1) / 2);
  largest_in_unit_sphere_ = 1.001 * std::pow(n + 1, (n + 1) / 2) / std::pow(n, n / 2) / volume_ratio;
  finite_spread_ = 1.001 * 2 * std::sqrt(diagonal) * (n + 1) * regular / volume_ratio;
  if (spheres_ && frame.form() == kernel::RowForm::point) {
    bend_ = 1.001 * 4 * diagonal;  // the square of the diagonal of the box
    per_bend_ = 1 / bend_;
    flatness_ = 1.001 * (n + 1) / (8 * std::sqrt(diagonal));
  } else {
    bend_ = per_bend_ = flatness_ = 0;
  }
  // In a flat, and for furthest points, spheres do not bound where the vertices are, but the box does: R is
  // half of its diagonal.
  largest_radius_ = 1.001 * std::sqrt(diagonal);
  if (!spheres_) finite_spread_ *= std::pow(diagonal, (n - 1) / 2);
  // The bounds above hold while these are normal numbers. They are not where weights are far larger than the
  // squares of coordinates, or axes differ by hundreds of orders of magnitude: then no test is certain.
  if (!(diagonal >= 0x1p-1000 && volume_ratio >= 0x1p-1000))
    largest_in_unit_sphere_ = finite_spread_ = largest_radius_ = std::numeric_limits<double>::infinity();
  const double m = n - 1;
  infinite_spread_ = 1.001 * 4 * m * m * std::pow(std::max(m - 1, 1.0), (m - 1) / 2) * std::pow(2.0, m - 1);
}

}  // namespace delone::geometry

#include "geometry/near.hpp"
#include "geometry/solve.hpp"
