// SPDX-License-Identifier: BSD-3-Clause
// Vertices against exact rationals; normals, directions and lines of known systems.
#include "halfspaces/halfspace_vertex.hpp"

#include "base/infinity.hpp"
#include "degenerate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace delone::halfspaces {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Rows = std::vector<std::vector<double>>;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<const double*> pointers(const Rows& rows) {
  std::vector<const double*> result;
  for (const std::vector<double>& row : rows) result.push_back(row.data());
  return result;
}

std::vector<int> all_columns(const Rows& rows) {
  std::vector<int> columns(rows[0].size());
  std::iota(columns.begin(), columns.end(), 0);
  return columns;
}

std::vector<double> meeting(const Rows& rows) {
  std::vector<double> x(rows.size());
  meeting_point(pointers(rows), all_columns(rows), x.data());
  return x;
}

/// The solution by Gauss–Jordan elimination; empty if the rows are dependent.
std::vector<Rational> solve(const Rows& rows) {
  const std::size_t n = rows.size();
  std::vector<std::vector<Rational>> a(n, std::vector<Rational>(n + 1));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= n; ++j) a[i][j] = Rational(j < n ? rows[i][j] : -rows[i][j]);
  for (std::size_t s = 0; s < n; ++s) {
    std::size_t pivot = s;
    while (pivot < n && a[pivot][s] == 0) ++pivot;
    if (pivot == n) return {};
    std::swap(a[s], a[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      const Rational factor = i == s ? Rational(0) : a[i][s] / a[s][s];
      for (std::size_t j = s; j <= n && factor != 0; ++j) a[i][j] -= factor * a[s][j];
    }
  }
  std::vector<Rational> x;
  for (std::size_t s = 0; s < n; ++s) x.push_back(a[s][n] / a[s][s]);
  return x;
}

/// No neighboring double is closer, and of two that are equally close the even one is taken.
void expect_nearest(double x, const Rational& exact) {
  const Rational error = abs(Rational(x) - exact);
  for (const double end : {-internal::infinity, internal::infinity}) {
    const Rational other = abs(Rational(std::nextafter(x, end)) - exact);
    EXPECT_LE(error, other) << x;
    if (error == other) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(x) & 1, 0u) << x;
    }
  }
}

TEST(MeetingPoint, OfKnownLines) {
  EXPECT_THAT(meeting({{3, -1}}), ElementsAre(1.0 / 3));
  EXPECT_THAT(meeting({{1, 1, -3}, {1, -1, -1}}), ElementsAre(2, 1));
  EXPECT_THAT(meeting({{0, 0, 2, -1}, {0, 5, 0, -1}, {10, 0, 0, 1}}), ElementsAre(-0.1, 0.2, 0.5));
}

TEST(MeetingPoint, TakesTheGivenColumns) {
  const Rows rows = {{7, 2, 7, -4}};
  double x = 0;
  meeting_point(pointers(rows), std::vector<int>{1, 3}, &x);
  EXPECT_EQ(x, 2);
}

TEST(MeetingPoint, IsNeverMinusZero) {
  for (const double x : meeting({{1, 1, 0}, {-1, 1, 0}})) EXPECT_FALSE(std::signbit(x));
  for (const double x : meeting({{-1e300, 1, 0.0}, {1, 1e300, -0.0}})) EXPECT_FALSE(std::signbit(x));
}

// x = 1 + 2⁻⁵³ and x = 1 + 3·2⁻⁵³ are halfway between doubles.
TEST(MeetingPoint, RoundsTiesToEven) {
  EXPECT_THAT(meeting({{1, 1, -1}, {0, 1, 0x1p-53}}), ElementsAre(1, -0x1p-53));
  EXPECT_THAT(meeting({{1, 1, -1 - 0x1p-52}, {0, 1, 0x1p-53}}), ElementsAre(1 + 0x1p-51, -0x1p-53));
  EXPECT_THAT(meeting({{1, 1, -1}, {0, 1, 0x1p-53 + 0x1p-105}}), ElementsAre(1 + 0x1p-52, ::testing::_));
}

TEST(MeetingPoint, AtTheEndsOfTheRange) {
  EXPECT_THAT(meeting({{1e-300, -1e300}}), ElementsAre(internal::infinity));
  EXPECT_THAT(meeting({{1e-300, 1e300}}), ElementsAre(-internal::infinity));
  EXPECT_THAT(meeting({{1e300, -1e-300}}), ElementsAre(0));
  EXPECT_THAT(meeting({{0x1p-1074, -0x1p-1073}}), ElementsAre(2));
  EXPECT_THAT(meeting({{0x1p1000, 0x1p-80, 0}, {0, 1, -0x1p199}}), ElementsAre(-0x1p-881, 0x1p199));
  const Rows mixed = {{1e300, 0, -1}, {1e300, 1e-300, -2}};
  const std::vector<Rational> exact = solve(mixed);
  for (std::size_t j = 0; j < 2; ++j) expect_nearest(meeting(mixed)[j], exact[j]);
}

