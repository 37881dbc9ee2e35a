// SPDX-License-Identifier: BSD-3-Clause
// Smallest orthospheres in integers, and the numbers that squares of radii are compared with.
#pragma once

#include "kernel/fractions.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::internal {

/// A real number that squares of radii are compared with, exactly.
class SquareBound {
 public:
  /// r², of a radius r ≥ 0, or infinity.
  static SquareBound of_radius(double radius);
  /// A double, or ±infinity.
  static SquareBound of_square(double square);

  double below() const { return below_; }  ///< the largest double that is not above it
  double above() const { return above_; }  ///< the smallest that is not below it
  /// Whether a number is at most this one, if it is known that the least double not below that number is
  /// `rounded`; nothing is known if the answer is `unsure`.
  enum class Answer : unsigned char { no, yes, unsure };
  Answer admits(double rounded) const {
    return rounded <= below_ ? Answer::yes : rounded > above_ ? Answer::no : Answer::unsure;
  }
  /// Whether numerator/denominator·2^exponent is at most this one. REQUIRES denominator > 0, and that this
  /// number is finite.
  bool admits(const kernel::Integer& numerator, const kernel::Integer& denominator, int exponent) const;

 private:
  double below_ = 0, above_ = 0;
  kernel::Integer exact_;  // in units of 2^exponent_
  int exponent_ = 0;
};

/// The smallest orthosphere of one simplex; see Orthospheres. Affinely dependent vertices have none: the
/// square and the radius are NaN, and nothing is beyond a facet or within a bound.
class ExactOrthosphere {
 public:
  ExactOrthosphere(const double* const* points, std::size_t corners, std::size_t dimension, bool weighted);

  std::uint64_t beyond() const;
  double square_above() const;
  bool is_within(const SquareBound& bound) const;
  /// The radius, rounded up; see kernel::root_above(). REQUIRES a square of at least 0.
  double radius_above() const;

 private:
  std::vector<kernel::Integer> twice_;  // 2·barycentric coordinates of vertices 1 …, times the next
  kernel::Integer determinant_;         // of the Gram matrix of the edges; > 0, or 0: there is no sphere
  kernel::Integer square_;              // of the radius, times 4·determinant_, in units of 2^(2·grid_)
  int grid_ = 0;
};

}  // namespace delone::internal
