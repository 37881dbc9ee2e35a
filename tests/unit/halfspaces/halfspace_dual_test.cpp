// SPDX-License-Identifier: BSD-3-Clause
// Dual points against exact rationals.
#include "halfspaces/halfspace_dual.hpp"

#include "base/infinity.hpp"
#include "degenerate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace delone::halfspaces {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using ::testing::ElementsAre;

Rational coordinate(const InteriorPoint& p, std::size_t j) {
  if (p.is_exact()) return Rational(p.rounded[j]);
  const Rational unit = p.exponent < 0 ? 1 / Rational(boost::multiprecision::cpp_int(1) << -p.exponent)
                                       : Rational(boost::multiprecision::cpp_int(1) << p.exponent);
  return Rational(boost::multiprecision::cpp_int(p.numerators[j])) /
         Rational(boost::multiprecision::cpp_int(p.denominator)) * unit;
}

std::vector<double> dual_of(const std::vector<double>& row, const InteriorPoint& p) {
  std::vector<int> axes(p.rounded.size());
  std::iota(axes.begin(), axes.end(), 0);
  std::vector<double> dual(2 * axes.size());
  dual_point(row.data(), p, axes, dual.data());
  return dual;
}

/// Leading and second part are within 2⁻⁶⁸ of n_j/−(n·p + c); the leading one alone within one unit.
void expect_close(const std::vector<double>& row, const InteriorPoint& p) {
  const std::size_t d = p.rounded.size();
  const std::vector<double> dual = dual_of(row, p);
  Rational s = -Rational(row[d]);
  for (std::size_t j = 0; j < d; ++j) s -= Rational(row[j]) * coordinate(p, j);
  ASSERT_GT(s, 0);
  for (std::size_t j = 0; j < d; ++j) {
    const Rational exact = Rational(row[j]) / s;
    const Rational error = abs(exact - Rational(dual[j]) - Rational(dual[d + j]));
    EXPECT_LE(error, abs(exact) * Rational(0x1p-68)) << j;
    EXPECT_LE(abs(Rational(dual[d + j])), abs(exact) * Rational(0x1p-52)) << j;
  }
}

TEST(CommonExponent, IsTheFinest) {
  EXPECT_EQ(common_exponent(std::vector<double>{12, 0, -40}), 2);
  EXPECT_EQ(common_exponent(std::vector<double>{12, 0.75}), -2);
  EXPECT_EQ(common_exponent(std::vector<double>{0x1p-1074, 0x1p1023}), -1074);
  EXPECT_EQ(common_exponent(std::vector<double>{0, -0.0}), 0);
}

TEST(IntegerRow, DividesByAPowerOfTwo) {
  const double row[] = {0.5, 3, 0, -0.25};
  EXPECT_THAT(integer_row(row, 4), ElementsAre(2, 12, 0, -1));
  const double even[] = {12, -8};
  EXPECT_THAT(integer_row(even, 2), ElementsAre(3, -2));
  const double zeros[] = {0, 0};
  EXPECT_THAT(integer_row(zeros, 2), ElementsAre(0, 0));
  const double ends[] = {0x1p-1074, 0x1p1023};
  EXPECT_THAT(integer_row(ends, 2), ElementsAre(1, kernel::Integer(1) << 2097));
}

TEST(DualPoint, OfKnownRows) {
  EXPECT_THAT(dual_of({1, 0, -2}, {{0, 0}, {}}), ElementsAre(0.5, 0, 0, 0));
  EXPECT_THAT(dual_of({3, -4, -4}, {{0, 1}, {}}), ElementsAre(0.375, -0.5, 0, 0));
  // 1/3 is a double and what that leaves: 1/3 − double(1/3) = double(1/3)·2⁻⁵⁴.
  EXPECT_THAT(dual_of({1, -3}, {{0}, {}}), ElementsAre(1.0 / 3, 1.0 / 3 * 0x1p-54));
}

TEST(DualPoint, TakesTheGivenAxes) {
  const double row[] = {1, 2, 3, -4};
  const InteriorPoint p{{0, 0, 0}, {}};
  const int axes[] = {0, 2};
  double dual[4];
  dual_point(row, p, axes, dual);
  EXPECT_THAT(dual, ElementsAre(0.25, 0.75, 0, 0));
}

TEST(DualPoint, IsWithinItsBound) {
  test::Random random(1);
  for (int run = 0; run < 400; ++run) {
    const std::size_t d = 1 + run % 4;
    const int scale = run % 7 == 0 ? 150 : run % 11 == 0 ? -150 : 0;
    InteriorPoint p;
    std::vector<double> row;
    double sum = 0;
    for (std::size_t j = 0; j < d; ++j) {
      p.rounded.push_back(std::ldexp(random.real() - 0.5, scale));
      row.push_back(random.integer(0, 9) == 0 ? 0 : random.real() - 0.5);
      sum += row.back() * p.rounded.back();
    }
    row.push_back(-sum - std::ldexp(1 + random.real(), scale - random.integer(0, 40)));
    expect_close(row, p);
  }
}

