// SPDX-License-Identifier: BSD-3-Clause
#include "faces/orthosphere.hpp"

#include "base/infinity.hpp"
#include "base/quick_rounds.hpp"
#include "faces/orthosphere_kernel.hpp"
#include "faces/square_in_pairs.hpp"
#include "kernel/double_double.hpp"
#include "kernel/fractions.hpp"
#include "kernel/grid.hpp"

#include <hwy/highway.h>

#include "faces/orthosphere_solver-inl.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace delone::internal {
namespace {

using HWY_NAMESPACE::round_up;

/// One simplex with N edges from p_0 in D dimensions; 0: chosen at run time.
template <int N, int D>
using Solver = HWY_NAMESPACE::OrthosphereSolver<double, N, D>;

template <int N, int D>
Solver<N, D> solver_of(const double* const* points, std::size_t corners, std::size_t dimension,
                       bool weighted) {
  return Solver<N, D>(corners - 1, dimension, weighted,
                      [=](std::size_t i, std::size_t j) { return points[i][j]; });
}

/// Both answers where Orthospheres::is_small(). REQUIRES N = 1, 2 or 3.
template <int N, int D>
Orthospheres::Answer find_small(const Solver<N, D>& solver) {
  double numerators[3] = {0, 0, 0}, determinant = 0;
  const auto& G = solver.gram;
  const auto& right = solver.right;
  if constexpr (N == 1) {
    determinant = G[0];
    numerators[0] = right[0];
  } else if constexpr (N == 2) {
    determinant = G[0] * G[3] - G[1] * G[1];
    numerators[0] = G[3] * right[0] - G[1] * right[1];
    numerators[1] = G[0] * right[1] - G[1] * right[0];
  } else if constexpr (N == 3) {
    const double c00 = G[4] * G[8] - G[5] * G[5], c01 = G[2] * G[5] - G[1] * G[8],
                 c02 = G[1] * G[5] - G[2] * G[4], c11 = G[0] * G[8] - G[2] * G[2],
                 c12 = G[1] * G[2] - G[0] * G[5], c22 = G[0] * G[4] - G[1] * G[1];
    determinant = G[0] * c00 + G[1] * c01 + G[2] * c02;
    numerators[0] = c00 * right[0] + c01 * right[1] + c02 * right[2];
    numerators[1] = c01 * right[0] + c11 * right[1] + c12 * right[2];
    numerators[2] = c02 * right[0] + c12 * right[1] + c22 * right[2];
  }
  Orthospheres::Answer answer;
  if (determinant == 0) {
    answer.square = std::numeric_limits<double>::quiet_NaN();
    return answer;
  }
  double rest = 2 * determinant, product = 0;
  for (std::size_t i = 0; i < solver.num_edges(); ++i) {
    if (numerators[i] < 0) answer.beyond |= std::uint64_t{2} << i;
    rest -= numerators[i];
    product += right[i] * numerators[i];
  }
  if (rest < 0) answer.beyond |= 1;
  const double numerator = product - 4 * determinant * solver.first_weight, denominator = 4 * determinant;
  answer.square = numerator / denominator;
  const kernel::DoubleDouble back = kernel::two_product(answer.square, denominator);
  if (back.high < numerator || (back.high == numerator && back.low < 0))
    answer.square = std::nextafter(answer.square, infinity) + 0.0;
  return answer;
}

/// m of the proof.
int bits_of_small_lattices(std::size_t n, std::size_t d) {
  return d > 8 ? 0 : n == 1 ? 11 : n == 2 ? 6 : n == 3 ? 4 : 0;
}

}  // namespace

int unit_of(std::span<const double> coordinates, std::size_t width) {
  int unit = std::numeric_limits<int>::max();
  QuickRounds round;
  for (std::size_t i = 0; i < coordinates.size() && unit >= -largest_lattice_exponent; ++i) {
    round();
    const bool is_weight = width > 0 && i % (width + 1) == width;
    const double x = coordinates[i];
    unit = std::min(unit, is_weight ? kernel::square_exponent(x) : kernel::trailing_exponent(x));
  }
  return unit;
}

