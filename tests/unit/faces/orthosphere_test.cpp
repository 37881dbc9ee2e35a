// SPDX-License-Identifier: BSD-3-Clause
// Smallest orthospheres of simplices: squares rounded up and signs, against rationals; that bounds in
// binary64 and small lattices need no integers.
#include "faces/orthosphere.hpp"

#include "orthosphere_brute_force.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <random>

namespace delone::internal {
namespace {

using test::Rational;
using test::WeightedPoints;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Compares all that is asked with rationals. Returns how many answers needed integers.
std::uint64_t expect_exact(const WeightedPoints& points, bool weighted, int unit) {
  const std::size_t d = points[0].size() - 1, corners = points.size();
  std::vector<std::size_t> rows(corners);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const auto exact = test::smallest_orthosphere(points, rows);
  if (!exact) return 0;
  std::vector<const double*> pointers;
  for (const auto& p : points) pointers.push_back(p.data());
  Orthospheres spheres(static_cast<int>(d), weighted, unit, corners);
  const auto answer = spheres.find(pointers.data(), Orthospheres::Want::both);
  EXPECT_TRUE(test::is_rounded_up(answer.square, exact->square)) << answer.square << " " << exact->square;
  std::uint64_t beyond = 0;
  for (std::size_t i = 0; i < corners; ++i)
    if (exact->barycentric[i] < 0) beyond |= std::uint64_t{1} << i;
  EXPECT_EQ(answer.beyond, corners > 1 ? beyond : 0);
  const std::uint64_t used = spheres.num_exact();
  for (const double bound : {answer.square, std::nextafter(answer.square, -infinity),
                             std::nextafter(answer.square, infinity), 0.0, infinity, -infinity}) {
    const bool expected = bound == infinity || (bound > -infinity && exact->square <= Rational(bound));
    EXPECT_EQ(spheres.is_within(pointers.data(), SquareBound::of_square(bound)), expected) << bound;
  }
  const double root = std::sqrt(std::fabs(answer.square));
  for (const double radius : {root, std::nextafter(root, 0.0), std::nextafter(root, infinity), root / 2, 0.0})
    if (std::isfinite(radius)) {
      EXPECT_EQ(spheres.is_within(pointers.data(), SquareBound::of_radius(radius)),
                exact->square <= Rational(radius) * Rational(radius))
          << radius;
    }
  EXPECT_TRUE(spheres.is_within(pointers.data(), SquareBound::of_radius(infinity)));
  return used;
}

WeightedPoints random_points(std::size_t corners, std::size_t d, bool weighted, double scale,
                             std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  WeightedPoints points(corners, std::vector<double>(d + 1, 0.0));
  for (auto& p : points) {
    for (std::size_t j = 0; j < d; ++j) p[j] = scale * uniform(random);
    if (weighted) p[d] = scale * scale * uniform(random);
  }
  return points;
}

TEST(Orthospheres, RandomSimplicesNeedNoIntegers) {
  std::mt19937_64 random(1);
  std::uint64_t exact = 0, count = 0;
  for (std::size_t d = 1; d <= 6; ++d)
    for (std::size_t corners = 1; corners <= d + 1; ++corners)
      for (std::size_t round = 0; round < test::scaled_count(10); ++round) {
        exact += expect_exact(random_points(corners, d, round % 2 == 1, 1, random), round % 2 == 1, -1100);
        ++count;
      }
  EXPECT_LE(20 * exact, count);
}

TEST(Orthospheres, ExtremeScales) {
  std::mt19937_64 random(2);
  for (const double scale : {1e-300, 1e-150, 1e40, 1e160, 1e307})
    for (std::size_t d = 1; d <= 4; ++d)
      for (std::size_t corners = 2; corners <= d + 1; ++corners) {
        expect_exact(random_points(corners, d, false, scale, random), false, -1100);
        if (scale * scale > 0 && std::isfinite(scale * scale))
          expect_exact(random_points(corners, d, true, scale, random), true, -1100);
      }
}

TEST(Orthospheres, NearlyFlatSimplices) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int power = 1; power < 60; power += 4)
    for (std::size_t d = 2; d <= 4; ++d) {
      WeightedPoints points = random_points(d + 1, d, power % 8 == 1, 1, random);
      for (std::size_t j = 0; j < d; ++j)  // moved to the middle of the others
        points[d][j] = (points[0][j] + points[1][j]) / 2 + std::ldexp(uniform(random), -power);
      expect_exact(points, power % 8 == 1, -1100);
    }
}

TEST(Orthospheres, NothingIsRoundedOnSmallLattices) {
  std::mt19937_64 random(4);
  // Units from 2^-100 to 2^100 count as small lattices; all others are exact, too.
  for (const int unit : {-7, 0, 3, -100, 100, -101, 101, -200, 200, -400, 400})
    for (std::size_t d = 1; d <= 8; ++d)
      for (std::size_t corners = 2; corners <= std::min<std::size_t>(d + 1, 4); ++corners)
        for (std::size_t round = 0; round < test::scaled_count(std::abs(unit) < 10 ? 8 : 2); ++round) {
          const bool weighted = round % 2 == 1;
          const int most = 1 << (corners == 2 ? 11 : corners == 3 ? 6 : 4), some = round % 4 < 2 ? most : 2;
          WeightedPoints points(corners, std::vector<double>(d + 1, 0.0));
          for (auto& p : points) {
            for (std::size_t j = 0; j < d; ++j)
              p[j] = std::ldexp(static_cast<double>(random() % static_cast<unsigned>(some + 1)) + 1000, unit);
            if (weighted)
              p[d] = std::ldexp(
                  static_cast<double>(random() % static_cast<unsigned>(some * some / 2)) - some * some / 4,
                  2 * unit);
          }
          const std::uint64_t exact = expect_exact(points, weighted, unit);
          EXPECT_TRUE(exact == 0 || std::abs(unit) > largest_lattice_exponent);
        }
}

