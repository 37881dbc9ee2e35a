// SPDX-License-Identifier: BSD-3-Clause
#include "faces/exact_orthosphere.hpp"

#include "kernel/grid.hpp"
#include "solve/integer_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delone::internal {

using kernel::Integer;

SquareBound SquareBound::of_radius(double radius) {
  if (std::isinf(radius)) return of_square(radius);
  SquareBound bound;
  const int grid = radius == 0 ? 0 : kernel::trailing_exponent(radius);
  const Integer root = kernel::scaled_integer(radius, grid);
  bound.exact_ = root * root;
  bound.exponent_ = 2 * grid;
  bound.above_ = kernel::double_above(bound.exact_, 1, bound.exponent_);
  bound.below_ = -kernel::double_above(-bound.exact_, 1, bound.exponent_) + 0.0;
  return bound;
}

SquareBound SquareBound::of_square(double square) {
  SquareBound bound;
  bound.above_ = bound.below_ = square;
  if (square == 0 || !std::isfinite(square)) return bound;
  bound.exponent_ = kernel::trailing_exponent(square);
  bound.exact_ = kernel::scaled_integer(square, bound.exponent_);
  return bound;
}

bool SquareBound::admits(const Integer& numerator, const Integer& denominator, int exponent) const {
  const int grid = std::min(exponent, exponent_);
  return (numerator << (exponent - grid)) <= (exact_ << (exponent_ - grid)) * denominator;
}

ExactOrthosphere::ExactOrthosphere(const double* const* points, std::size_t corners, std::size_t dimension,
                                   bool weighted) {
  std::vector<double> weights;
  for (std::size_t i = 0; weighted && i < corners; ++i) weights.push_back(points[i][dimension]);
  const solve::IntegerEdges integers({points, corners}, weights, dimension);
  grid_ = integers.grid;
  kernel::Fractions solution = integers.solve_gram(integers.rights);
  determinant_ = std::move(solution.denominator);
  if (determinant_ == 0) return;
  square_ = 0;
  if (weighted) square_ = -4 * determinant_ * kernel::scaled_integer(weights[0], 2 * grid_);
  Integer rest = 2 * determinant_;
  for (std::size_t i = 0; i < integers.rights.size(); ++i) {
    square_ += integers.rights[i] * solution.numerators[i];
    rest -= solution.numerators[i];
  }
  twice_.push_back(std::move(rest));
  for (Integer& numerator : solution.numerators) twice_.push_back(std::move(numerator));
}

std::uint64_t ExactOrthosphere::beyond() const {
  std::uint64_t result = 0;
  for (std::size_t i = 0; i < twice_.size(); ++i)
    if (twice_[i] < 0) result |= std::uint64_t{1} << i;
  return result;
}

double ExactOrthosphere::square_above() const {
  if (determinant_ == 0) return std::numeric_limits<double>::quiet_NaN();
  return kernel::double_above(square_, 4 * determinant_, 2 * grid_);
}

bool ExactOrthosphere::is_within(const SquareBound& bound) const {
  return determinant_ != 0 && bound.admits(square_, 4 * determinant_, 2 * grid_);
}

double ExactOrthosphere::radius_above() const {
  if (determinant_ == 0) return std::numeric_limits<double>::quiet_NaN();
  return kernel::root_above(square_, 4 * determinant_, grid_);
}

}  // namespace delone::internal
