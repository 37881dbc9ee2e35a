// SPDX-License-Identifier: BSD-3-Clause
// A functional from two at hand, O(k): the pencil identity. With a = h_A(q) < 0 and b = h_B(q) > 0, the functional of the cell
// that joins q to the common facet of A and B is
//   A, B finite         h = (b·h_A − a·h_B)/(b − a)       a convex combination
//   A finite, B not     h = h_A − (a/b)·h_B
//   B finite, A not     h = h_B − (b/a)·h_A
//   neither finite      h = (b·h_A − a·h_B)/ν             ν: the largest coefficient in magnitude becomes ±1
// Weights are non-negative, so errors at the facet's vertices combine with the same weights and grow with the number of
// generations at most linearly; at q the error is one evaluation's. The determinant of the new cell's edge vectors follows from
// that of A (or B) by the ratio of heights over the facet. Proofs: docs/predicates.md, "The pencil".
#pragma once

#include "geometry/functionals.hpp"

#include <algorithm>

namespace delone::geometry {

template <int K>
template <class ValueAtVertex>
bool Functionals<K>::combine(Index cell, const FacetSide& dead, const FacetSide& survivor, const double* q_image, double q_lift,
                             ValueAtVertex&& value_at_vertex) {
  constexpr double slack = 0x1p-40;  // covers the few roundings of positive quantities
  if (!spheres_) return false;
  const double a = dead.value, b = survivor.value;
  if (!(a < 0 && b > 0)) return false;
  const double* A = row(dead.cell);
  const double* B = row(survivor.cell);
  double* out = row(cell);
  const Certificate of_a = load_certificate(A + k() + 1), of_b = load_certificate(B + k() + 1);
  const bool a_infinite = std::signbit(of_a.threshold), b_infinite = std::signbit(of_b.threshold);
  const bool infinite = a_infinite && b_infinite;
  const double threshold_a = std::fabs(of_a.threshold), threshold_b = std::fabs(of_b.threshold);

  double x, y;         // the weights of A and B
  double determinant;  // a lower bound
  int normal = 0;      // the coordinate whose coefficient becomes ±1
  if (a_infinite && !b_infinite) {
    x = -b / a;
    y = 1;
    determinant = unpack(of_b.determinant) * (-a - threshold_a) / (value_at_vertex(dead.cell, survivor.opposite) + threshold_a);
  } else {
    double height, height_error;  // of q over the facet, in the units in which that of A's vertex is h_B
    if (infinite) {
      height = 0;
      for (int r = 0; r < k(); ++r)
        if (const double g = std::fabs(b * A[r] - a * B[r]); g > height) {
          height = g;
          normal = r;
        }
      x = b / height;
      y = -a / height;
      height_error =
          (b + std::fabs(B[normal]) + threshold_b) * threshold_a + (std::fabs(A[normal]) - a + threshold_a) * threshold_b;
    } else if (b_infinite) {
      x = 1;
      y = -a / b;
      height = b;
      height_error = threshold_b;
    } else {
      x = b / (b - a);
      y = 1 - x;
      height = b - a;
      height_error = threshold_a + threshold_b;
    }
    determinant =
        unpack(of_a.determinant) * (height - height_error) / (value_at_vertex(survivor.cell, dead.opposite) + threshold_b);
  }
  determinant *= 1 - slack;
  if (!(determinant > 0)) return false;

  const double lift_weight = infinite ? 0 : 1;
  double parts = ((a_infinite ? 0 : x) + (b_infinite ? 0 : y)) * largest_lift_;  // Σ of the magnitudes that are combined
  double magnitude = lift_weight * largest_lift_;
  double at_q = lift_weight * q_lift;
  double gradient_square = 0;  // in the metric of lifts
  for (int r = 0; r < k(); ++r) {
    const double from_a = x * A[r], from_b = y * B[r];
    const double g = from_a + from_b;
    out[r] = g;
    parts += std::fabs(from_a) + std::fabs(from_b);
    magnitude += std::fabs(g);
    at_q += g * q_image[r];
    const double t = g * extent_ratio_[static_cast<std::size_t>(r)];
    gradient_square += t * t;
  }
  out[k()] = x * A[k()] + y * B[k()];
  parts += std::fabs(x * A[k()]) + std::fabs(y * B[k()]);
  magnitude += std::fabs(out[k()]);
  at_q += out[k()];
  if (infinite) out[normal] = std::copysign(1.0, out[normal]);

  const double rounding = evaluation_error_ * magnitude;
  const double error_at_facet = x * unpack(of_a.error) + y * unpack(of_b.error) + 6 * 0x1p-53 * parts;
  const double error = std::max(error_at_facet, std::fabs(at_q) + rounding) * (1 + slack);
  double spread, scale;
  if (infinite) {
    spread = 1 + infinite_spread_ / determinant;
    scale = 1;
  } else {
    // All vertices are within R of the centre of the approximate sphere: |h̃| ≤ error there.
    const double radius_square = gradient_square / 4 - out[k()] + error + 8 * 0x1p-53 * (magnitude + gradient_square);
    const double radius = std::sqrt(radius_square);
    double power = finite_spread_;
    for (int r = 1; r < k(); ++r) power *= radius;
    spread = 1 + power / determinant;
    scale = radius_square;
  }
  const double threshold = (error * spread + rounding) * (1 + slack);
  constexpr double weakest = 0x1p-10;  // thresholds beyond this fraction of the functional's scale are worth an elimination
  if (!(threshold <= weakest * scale)) return false;
  certify(cell, threshold, error, determinant, infinite);
  return true;
}

}  // namespace delone::geometry