// n·p + c cancels to the last bit, which pairs of doubles do not resolve.
TEST(DualPoint, SurvivesCancellation) {
  const double next = 1 + 0x1p-52;
  expect_close({1, next, -next * next - 0x1p-51}, {{next, next - 1}, {}});
  expect_close({next, -1, -0x1p-104}, {{1, next}, {}});
  expect_close({1, -next}, {{1}, {}});
  // The offset cancels all but the rounding errors of products and sums.
  test::Random random(3);
  for (int run = 0; run < 100; ++run) {
    std::vector<double> row;
    InteriorPoint p;
    double sum = 0;
    Rational exact = 0;
    for (int j = 0; j < 4; ++j) {
      row.push_back(1 + random.real());
      p.rounded.push_back(random.real());
      sum += row.back() * p.rounded.back();
      exact += Rational(row.back()) * Rational(p.rounded.back());
    }
    row.push_back(-sum);
    if (exact > Rational(sum))
      for (double& x : row) x = -x;
    if (exact != Rational(sum)) expect_close(row, p);
  }
}

TEST(DualPoint, SeenFromAFraction) {
  expect_close({3, 3, -3}, {{1.0 / 3, 1.0 / 3}, {1, 1}, 3});
  expect_close({1, 5, -2}, {{0.25, 0.25}, {3, 3}, 3, -2});
  expect_close({1, 5, -100}, {{4, 4}, {3, 3}, 3, 2});
  // (1 + 2⁻⁵³) is strictly between 1 and the next double.
  expect_close({1, -1 - 0x1p-52}, {{1}, {(kernel::Integer(1) << 53) + 1}, kernel::Integer(1) << 53});
}

TEST(DualPoint, AtTheEndsOfTheRange) {
  EXPECT_THAT(dual_of({1e300, -1e-300}, {{0}, {}}), ElementsAre(internal::infinity, 0));
  EXPECT_THAT(dual_of({-1e300, -1e-300}, {{0}, {}}), ElementsAre(-internal::infinity, 0));
  EXPECT_THAT(dual_of({1e-300, -1e300}, {{0}, {}}), ElementsAre(0, 0));
  expect_close({1e300, -1e300, -1e300}, {{0.5, 0.25}, {}});
  expect_close({1e-300, 3e-300, -7e-300}, {{0.5, 0.25}, {}});
  expect_close({0x1p-1074, -0x1p-1073}, {{1}, {}});
  expect_close({1, 1e-250, -1}, {{1e-250, 1}, {}});
  expect_close({3, -1e-301}, {{0}, {}});
}

/// Row by row, bit for bit.
void expect_same_as_one_by_one(const std::vector<double>& rows, const InteriorPoint& p,
                               const std::vector<int>& axes) {
  const std::size_t row_size = p.rounded.size() + 1, width = 2 * axes.size(), count = rows.size() / row_size;
  std::vector<double> together(count * width), single(width);
  dual_points(rows.data(), count, p, axes, together.data());
  for (std::size_t r = 0; r < count; ++r) {
    dual_point(rows.data() + r * row_size, p, axes, single.data());
    for (std::size_t j = 0; j < width; ++j) EXPECT_EQ(together[r * width + j], single[j]) << r << ' ' << j;
  }
}

// Ordinary rows among such that need integers: by cancellation, by their range, and with zeros.
TEST(DualPoints, AreThoseOfSingleRows) {
  test::Random random(5);
  for (const std::size_t d : {1, 2, 3, 4, 7}) {
    for (const std::size_t count : {0, 1, 31, 32, 33, 100}) {
      InteriorPoint p;
      for (std::size_t j = 0; j < d; ++j)
        p.rounded.push_back(random.integer(0, 3) == 0 ? 0 : random.real() - 0.5);
      std::vector<double> rows;
      for (std::size_t r = 0; r < count; ++r) {
        const int scale = random.integer(0, 5) == 0 ? random.integer(-900, 900) : 0;
        double sum = 0;
        for (std::size_t j = 0; j < d; ++j) {
          const double n = random.integer(0, 4) == 0 && j + 1 < d ? 0 : random.real() + 0x1p-20;
          rows.push_back(std::ldexp(n, scale));
          sum += n * p.rounded[j];
        }
        const int gap = random.integer(0, 3) == 0 ? -48 : random.integer(-20, 300);
        rows.push_back(std::ldexp(-sum - std::ldexp(1, std::min(gap, 1000 - scale)), scale));
      }
      std::vector<int> axes(d);
      std::iota(axes.begin(), axes.end(), 0);
      expect_same_as_one_by_one(rows, p, axes);
      expect_same_as_one_by_one(rows, p, {static_cast<int>(d) - 1});
    }
  }
}

TEST(DualPoints, SeenFromFarAway) {
  std::vector<double> rows;
  for (int r = 0; r < 40; ++r) rows.insert(rows.end(), {1.0 + r, -1, -3});
  expect_same_as_one_by_one(rows, {{-0x1p300, 1}, {}}, {0, 1});
}

TEST(DualPoints, SeenFromAFraction) {
  std::vector<double> rows;
  for (int r = 0; r < 40; ++r) rows.insert(rows.end(), {3.0 + r, 3, -3.0 - r});
  expect_same_as_one_by_one(rows, {{1.0 / 3, 1.0 / 3}, {1, 1}, 3}, {0, 1});
}

}  // namespace
}  // namespace delone::halfspaces
