// SPDX-License-Identifier: BSD-3-Clause
// The point of the convex hull of a few points that is nearest to a point q: in binary64 with certified
// bounds of the distance, and exactly where these do not decide. Wolfe's algorithm (1976,
// doi:10.1007/BF01580381).
#pragma once

#include "kernel/fractions.hpp"

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

 private:
  void set_differences(std::span<const double* const> points, const double* q);
  std::size_t nearest_vertex() const;
  void descend();
  bool minimize_on_face();
  void set_point();
  void set_bounds();
  const double* difference(int point) const {
    return differences_.data() + static_cast<std::size_t>(point) * d_;
  }

  std::size_t d_ = 0, m_ = 0;
  int exponent_ = 0;                 // differences_ are (p − q)·2^−exponent_, all at most 1
  std::vector<double> differences_;  // m×d
  bool has_underflow_ = false;       // whether some of them are inexact beyond rounding
  std::vector<int> face_;
  std::vector<double> on_face_;  // weights of face_
  std::vector<double> minimum_;  // weights of the point of the face's flat nearest to q
  std::vector<double> normal_;   // from q to that point, orthogonal to the flat
  std::vector<double> basis_, triangle_, point_, normal_kept_, weights_;
  double lower_ = 0, upper_ = 0;
};

/// The nearest point, exactly.
struct ExactNearest {
  /// The points that it is a combination of with positive weights, increasing. Affinely independent; so they
  /// are the vertices of the smallest face if the m points are affinely independent, too.
  std::vector<int> face;
  std::vector<Integer> numerators;  ///< of the weights of `face`: numerators[i]/denominator, sum 1
  Integer denominator;              ///< positive
  Integer squared;                  ///< the squared distance is squared/denominator·2^(2·grid)
  int grid = 0;

  /// The weight of face[i], rounded to the nearest double.
  double weight(std::size_t i) const { return nearest_double(numerators[i], denominator, 0); }
  /// The sign of (distance − τ). REQUIRES a finite τ ≥ 0.
  Sign compare(double tolerance) const;
  /// The sign of (distance − distance of the other).
  Sign compare(const ExactNearest& other) const;
};

/// As NearestInHull::find(), with integers. `face` is a guess, such as NearestInHull::face(), that saves time
/// if it is right; the nearest point does not depend on it.
ExactNearest nearest_in_hull_exactly(std::span<const double* const> points, const double* q, int dimension,
                                     std::span<const int> face = {});

}  // namespace delone::kernel
