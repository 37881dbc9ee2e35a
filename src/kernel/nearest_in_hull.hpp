// SPDX-License-Identifier: BSD-3-Clause
// The point of the convex hull of a few points that is nearest to a point q: in binary64 with certified
// bounds of the distance, and exactly where these do not decide. Wolfe's algorithm (1976,
// doi:10.1007/BF01580381).
#pragma once

#include "kernel/exact_nearest.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone::kernel {

/// Finds the nearest point in binary64. An object keeps its memory from one call to the next.
class NearestInHull {
 public:
  /// For m ≥ 1 points of R^dimension with finite coordinates of any size; they may coincide. Usually
  /// O(m·dimension·r), r ≤ dimension + 1 the size of the largest face visited, times the number of steps.
  void find(std::span<const double* const> points, const double* q, int dimension);

  /// The weights of the point found, one per point of the hull: at least 0, their sum 1 up to rounding. The
  /// point is the combination with these weights divided by their exact sum. It is near the nearest one, as
  /// near as the bounds say.
  std::span<const double> weights() const { return weights_; }
  /// The points whose weights are positive, increasing: affinely independent as far as binary64 could tell.
  std::span<const int> face() const { return face_; }
  /// The distance of q from the hull is at least `lower()`, and that from the point found at most `upper()`,
  /// so the distance lies between them. Both may be infinite if the distance is beyond the largest double.
  double lower() const { return lower_; }
  double upper() const { return upper_; }
  /// Tries to prove that face() is right. REQUIRES find().
  void prove();
  /// After prove(). If finite, the nearest point is proved to have positive weights at all points of face()
  /// and none elsewhere, if the m points are affinely independent, and no weight is off by more than this.
  double weight_error() const { return weight_error_; }
  /// Where another point p lies: positive if z·(p − z) > 0 for the nearest point z seen from q, so that the
  /// hull with p has the same nearest point; negative if the hull with p comes nearer; zero if binary64
  /// cannot tell. REQUIRES a finite weight_error(), and the q of find().
  Sign side(const double* p, const double* q) const;

  /// An upper bound on the distance of q from the affine hull of m ≥ 1 points. Infinite if the points are
  /// dependent, as far as binary64 can tell. O(m²·dimension).
  double flat_distance_up(std::span<const double* const> points, const double* q, int dimension);

  /// A lower bound on the least height of the simplex of m ≥ 2 points: the least distance of one of them from
  /// the affine hull of the others. 0 if binary64 cannot tell.
  double least_height_down(std::span<const double* const> points, int dimension);

 private:
  void set_differences(std::span<const double* const> points, const double* q);
  std::size_t nearest_vertex() const;
  void descend();
  bool minimize_on_face();
  void set_point();
  void set_bounds();
  bool invert_edges();
  Sign sign_of_product(const double* v) const;
  const double* difference(int point) const {
    return differences_.data() + static_cast<std::size_t>(point) * d_;
  }

  std::size_t d_ = 0, m_ = 0;
  int exponent_ = 0;                 // differences_ are (p − q)·2^−exponent_, all at most 1
  std::vector<double> differences_;  // m×d
  bool has_underflow_ = false;       // whether some of them are inexact beyond rounding
  std::vector<int> face_;
  std::vector<double> on_face_;  // weights of face_
  std::vector<int> best_face_;   // those of the nearest point so far
  std::vector<double> best_weights_;
  std::vector<double> minimum_;  // weights of the point of the face's flat nearest to q
  std::vector<double> normal_;   // from q to that point, orthogonal to the flat
  std::vector<double> basis_, triangle_, point_, normal_kept_, weights_;
  std::vector<double> place_, inverse_;  // the point found; X of invert_edges()
  double alpha_ = 0, edges_norm_ = 0, edges_error_ = 0, inverse_norm_ = 0;
  bool is_shifted_ = false;  // whether an axis was divided first
  double place_error_ = 0;   // place_ is off from the nearest point by no more, if that is proved
  double lower_ = 0, upper_ = 0, weight_error_ = 0;
};

}  // namespace delone::kernel