Orthospheres::Orthospheres(int dimension, bool weighted, int unit, std::size_t corners)
    : dimension_(static_cast<std::size_t>(dimension)), corners_(corners), weighted_(weighted) {
  if (corners == 1) {
    find_ = &Orthospheres::find_of_vertex;
    is_within_ = &Orthospheres::is_within_of_vertex;
    return;
  }
  const auto choose = [this](auto n, auto d) {
    find_ = &Orthospheres::find_by_stages<n(), d()>;
    is_within_ = &Orthospheres::is_within_by_stages<n(), d()>;
  };
  constexpr std::integral_constant<int, 0> any;
  constexpr std::integral_constant<int, 1> one;
  constexpr std::integral_constant<int, 2> two;
  constexpr std::integral_constant<int, 3> three;
  const std::size_t n = corners - 1;
  if (dimension == 3 && n <= 3)
    n == 1 ? choose(one, three) : n == 2 ? choose(two, three) : choose(three, three);
  else if (dimension == 2)
    n == 1 ? choose(one, two) : choose(two, two);
  else
    n == 1 ? choose(one, any) : n == 2 ? choose(two, any) : n == 3 ? choose(three, any) : choose(any, any);
  if (n <= most_orthosphere_edges && dimension_ <= most_orthosphere_dimension)
    lanes_.resize(corners * (dimension_ + 1) * orthosphere_block, 0.0);
  const int bits = bits_of_small_lattices(n, dimension_);
  if (bits == 0 || unit < -largest_lattice_exponent || unit > largest_lattice_exponent) return;
  small_ = std::ldexp(1.0, unit + bits);
  small_square_ = std::ldexp(1.0, 2 * (unit + bits));
}

/// Whether nothing was rounded in the members of a solver, nor will be in find_small().
template <class Solver>
bool Orthospheres::is_small(const Solver& solver) const {
  return solver.largest <= small_ && solver.heaviest <= small_square_ &&
         std::fabs(solver.first_weight) <= small_square_;
}

/// Writes a block to its lanes, the last simplex also to those that are left. False if each simplex is better
/// off alone: on small lattices, and where there is no such code.
bool Orthospheres::fills_lanes(std::size_t count, const double* const* points) {
  if (lanes_.empty()) return false;
  if (small_ > 0) {
    double largest = 0;
    for (std::size_t i = 1; i < corners_; ++i)
      for (std::size_t j = 0; j < dimension_; ++j)
        largest = std::max(largest, std::fabs(points[i][j] - points[0][j]));
    if (largest <= small_) return false;
  }
  const std::size_t width = dimension_ + (weighted_ ? 1 : 0);
  for (std::size_t lane = 0; lane < orthosphere_block; ++lane) {
    const double* const* const of_simplex = points + std::min(lane, count - 1) * corners_;
    double* to = lanes_.data() + lane;
    for (std::size_t i = 0; i < corners_; ++i, to += (dimension_ + 1) * orthosphere_block) {
      const double* const p = of_simplex[i];
      if (width == 3) {
        to[0] = p[0];
        to[orthosphere_block] = p[1];
        to[2 * orthosphere_block] = p[2];
      } else {
        for (std::size_t j = 0; j < width; ++j) to[j * orthosphere_block] = p[j];
      }
    }
  }
  return true;
}

void Orthospheres::find_block(std::size_t count, const double* const* points, Want want, Answer* answers) {
  if (!fills_lanes(count, points)) {
    for (std::size_t i = 0; i < count; ++i) answers[i] = find(points + i * corners_, want);
    return;
  }
  OrthosphereBlock found;
  find_orthospheres_in_lanes(corners_ - 1, dimension_, weighted_, want != Want::beyond, lanes_.data(), found);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_certain = (want == Want::square || found.beyond_is_certain[i] != 0) &&
                            (want == Want::beyond || found.square_is_certain[i] != 0);
    answers[i] = is_certain ? Answer{want == Want::beyond ? 0.0 : found.square[i], found.beyond[i]}
                            : find(points + i * corners_, want);
  }
}

