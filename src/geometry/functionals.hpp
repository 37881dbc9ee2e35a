// SPDX-License-Identifier: BSD-3-Clause
// The cached functionals of all cells: for each cell an affine function h of (X, ℓ), the image of a point in the frame and its
// lift, that vanishes at the cell's vertices, with a certified threshold. A point is in conflict iff h < 0 there.
//
// Finite cell: h = ℓ + g·X + c, the power with respect to the circumsphere, up to the frame's scaling.
// Infinite cell: h = g·X + c with one coefficient ±1, positive on the side of the hull.
//
// Knows images and lifts; neither vertices nor exact arithmetic. Proofs: docs/predicates.md, "The filter" and "The pencil".
#pragma once

#include "facet_side.hpp"
#include "geometry/frame.hpp"
#include "geometry/record.hpp"
#include "growable_array.hpp"
#include "kernel/buffer.hpp"

#include <delone/types.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace delone::geometry {

/// K is the dimension of the cells, or 0 when it is chosen at run time.
template <int K>
class Functionals {
 public:
  explicit Functionals(int dimension) : dimension_(dimension) {}

  /// Takes over the constants of a frame. All functionals must be computed anew after it.
  void set_frame(const Frame& frame, const std::vector<int>& axes);

  void reserve(std::size_t cells) { records_.reserve(cells * stride()); }
  std::size_t bytes() const { return records_.capacity() * sizeof(double); }

  /// h̃ at an image and a lift.
  double value(Index cell, const double* image, double lift) const {
    const double* record = row(cell);
    double h = record[k()];
    for (int r = 0; r < k(); ++r) h += record[r] * image[r];
    return is_infinite(cell) ? h : h + lift;
  }
  /// |value − h| is below it for all points of the frame's box.
  double threshold(Index cell) const { return std::fabs(certificate(cell).threshold); }
  bool is_infinite(Index cell) const { return std::signbit(certificate(cell).threshold); }

  /// Computes a functional by elimination from the rows (k images and the lift) of the finite vertices, the apex first.
  /// `positive`: for an infinite cell, the sign of the coefficient ±1 is that of the edge vectors' determinant, else its
  /// opposite.
  template <bool Infinite>
  void solve(Index cell, const double* rows, bool positive);

  /// Computes a functional from those of the cells on the two sides of a facet, the first in conflict with q: the functionals
  /// that vanish on the facet are a pencil, and the new one is its member that vanishes at q. `value_at_vertex(cell, v)` is
  /// the functional of a cell at a vertex. False, and nothing done, if the certificate would be too weak.
  template <class ValueAtVertex>
  bool combine(Index cell, const FacetSide& dead, const FacetSide& survivor, const double* q_image, double q_lift,
               ValueAtVertex&& value_at_vertex);

 private:
  int k() const { return K > 0 ? K : dimension_; }
  std::size_t stride() const { return static_cast<std::size_t>(k()) + 2; }
  const double* row(Index cell) const { return records_.data() + static_cast<std::size_t>(cell) * stride(); }
  double* row(Index cell) { return records_.data() + static_cast<std::size_t>(cell) * stride(); }
  Certificate certificate(Index cell) const { return load_certificate(row(cell) + k() + 1); }
  void certify(Index cell, double threshold, double error, double determinant, bool infinite) {
    store_certificate(row(cell) + k() + 1, make_certificate(threshold, error, determinant, infinite));
  }

  int dimension_;
  GrowableArray<double> records_;  // per cell: k coefficients, the constant, the certificate

  // Constants of the frame.
  double largest_lift_ = 0;
  double evaluation_error_ = 0;       // relative to the sum of the magnitudes of a functional's terms
  double finite_spread_ = 0;          // Σ|barycentric coordinates| − 1 is at most finite_spread·R^(k−1)/det in the box
  double infinite_spread_ = 0;        // the same for infinite cells, over det
  std::vector<double> extent_ratio_;  // per axis, the frame's scale over that of lifts
  bool spheres_ = false;              // whether functionals of finite cells describe spheres (the flat is the whole space)
};

template <int K>
void Functionals<K>::set_frame(const Frame& frame, const std::vector<int>& axes) {
  const double n = k();
  largest_lift_ = frame.ambient();
  evaluation_error_ = 1.01 * (n + frame.ambient() + 8) * 0x1p-53;
  spheres_ = k() == frame.ambient();
  extent_ratio_.clear();
  double diagonal = 0, volume_ratio = 1;
  for (const int axis : axes) {
    const double ratio = frame.extent_ratio(axis);
    extent_ratio_.push_back(ratio);
    diagonal += 1 / (ratio * ratio);
    volume_ratio /= ratio;
  }
  // The largest (n−1)-simplex in a ball is regular: (n−1)!·volume = n^(n/2)/(n−1)^((n−1)/2)·R^(n−1).
  const double regular = std::pow(n, n / 2) / std::pow(std::max(n - 1, 1.0), (n - 1) / 2);
  finite_spread_ = 1.001 * 2 * std::sqrt(diagonal) * (n + 1) * regular / volume_ratio;
  const double m = n - 1;
  infinite_spread_ = 1.001 * 4 * m * m * std::pow(std::max(m - 1, 1.0), (m - 1) / 2) * std::pow(2.0, m - 1);
}

}  // namespace delone::geometry

#include "geometry/combine.hpp"
#include "geometry/solve.hpp"