TEST(Orthospheres, UnitsCancel) {
  // A corner of a cube: its center is that of the cube, on a lattice of which products leave the range.
  for (const int unit : {-500, -400, -200, -130, -101, -100, 0, 100, 101, 130, 200, 400}) {
    const double s = std::ldexp(1.0, unit);
    const double points[4][3] = {{0, 0, 0}, {s, 0, 0}, {0, s, 0}, {0, 0, s}};
    const double* const pointers[4] = {points[0], points[1], points[2], points[3]};
    const auto answer = Orthospheres(3, false, unit, 4).find(pointers, Orthospheres::Want::both);
    EXPECT_EQ(answer.square, 0.75 * s * s) << unit;
    EXPECT_EQ(answer.beyond, 1u) << unit;
  }
}

TEST(Orthospheres, DependentVerticesHaveNone) {
  const double x = 1.0 / 3;
  for (const int unit : {0, -1100})
    for (const double step : {1.0, x}) {
      if (unit == 0 && step == x) continue;
      const double points[4][3] = {{0, 0, 0}, {step, step, 0}, {2 * step, 2 * step, 0}, {0, 0, 0}};
      for (const std::size_t corners : {3, 4}) {
        const double* const pointers[4] = {points[0], points[1], points[2], points[3]};
        Orthospheres spheres(3, false, unit, corners);
        const auto answer = spheres.find(pointers, Orthospheres::Want::both);
        EXPECT_TRUE(std::isnan(answer.square));
        EXPECT_EQ(answer.beyond, 0u);
        EXPECT_FALSE(spheres.is_within(pointers, SquareBound::of_square(100)));
        Orthospheres::Answer block;
        spheres.find_block(1, pointers, Orthospheres::Want::square, &block);
        EXPECT_TRUE(std::isnan(block.square));
      }
    }
}

TEST(Orthospheres, TiesOffTheLattice) {
  // Right angles, and squares of radii that are doubles, among points with many digits.
  const double x = 1.0 / 3, y = 0x1p-30;
  expect_exact({{x, x, 0}, {x + y, x, 0}, {x, x + y, 0}}, false, -1100);
  expect_exact({{x, x, x, 0}, {x + y, x, x, 0}, {x, x + y, x, 0}, {x, x, x + y, 0}}, false, -1100);
  expect_exact({{0, 0, 0}, {3e10, 0, 0}, {0, 4e10, 0}}, false, -1100);
  expect_exact({{0, 0, 0, 0, 0}, {2, 0, 0, 0, 0}, {0, 2, 0, 0, 0}, {0, 0, 2, 0, 0}, {0, 0, 0, 2, 0}}, false,
               0);
}

TEST(Orthospheres, SquaresInPairsNeedNoIntegers) {
  // Thin simplices, and axes in different units; corners of boxes have squares that are doubles.
  std::mt19937_64 random(6);
  for (std::size_t d = 2; d <= 7; ++d)
    for (std::size_t corners = std::max<std::size_t>(d, 3); corners <= d + 1; ++corners)
      for (const double units : {1.0, 1e4}) {
        WeightedPoints points = random_points(corners, d, false, 1, random);
        for (auto& p : points)
          for (std::size_t j = 0; j < d; ++j) {
            if (corners <= d) p[j] = points[0][j] + 0.001 * (p[j] - points[0][j]);
            if (j % 2 == 1) p[j] *= units;
          }
        std::vector<std::size_t> rows(corners);
        std::iota(rows.begin(), rows.end(), std::size_t{0});
        std::vector<const double*> pointers;
        for (const auto& p : points) pointers.push_back(p.data());
        Orthospheres spheres(static_cast<int>(d), false, -1100, corners);
        const auto answer = spheres.find(pointers.data(), Orthospheres::Want::square);
        EXPECT_TRUE(test::is_rounded_up(answer.square, test::smallest_orthosphere(points, rows)->square));
        if (corners > d) {
          EXPECT_EQ(spheres.num_exact(), 0u) << d;
        }
      }
  const std::vector<double> box{0, 0, 0,   0, 0, 3e6, 0, 0, 0, 0, 0, 5, 0, 0, 0,
                                0, 0, 0.5, 0, 0, 0,   0, 0, 7, 0, 0, 0, 0, 0, 1};
  const double* const corners[6] = {box.data(),      box.data() + 5,  box.data() + 10,
                                    box.data() + 15, box.data() + 20, box.data() + 25};
  for (const bool nearest : {false, true}) {
    Orthospheres spheres(5, false, -1100, 6);
    if (nearest) spheres.let_nearest_be_enough();
    EXPECT_EQ(spheres.find(corners, Orthospheres::Want::square).square, 0.25 * (9e12 + 25 + 0.25 + 49 + 1));
    EXPECT_TRUE(spheres.num_exact() == 0 || !nearest);
  }
}

TEST(SquareBound, OfRadii) {
  for (const double radius : {0.0, 2.5, 1e-200, 1e200, 0.1, 1e-160, 5e-324, 1.7e308}) {
    const SquareBound bound = SquareBound::of_radius(radius);
    const Rational exact = Rational(radius) * Rational(radius);
    EXPECT_TRUE(test::is_rounded_up(bound.above(), exact));
    EXPECT_TRUE(test::is_rounded_up(-bound.below(), -exact));
    EXPECT_FALSE(std::signbit(bound.below()));
  }
  EXPECT_EQ(SquareBound::of_radius(2.5).below(), 6.25);
  EXPECT_EQ(SquareBound::of_radius(2.5).above(), 6.25);
}

}  // namespace
}  // namespace delone::internal