void Orthospheres::is_within_block(std::size_t count, const double* const* points, const SquareBound& bound,
                                   bool* is_within) {
  std::uint64_t beyond[orthosphere_block];
  bool beyond_is_known[orthosphere_block];
  is_within_block(count, points, bound, is_within, beyond, beyond_is_known);
}

void Orthospheres::is_within_block(std::size_t count, const double* const* points, const SquareBound& bound,
                                   bool* is_within, std::uint64_t* beyond, bool* beyond_is_known) {
  std::fill_n(beyond_is_known, count, false);
  if (!std::isfinite(bound.below()) || !fills_lanes(count, points)) {
    for (std::size_t i = 0; i < count; ++i) is_within[i] = this->is_within(points + i * corners_, bound);
    return;
  }
  OrthosphereBlock found;
  find_orthospheres_in_lanes(corners_ - 1, dimension_, weighted_, false, lanes_.data(), found);
  for (std::size_t i = 0; i < count; ++i) {
    beyond[i] = found.beyond[i];
    beyond_is_known[i] = found.beyond_is_certain[i] != 0;
    const bool is_certain = found.range_is_certain[i] != 0;
    is_within[i] = is_certain && found.most[i] <= bound.below() ? true
                   : is_certain && found.least[i] > bound.above()
                       ? false
                       : this->is_within(points + i * corners_, bound);
  }
}

template <int N, int D>
Orthospheres::Answer Orthospheres::find_by_stages(const double* const* points, Want want) {
  Solver<N, D> solver = solver_of<N, D>(points, corners_, dimension_, weighted_);
  if constexpr (N > 0) {
    if (is_small(solver)) return find_small(solver);
  }
  Answer answer;
  bool is_certain = solver.solve();
  if (is_certain && want != Want::square) is_certain = solver.find_beyond(answer.beyond);
  if (is_certain && want != Want::beyond) {
    solver.approximate_square();
    const auto rounded = solver.square_above();
    answer.square = rounded.value;
    is_certain = rounded.is_settled;
  }
  if (is_certain) return answer;
  if (want == Want::square && !weighted_)
    if (const auto square = square_in_pairs(points, corners_, dimension_)) {
      const auto rounded = round_up<double>({square->value.high, square->value.low}, square->error);
      // Otherwise within 2⁻⁸⁰ of a double.
      answer.square = rounded.is_settled ? rounded.value : square->value.high + square->value.low;
      if (rounded.is_settled || is_nearest_enough_) return answer;
    }
  ++num_exact_;
  const ExactOrthosphere exact(points, corners_, dimension_, weighted_);
  if (want != Want::square) answer.beyond = exact.beyond();
  if (want != Want::beyond) answer.square = exact.square_above();
  return answer;
}

template <int N, int D>
bool Orthospheres::is_within_by_stages(const double* const* points, const SquareBound& bound) {
  if (!std::isfinite(bound.below()) && bound.below() == bound.above()) return bound.above() > 0;
  Solver<N, D> solver = solver_of<N, D>(points, corners_, dimension_, weighted_);
  double rounded = 0;
  bool is_known = false;
  if constexpr (N > 0) {
    is_known = is_small(solver);
    if (is_known) rounded = find_small(solver).square;
  }
  if (!is_known && solver.solve()) {
    const auto [square, error] = solver.approximate_square();
    // Both ends are rounded, by less than the bound is generous.
    if (square + error <= bound.below()) return true;
    if (square - error > bound.above()) return false;
    const auto above = solver.square_above();
    rounded = above.value;
    is_known = above.is_settled;
  }
  if (is_known)
    if (const auto answer = bound.admits(rounded); answer != SquareBound::Answer::unsure)
      return answer == SquareBound::Answer::yes;
  ++num_exact_;
  return ExactOrthosphere(points, corners_, dimension_, weighted_).is_within(bound);
}

Orthospheres::Answer Orthospheres::find_of_vertex(const double* const* points, Want) {
  return {weighted_ ? 0 - points[0][dimension_] : 0.0, 0};
}

bool Orthospheres::is_within_of_vertex(const double* const* points, const SquareBound& bound) {
  return find_of_vertex(points, Want::square).square <= bound.below();
}

}  // namespace delone::internal
