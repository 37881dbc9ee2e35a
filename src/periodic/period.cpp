// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/period.hpp"

#include "kernel/grid.hpp"
#include "periodic/lattice_reduction.hpp"

#include <algorithm>
#include <limits>

namespace delone::periodic {

using kernel::Integer;

namespace {

/// Points farther away, in periods, are refused, so that offsets have 32 bits.
constexpr double most_periods = 0x1p29;

}  // namespace

Period::Period(std::vector<double> vectors, std::size_t rank, std::size_t dimension)
    : rank_(rank), dimension_(dimension), vectors_(std::move(vectors)), gradients_(rank * dimension) {
  IntegerRows rows = integers_of(vectors_);
  grid_ = rows.grid;
  integers_ = std::move(rows.entries);
  gram_ = gram_matrix(integers_, rank_);
  if (rank_ > 0) determinant_ = kernel::exact_determinant(gram_, rank_);
  // The gradients g solve G·g = a, column by column, G the Gram matrix.
  for (std::size_t j = 0; j < dimension_ && rank_ > 0; ++j) {
    std::vector<Integer> augmented;
    for (std::size_t i = 0; i < rank_; ++i) {
      for (std::size_t l = 0; l < rank_; ++l) augmented.push_back(gram_[i * rank_ + l]);
      augmented.push_back(integers_[i * dimension_ + j]);
    }
    const kernel::Fractions solution = kernel::solve_exactly(std::move(augmented), rank_);
    for (std::size_t i = 0; i < rank_; ++i)
      gradients_[i * dimension_ + j] =
          kernel::nearest_double(solution.numerators[i], solution.denominator, -grid_);
  }
  double squares = 0;
  shortest_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < rank_; ++i) {
    double square = 0;
    for (std::size_t j = 0; j < dimension_; ++j) square += vector(i)[j] * vector(i)[j];
    squares += square;
    shortest_ = std::min(shortest_, std::sqrt(square));
  }
  for (std::size_t i = 0; i < rank_; ++i) {
    double square = 0;
    for (std::size_t j = 0; j < dimension_; ++j) square += gradient(i)[j] * gradient(i)[j];
    lengths_.push_back(std::sqrt(square));
    const double reach = std::ceil(std::sqrt(squares) * lengths_[i] * (1 + 0x1p-40));
    reaches_.push_back(static_cast<int>(std::min(reach, 0x1p20)));
  }
}

Integer Period::floor_of_fraction(std::size_t i, const double* x) const {
  int grid = grid_;
  for (std::size_t j = 0; j < dimension_; ++j) grid = std::min(grid, kernel::trailing_exponent(x[j]));
  // In units of 2^grid, the row i of the Gram matrix is replaced by the products with x (Cramer).
  std::vector<Integer> replaced = gram_;
  for (std::size_t l = 0; l < rank_; ++l) {
    Integer product = 0;
    for (std::size_t j = 0; j < dimension_; ++j)
      product += integers_[l * dimension_ + j] * kernel::scaled_integer(x[j], grid);
    replaced[i * rank_ + l] = std::move(product);
  }
  const Integer numerator = kernel::exact_determinant(std::move(replaced), rank_);
  const Integer denominator = determinant_ << (grid_ - grid);
  Integer quotient = numerator / denominator;
  if (quotient * denominator > numerator) quotient -= 1;
  return quotient;
}

bool Period::is_inside(const double* x) const {
  for (std::size_t i = 0; i < rank_; ++i) {
    const double at = fraction(i, x), slack = fraction_slack(i, x);
    if (!(at > slack && at < 1 - slack)) return false;
  }
  return true;
}

bool Period::wrap(int grid, double* x, std::int32_t* wraps) const {
  if (is_inside(x)) return true;
  // A step leaves a fraction that is off by its slack. Where that is large because the lattice is oblique to
  // a direction in which x is far away, steps may not end.
  constexpr int most_steps = 16;
  std::vector<std::int32_t> step(rank_);
  bool is_near = false;
  for (int steps = 0; !is_near; ++steps) {
    if (steps == most_steps) return false;
    is_near = true;
    for (std::size_t i = 0; i < rank_; ++i) {
      const double periods = std::floor(fraction(i, x));
      if (!(std::abs(periods + wraps[i]) < most_periods)) return false;
      step[i] = static_cast<std::int32_t>(periods);
      is_near = is_near && std::abs(step[i]) <= reach(i);
    }
    subtract(step, is_near, grid, x);
    for (std::size_t i = 0; i < rank_; ++i) wraps[i] += step[i];
  }
  for (std::size_t i = 0; i < rank_; ++i) {
    const double at = fraction(i, x), slack = fraction_slack(i, x);
    if (at > slack && at < 1 - slack) continue;
    const Integer floor = floor_of_fraction(i, x);
    if (abs(floor) > reach(i)) return false;
    step.assign(rank_, 0);
    step[i] = static_cast<std::int32_t>(floor);
    subtract(step, true, grid, x);
    wraps[i] += step[i];
  }
  return true;
}

/// Far from the box the difference is made in integers.
void Period::subtract(std::span<const std::int32_t> step, bool is_near, int grid, double* x) const {
  for (std::size_t j = 0; j < dimension_; ++j) {
    if (is_near) {
      for (std::size_t i = 0; i < rank_; ++i) x[j] -= step[i] * vector(i)[j];
      continue;
    }
    const int finest = std::min(grid, kernel::trailing_exponent(x[j]));
    Integer sum = kernel::scaled_integer(x[j], finest);
    for (std::size_t i = 0; i < rank_; ++i) sum -= step[i] * kernel::scaled_integer(vector(i)[j], finest);
    x[j] = kernel::nearest_double(sum, 1, finest);
  }
}

}  // namespace delone::periodic
