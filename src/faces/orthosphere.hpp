// SPDX-License-Identifier: BSD-3-Clause
// The smallest orthosphere of a simplex: of all spheres that are orthogonal to its vertices (for vertices
// without weights: that pass through them) the one of least squared radius. Its center is in the flat of the
// simplex. Squares of radii are rounded up, and signs are exact, in stages: binary64 with a certified bound,
// binary64 without any rounding on small lattices, pairs of doubles (squares alone), integers.
#pragma once

#include "faces/exact_orthosphere.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::internal {

/// Small lattices are those of units from 2^−this to 2^this; see docs/predicates.md.
inline constexpr int largest_lattice_exponent = 100;

/// The exponent of a unit that all coordinates are multiples of; with weights, each after `width` ones, also
/// of its square all weights. Some exponent below those of small lattices, where the unit is smaller.
int unit_of(std::span<const double> coordinates, std::size_t width = 0);

/// What is asked of orthospheres of simplices with `corners` ≥ 1 vertices each, at most 64. A vertex is an
/// array of d coordinates, followed by its weight if vertices have one. Has scratch memory: one for each
/// thread. Affinely dependent vertices, which only files have, have no orthosphere: the square is NaN,
/// nothing is beyond a facet, and no finite bound is kept.
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
  /// The same, and what costs nothing of Answer::beyond: `beyond_is_known` where that is known.
  void is_within_block(std::size_t count, const double* const* points, const SquareBound& bound,
                       bool* is_within, std::uint64_t* beyond, bool* beyond_is_known);

  /// From now on, without weights, Want::square may also give a double that a relative error of 2⁻⁷⁹
  /// separates from the squared radius, from below, too. So no integers are needed where the square is a
  /// double.
  void let_nearest_be_enough() { is_nearest_enough_ = true; }

  /// How many answers needed integers so far.
  std::uint64_t num_exact() const { return num_exact_; }

 private:
  template <int N, int D>
  Answer find_by_stages(const double* const* points, Want want);
  template <int N, int D>
  bool is_within_by_stages(const double* const* points, const SquareBound& bound);
  template <class Solver>
  bool is_small(const Solver& solver) const;
  bool fills_lanes(std::size_t count, const double* const* points);
  Answer find_of_vertex(const double* const* points, Want want);
  bool is_within_of_vertex(const double* const* points, const SquareBound& bound);

  std::size_t dimension_, corners_;
  bool weighted_;
  double small_ = 0, small_square_ = 0;  // up to these nothing is rounded
  Answer (Orthospheres::*find_)(const double* const*, Want);
  bool (Orthospheres::*is_within_)(const double* const*, const SquareBound&);
  bool is_nearest_enough_ = false;
  std::uint64_t num_exact_ = 0;
  std::vector<double> lanes_;  // coordinates of a block, empty if blocks are not for SIMD
};

}  // namespace delone::internal
