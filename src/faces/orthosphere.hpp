// SPDX-License-Identifier: BSD-3-Clause
// The smallest orthosphere of a simplex: of all spheres that are orthogonal to its vertices (for vertices
// without weights: that pass through them) the one of least squared radius. Its center is in the flat of the
// simplex. Squares of radii are rounded up, and signs are exact, in three stages: binary64 with a certified
// bound, binary64 without any rounding on small lattices, integers.
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

/// What is asked of orthospheres of simplices with `corners` ≥ 1 vertices each, at most 64. A vertex is an
/// array of d coordinates, followed by its weight if vertices have one. Has scratch memory: one for each
/// thread. REQUIRES affinely independent vertices.
class Orthospheres {
 public:
  /// All coordinates are multiples of 2^unit, all weights of 2^(2·unit); a small number if that is not known.
  Orthospheres(int dimension, bool weighted, int unit, std::size_t corners);

  struct Answer {
    double square = 0;         ///< the least double that is not below the squared radius
    std::uint64_t beyond = 0;  ///< bit i: the center is strictly beyond the facet opposite vertex i
  };
  enum class Want : unsigned char { beyond = 1, square = 2, both = 3 };
  Answer find(const double* const* points, Want want) { return (this->*find_)(points, want); }
  /// Whether the squared radius is at most the bound.
  bool is_within(const double* const* points, const SquareBound& bound) {
    return (this->*is_within_)(points, bound);
  }

  /// The same for `count` ≤ orthosphere_block simplices, the vertices of one after those of the other: with
  /// up to 6 vertices in up to 8 dimensions they share SIMD instructions.
  void find_block(std::size_t count, const double* const* points, Want want, Answer* answers);
  void is_within_block(std::size_t count, const double* const* points, const SquareBound& bound,
                       bool* is_within);

  /// How many answers needed integers so far.
  std::uint64_t num_exact() const { return num_exact_; }

 private:
  template <int N, int D>
  Answer find_by_stages(const double* const* points, Want want);
  template <int N, int D>
  bool is_within_by_stages(const double* const* points, const SquareBound& bound);
  bool fills_lanes(std::size_t count, const double* const* points);
  Answer find_of_vertex(const double* const* points, Want want);
  bool is_within_of_vertex(const double* const* points, const SquareBound& bound);

  std::size_t dimension_, corners_;
  bool weighted_;
  double small_ = 0, small_square_ = 0;  // up to these nothing is rounded
  Answer (Orthospheres::*find_)(const double* const*, Want);
  bool (Orthospheres::*is_within_)(const double* const*, const SquareBound&);
  std::uint64_t num_exact_ = 0;
  std::vector<double> lanes_;  // coordinates of a block, empty if blocks are not for SIMD
};

/// The same in integers, for one simplex.
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
  kernel::Integer determinant_;         // of the Gram matrix of the edges, > 0
  kernel::Integer square_;              // of the radius, times 4·determinant_, in units of 2^(2·grid_)
  int grid_ = 0;
};

}  // namespace delone::internal
