// SPDX-License-Identifier: BSD-3-Clause
// The question of a tile to the others: which point is in conflict with this cell, and first of all?
//
// A finite cell is in conflict with the points inside its sphere of center c, an infinite one with those
// beyond its facet: the same with c at infinity. Let p be a vertex of the cell that is the tile's own. The
// points of conflict are met one by one as the center moves from p to c along a line, the sphere always
// through p: x is met where |x − p|² = 2λ(c − p)·(x − p). The answer is the first one, of the least λ. The
// open ball of that sphere lies in that of the cell, so a point inside would be in conflict and have been met
// before. There is none in the whole set, and px is an edge of the whole triangulation. Hence a tile inserts
// only neighbors of its own points, and the landmarks it begins with.
//
// With weights the power |x − q|² − w takes the place of the squared distance: x is met where
// |x − p|² − w_x + w_p = 2λ(c − p)·(x − p). Suppose that p is in its own power region: the left side is then
// negative for no x. A point with a negative power at some λ has a positive right side, and a negative power
// at λ = 1, too: it is in conflict. So the center where the first x is met belongs to the regions of p and x,
// and px is an edge. If the left side is negative for a point in conflict, p is not in its own region, and
// the point of the least left side is inserted first. That is right, as every point in conflict is, but the
// whole triangulation need not have such an edge.
//
// Bounds. Let c be off by 1.01u|c_j| at most along each axis, as correct rounding makes it, u = 2⁻⁵³. The
// sum f(x) = Σ(x_j − p_j)((x_j − c_j) + (p_j − c_j)) − (w_x − w_p), computed, is off from its exact value for
// the exact center by at most
//   2.02u Σ|x_j − p_j||c_j|                            the center,
//   (4.03 + d)u Σ|x_j − p_j|(|x_j − c_j| + |p_j − c_j|)   four roundings of each product, and the sum's,
//   (d + 3)u (|w_x| + |w_p|)                           the weights,
// and (5d + 3)·2⁻¹⁰⁷⁴ by underflow. slack(x) = (d + 8)u Σ|x_j − p_j|(|x_j − c_j| + |p_j − c_j| + |c_j|)
// + (d + 8)u(|w_x| + |w_p|) + 2⁻¹⁰⁰⁰ is larger, its own roundings included. Where numbers overflow,
// comparisons are false, and the point is unsure.
//
// In a box, for the center as it is computed, f is least at the point nearest to the center, as it is
// convex along each axis with its minimum at c_j, and at the largest weight. The slack with the largest
// |x_j − p_j| and |x_j − c_j| of the box bounds the error at every point of it, that of the center included.
//
// Beyond a facet, the sum n·(x − p) is off by 10⁻¹²‖x − p‖₂ because of the normal, and by
// (d + 2)u Σ|n_j||x_j − p_j| by rounding; with |n_j| ≤ 1 + 10⁻¹² the slack
// (1.01·10⁻¹² + (d + 8)u) Σ|x_j − p_j| is larger. In a box the sum is largest in a corner.
#pragma once

#include "kernel/buffer.hpp"
#include "kernel/predicates.hpp"
#include "pages/question_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace delone::pages {

/// The exact answer of a finite cell: whether x is inside its sphere, ties perturbed. A point that equals a
/// corner is not.
inline bool is_in_sphere(const kernel::Flat& flat, std::span<const double* const> corners, const double* x) {
  for (const double* corner : corners)
    if (std::equal(corner, corner + flat.row_size(), x)) return false;
  return kernel::in_sphere_perturbed(flat, corners, kernel::orientation(flat, corners), x) == Sign::negative;
}

enum class QuestionSide { outside, inside, unsure };

/// In R^D, or in R^d, d known at run time, for D = 0.
template <int D>
class Question {
 public:
  using Side = QuestionSide;

  Question(std::size_t dimension, bool weighted)
      : dimension_(dimension), weighted_(weighted), direction_(dimension), reach_(dimension) {}

  /// Of a finite cell: its center, correctly rounded. All REQUIRE that the pointers outlive the question.
  void ask_within_sphere(const double* p, const double* center) {
    p_ = p;
    c_ = center;
    is_halfspace_ = false;
    for (std::size_t j = 0; j < d(); ++j) {
      direction_[j] = 2 * (center[j] - p[j]);
      reach_[j] = std::abs(p[j] - center[j]) + std::abs(center[j]);
    }
  }
  /// The same for a sphere that was moved: the center, rounded to nearest, is that of a correctly rounded one
  /// with coordinates `before`, so that it is off by 1.01u(|c_j| + |before_j|) at most.
  void ask_within_moved_sphere(const double* p, const double* center, const double* before) {
    ask_within_sphere(p, center);
    for (std::size_t j = 0; j < d(); ++j) reach_[j] += std::abs(before[j]);
  }
  /// Of an infinite cell: the outward unit normal of its facet, with an error below 1e-12.
  void ask_beyond_facet(const double* p, const double* normal) {
    p_ = p;
    c_ = nullptr;
    is_halfspace_ = true;
    std::copy_n(normal, d(), direction_.data());
  }

  /// Which side x is certainly on; inside is in conflict.
  Side side(const double* x) const {
    double value = 0, slack = 0;
    if (is_halfspace_) {
      for (std::size_t j = 0; j < d(); ++j) {
        value -= direction_[j] * (x[j] - p_[j]);
        slack += std::abs(x[j] - p_[j]);
      }
    } else {
      for (std::size_t j = 0; j < d(); ++j) {
        const double from_p = x[j] - p_[j], from_c = x[j] - c_[j];
        value += from_p * (from_c + (p_[j] - c_[j]));
        slack += std::abs(from_p) * (std::abs(from_c) + reach_[j]);
      }
      if (weighted_) {
        value -= x[d()] - p_[d()];
        slack += std::abs(x[d()]) + std::abs(p_[d()]);
      }
    }
    slack = slack * slack_factor(is_halfspace_, d()) + least_slack;
    return value > slack ? Side::outside : value < -slack ? Side::inside : Side::unsure;
  }

  /// What orders the points in conflict: λ, or what is negative if p is not in its own region. Rounded.
  double key(const double* x) const {
    double squared = 0, along = 0;
    for (std::size_t j = 0; j < d(); ++j) {
      const double from_p = x[j] - p_[j];
      squared += from_p * from_p;
      along += direction_[j] * from_p;
    }
    if (weighted_) squared -= x[d()] - p_[d()];
    if (squared < 0) return squared;
    return along > 0 ? squared / along : is_halfspace_ ? std::numeric_limits<double>::max() : 1.0;
  }
  /// For the kernel, which tests boxes and many points at a time.
  QuestionForm form() const {
    return {p_, c_, direction_.data(), reach_.data(), is_halfspace_, weighted_, largest_weight_};
  }

  /// The largest |w| of all points, which bounds slacks.
  void set_largest_weight(double weight) { largest_weight_ = weight; }

 private:
  std::size_t d() const { return D > 0 ? static_cast<std::size_t>(D) : dimension_; }

  const std::size_t dimension_;
  const bool weighted_;
  const double *p_ = nullptr, *c_ = nullptr;
  bool is_halfspace_ = false;
  double largest_weight_ = 0;
  kernel::Buffer<double, D> direction_;  // 2(c − p), or the normal
  kernel::Buffer<double, D> reach_;      // |p − c| + |c|
};

}  // namespace delone::pages
