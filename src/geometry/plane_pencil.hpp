// SPDX-License-Identifier: BSD-3-Clause
// The circles through two points of the plane, and which of them comes first: from angles, in rounded numbers
// with a bound. What is not certain is left to exact predicates.
#pragma once

#include <delone/types.hpp>

#include <cmath>

namespace delone::geometry {

/// Seen from v, the edge from a to b has the cotangent dot/cross with
///   cross = (v − a) × (b − a),  dot = (v − a)·(v − b).
/// Of points with a positive cross, all on one side of the edge, u is inside of the circle through a, v and b
/// iff it sees the edge under a larger angle:
///   dot(u)·cross(v) − dot(v)·cross(u) < 0.
///
/// *Bounds.* Let u = 2⁻⁵³. A difference of coordinates is off by a factor 1 ± u, a product of two by (1 ± u)³
/// and by underflow, 2⁻¹⁰⁷⁵, and a sum by one more factor. So cross and dot are off by at most 4u times the
/// sum of the magnitudes of their two products as computed, or 2⁻¹⁰⁰⁰ where that is more. With 2⁻⁹⁰⁰ added to
/// those sums, C and D, they are off by at most 4u·C and 4u·D. Hence each product of a dot and a cross is off
/// by 4u·|dot|·C + 4u·D·|cross| + 16u²·D·C ≤ 8.1u·D·C before it is rounded, as |dot| ≤ (1 + 2u)·D and |cross|
/// ≤ (1 + 2u)·C. Roundings of the products and of their difference add 2.1u times the sum of both D·C, and
/// underflow 2⁻¹⁰⁷³. So the difference is off by at most 16u·(D·C + D·C) + 2⁻¹⁰⁰⁰, which also covers the
/// roundings of this bound. Where numbers overflow, comparisons fail or bounds are infinite.
class PlanePencil {
 public:
  /// Points of two coordinates each, which stay where they are.
  PlanePencil(const double* a, const double* b) : a_(a), b_(b), x_(b[0] - a[0]), y_(b[1] - a[1]) {}

  /// What a point sees of the edge.
  struct View {
    double cross, dot, largest_cross, largest_dot;

    /// The side of the edge that the point is on, or zero if that is not certain.
    Sign side() const {
      const double bound = 4 * unit * largest_cross;
      return cross > bound ? Sign::positive : cross < -bound ? Sign::negative : Sign::zero;
    }
    /// Negative if the point is inside of the circle through another one on the positive side, positive if it
    /// is outside, zero if that is not certain.
    Sign against(const View& other) const {
      const double difference = dot * other.cross - other.dot * cross;
      const double bound =
          16 * unit * (largest_dot * other.largest_cross + other.largest_dot * largest_cross) + 0x1p-1000;
      return difference > bound ? Sign::positive : difference < -bound ? Sign::negative : Sign::zero;
    }
  };
  View view(const double* v) const {
    const double ax = v[0] - a_[0], ay = v[1] - a_[1], bx = v[0] - b_[0], by = v[1] - b_[1];
    const double left = ax * y_, right = ay * x_, along = ax * bx, across = ay * by;
    return {left - right, along + across, std::fabs(left) + std::fabs(right) + least,
            std::fabs(along) + std::fabs(across) + least};
  }

 private:
  static constexpr double unit = 0x1p-53, least = 0x1p-900;
  const double *a_, *b_;
  double x_, y_;
};

}  // namespace delone::geometry