TEST(MeetingPoint, IsCorrectlyRounded) {
  test::Random random(2);
  for (int run = 0; run < 500; ++run) {
    const std::size_t n = 1 + run % 5;
    Rows rows(n);
    for (auto& row : rows)
      for (std::size_t j = 0; j <= n; ++j)
        row.push_back(run % 3 == 0   ? random.integer(-9, 9)
                      : run % 3 == 1 ? random.real() - 0.5
                                     : 1 + 0x1p-40 * random.integer(-9, 9));  // nearly parallel
    const std::vector<Rational> exact = solve(rows);
    if (exact.empty()) continue;
    const std::vector<double> x = meeting(rows);
    for (std::size_t j = 0; j < n; ++j) expect_nearest(x[j], exact[j]);
  }
}

// Blocks of vertices, by SIMD where the dimension has a kernel, give the same doubles as single ones.
TEST(MeetingPoints, AreThoseOfEach) {
  test::Random random(3);
  for (std::size_t n = 1; n <= 6; ++n) {
    Rows rows;
    while (rows.size() < 40 * n) {
      const int kind = random.integer(0, 5);
      Rows system(n);
      for (auto& row : system) {
        const double scale = kind == 4 ? std::ldexp(1.0, random.integer(-1000, 1000)) : 1;
        for (std::size_t j = 0; j <= n; ++j)
          row.push_back(scale * (kind == 0   ? random.integer(-3, 3)
                                 : kind == 1 ? 1 + 0x1p-45 * random.integer(-9, 9)
                                 : kind == 5 ? std::ldexp(random.real() - 0.5, random.integer(-300, 300))
                                             : random.real() - 0.5));
      }
      if (kind == 2)
        for (auto& row : system) row.back() = 0;  // all through the origin
      if (kind > 1 || !solve(system).empty()) rows.insert(rows.end(), system.begin(), system.end());
    }
    const std::vector<const double*> all = pointers(rows);
    const std::vector<int> columns = all_columns(Rows(1, rows[0]));
    const std::vector<double> points = meeting_points(all, columns);
    ASSERT_EQ(points.size(), rows.size());
    for (std::size_t p = 0; p * n < rows.size(); ++p) {
      std::vector<double> x(n);
      meeting_point(std::span(all).subspan(p * n, n), columns, x.data());
      for (std::size_t j = 0; j < n; ++j) {
        EXPECT_EQ(points[p * n + j], x[j]) << n << ' ' << p;
        EXPECT_EQ(std::signbit(points[p * n + j]), std::signbit(x[j]));
      }
    }
  }
  EXPECT_THAT(meeting_points({}, std::vector<int>{0, 1, 2}), IsEmpty());
}

TEST(ConeNormal, IsTheCrossProduct) {
  const Rows rows = {{1, 0, 0}, {0, 0.5, 0}};
  EXPECT_THAT(cone_normal(pointers(rows), std::vector<int>{0, 1, 2}), ElementsAre(0, 0, 1));
  const Rows swapped = {{0, 0.5, 0}, {1, 0, 0}};
  EXPECT_THAT(cone_normal(pointers(swapped), std::vector<int>{0, 1, 2}), ElementsAre(0, 0, -1));
  const Rows dependent = {{1, 2, 3}, {2, 4, 6}};
  EXPECT_THAT(cone_normal(pointers(dependent), std::vector<int>{0, 1, 2}), ElementsAre(0, 0, 0));
  const Rows line = {{9, 3, 9, -5}};
  EXPECT_THAT(cone_normal(pointers(line), std::vector<int>{1, 3}), ElementsAre(5, 3));
}

TEST(UnitVector, LiesOnItsAxes) {
  const std::vector<kernel::Integer> entries = {3, -4};
  EXPECT_THAT(unit_vector(entries, std::vector<int>{0, 2}, 4), ElementsAre(0.6, 0, -0.8, 0));
  const std::vector<kernel::Integer> huge = {-(kernel::Integer(1) << 5000), 1};
  EXPECT_THAT(unit_vector(huge, std::vector<int>{0, 1}, 2), ElementsAre(-1, 0));
}

TEST(LinealityBasis, SpansTheKernel) {
  const auto near = [](double x) { return DoubleNear(x, 1e-15); };
  const Rows rows = {{1, 1, 0, 5}};
  EXPECT_THAT(lineality_basis(pointers(rows), std::vector<int>{0}, 3),
              ElementsAre(near(-std::sqrt(0.5)), near(std::sqrt(0.5)), 0, 0, 0, 1));
  EXPECT_THAT(lineality_basis({}, {}, 2), ElementsAre(1, 0, 0, 1));  // no rows: all of space
  const Rows all = {{1, 2, 0}, {3, 4, 0}};
  EXPECT_THAT(lineality_basis(pointers(all), std::vector<int>{0, 1}, 2), IsEmpty());
  const Rows two = {{2, 0, 1, 0}, {0, 4, -1, 0}};  // x = −z/2, y = z/4
  EXPECT_THAT(lineality_basis(pointers(two), std::vector<int>{0, 1}, 3),
              ElementsAre(near(-2 / std::sqrt(21)), near(1 / std::sqrt(21)), near(4 / std::sqrt(21))));
}

}  // namespace
}  // namespace delone::halfspaces
