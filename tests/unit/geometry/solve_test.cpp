// SPDX-License-Identifier: BSD-3-Clause
// Functionals by elimination against rationals: values are within the threshold of the true ones in the whole
// box, and signs of determinants are right.
#include "geometry/solve.hpp"

#include "base/random.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace delone::geometry {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using RationalRows = std::vector<std::vector<Rational>>;

/// Solves n equations, n rows of n coefficients and the right-hand side. Empty if they are dependent. Also
/// gives the determinant.
std::vector<Rational> solution(RationalRows a, Rational& determinant) {
  determinant = 1;
  for (std::size_t s = 0; s < a.size(); ++s) {
    std::size_t pivot = s;
    while (pivot < a.size() && a[pivot][s] == 0) ++pivot;
    if (pivot == a.size()) return determinant = 0, std::vector<Rational>();
    if (pivot != s) {
      std::swap(a[pivot], a[s]);
      determinant = -determinant;
    }
    determinant *= a[s][s];
    for (std::size_t r = 0; r < a.size(); ++r) {
      if (r == s) continue;
      const Rational factor = a[r][s] / a[s][s];
      for (std::size_t c = s; c <= a.size(); ++c) a[r][c] -= factor * a[s][c];
    }
  }
  std::vector<Rational> x;
  for (std::size_t s = 0; s < a.size(); ++s) x.push_back(a[s].back() / a[s][s]);
  return x;
}

/// A point of the unit cube: far from the others, on a lattice, or near a plane.
std::vector<double> random_point(int shape, std::size_t k, random::Generator& generator) {
  std::vector<double> x;
  for (std::size_t j = 0; j < k; ++j)
    x.push_back(shape == 1 ? static_cast<double>(generator.below(4)) / 3 : generator.uniform());
  if (shape == 2) x.back() = 0.25 + x[0] / 2 + 1e-12 * generator.uniform();
  if (shape == 3) x.back() = std::nextafter(x[0], static_cast<double>(generator.below(2)));
  return x;
}

/// Finite cells. K is k, or 0 for run time.
template <int K>
void expect_true_functionals(int dimension) {
  const auto k = static_cast<std::size_t>(dimension);
  random::Generator generator(k);
  CellMemory<K> memory(dimension);
  memory.reserve(1);
  Functionals<K> functionals(memory);
  const Frame frame(std::vector<double>(k, 0.0), std::vector<double>(k, 1.0));
  std::vector<int> axes(k);
  std::iota(axes.begin(), axes.end(), 0);
  functionals.set_frame(frame, axes);
  const auto row_of = [&](const std::vector<double>& x) {
    std::vector<double> row;
    for (const int axis : axes) row.push_back(frame.image(x.data(), axis));
    row.push_back(frame.lift(x.data()));
    return row;
  };
  const auto true_row = [&](const std::vector<double>& x) {
    std::vector<Rational> row;
    Rational lift = 0;
    for (std::size_t j = 0; j < k; ++j) {
      const Rational difference = Rational(x[j]) - Rational(frame.center()[j]);
      row.push_back(difference * Rational(frame.scale()[j]));
      lift += difference * difference * Rational(frame.lift_scale()) * Rational(frame.lift_scale());
    }
    row.push_back(lift);
    return row;
  };
  int certified = 0;
  for (std::size_t round = 0; round < test::scaled_count(80); ++round) {
    std::vector<double> rows;
    RationalRows equations;  // of the coefficients and the constant
    for (std::size_t i = 0; i <= k; ++i) {
      const auto x = random_point(static_cast<int>(round % 4), k, generator);
      const auto row = row_of(x);
      rows.insert(rows.end(), row.begin(), row.end());
      equations.push_back(true_row(x));
      equations.back().back() = -equations.back().back();
      equations.back().insert(equations.back().end() - 1, Rational(1));
    }
    const Sign sign = functionals.template solve<false>(0, rows.data(), true);
    Rational determinant;
    const std::vector<Rational> h = solution(equations, determinant);
    if (k % 2 == 1) determinant = -determinant;  // that of (X, 1) to that of edges
    if (sign != Sign::zero) {
      ASSERT_EQ(sign, determinant > 0 ? Sign::positive : determinant < 0 ? Sign::negative : Sign::zero);
    }
    if (std::isinf(functionals.threshold(0))) continue;
    ASSERT_FALSE(h.empty());
    ++certified;
    EXPECT_FALSE(functionals.is_infinite(0));
    for (int i = 0; i < 20; ++i) {
      const auto x = random_point(i % 4, k, generator);
      const auto row = row_of(x);
      const auto exact = true_row(x);
      Rational value = exact[k] + h[k];
      for (std::size_t r = 0; r < k; ++r) value += h[r] * exact[r];
      EXPECT_LE(abs(Rational(functionals.evaluator(row.data()).value(0)) - value),
                Rational(functionals.threshold(0)));
    }
  }
  EXPECT_GE(certified, static_cast<int>(test::scaled_count(80)) / 3);
}

TEST(Solve, FunctionalsOfFiniteCellsAreWithinTheirThresholds) {
  expect_true_functionals<2>(2);
  expect_true_functionals<3>(3);
  expect_true_functionals<0>(4);
}

/// Rows that are not lifted, of a cell whose hyperplane may pass near the origin.
TEST(Solve, FunctionalsOfHullCellsAreWithinTheirThresholds) {
  constexpr std::size_t n = 3;
  random::Generator generator(1);
  CellMemory<2> memory(2);
  memory.reserve(1);
  Functionals<2, false> functionals(memory);
  functionals.set_frame();
  int certified = 0;
  for (std::size_t round = 0; round < test::scaled_count(80); ++round) {
    std::vector<double> rows;
    RationalRows equations;
    for (std::size_t i = 0; i < n; ++i) {
      auto x = random_point(static_cast<int>(round % 4), n, generator);
      for (double& entry : x) entry = 2 * entry - 1;
      rows.insert(rows.end(), x.begin(), x.end());
      equations.emplace_back(x.begin(), x.end());
      equations.back().push_back(-1);
    }
    functionals.solve(0, rows.data());
    if (std::isinf(functionals.threshold(0))) continue;
    ++certified;
    Rational determinant;
    const std::vector<Rational> g = solution(equations, determinant);
    ASSERT_FALSE(g.empty());
    for (int i = 0; i < 20; ++i) {
      auto x = random_point(i % 4, n, generator);
      Rational value = 1;
      for (std::size_t r = 0; r < n; ++r) {
        x[r] = 2 * x[r] - 1;
        value += g[r] * Rational(x[r]);
      }
      EXPECT_LE(abs(Rational(functionals.evaluator(x.data()).value(0)) - value),
                Rational(functionals.threshold(0)));
    }
  }
  EXPECT_GE(certified, static_cast<int>(test::scaled_count(80)) / 3);
}

}  // namespace
}  // namespace delone::geometry
