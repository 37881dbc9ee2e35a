// SPDX-License-Identifier: BSD-3-Clause
// Orthospheres in integers, and the bounds that they are compared with, against rationals.
#include "faces/exact_orthosphere.hpp"

#include "degenerate.hpp"
#include "orthosphere_brute_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace delone::internal {
namespace {

using test::Rational;

constexpr double no_limit = std::numeric_limits<double>::infinity();

TEST(SquareBound, SquaresOfRadiiAreBracketed) {
  for (const double radius : {0.0, 1.0, 3.0, 0.1, 1.0 / 3, 1e100, 1e-100, 0x1.fffffffffffffp+400})
    for (const double r : {radius, std::nextafter(radius, 1e300)}) {
      const SquareBound bound = SquareBound::of_radius(r);
      const Rational exact = Rational(r) * Rational(r);
      EXPECT_TRUE(test::is_rounded_up(bound.above(), exact)) << r;
      EXPECT_LE(Rational(bound.below()), exact) << r;
      EXPECT_GT(Rational(std::nextafter(bound.below(), no_limit)), exact) << r;
      EXPECT_EQ(bound.admits(bound.below()), SquareBound::Answer::yes) << r;
      EXPECT_EQ(bound.admits(std::nextafter(bound.above(), no_limit)), SquareBound::Answer::no) << r;
      if (bound.below() < bound.above()) {
        EXPECT_EQ(bound.admits(bound.above()), SquareBound::Answer::unsure) << r;
      }
    }
  EXPECT_EQ(SquareBound::of_radius(no_limit).admits(1e308), SquareBound::Answer::yes);
  EXPECT_EQ(SquareBound::of_square(-no_limit).admits(-1e308), SquareBound::Answer::no);
}

TEST(SquareBound, FractionsAreComparedExactly) {
  for (const double square : {0.0, -2.5, 0.1, 7.0, 0x1p-300, 3e200}) {
    const SquareBound bound = SquareBound::of_square(square);
    for (int numerator = -9; numerator <= 9; numerator += 3)
      for (const int denominator : {1, 4, 7})
        for (const int exponent : {-310, -3, 0, 5, 660}) {
          const Rational power = exponent < 0 ? Rational(1, kernel::Integer(1) << -exponent)
                                              : Rational(kernel::Integer(1) << exponent);
          EXPECT_EQ(bound.admits(numerator, denominator, exponent),
                    Rational(numerator, denominator) * power <= Rational(square))
              << square << " " << numerator << "/" << denominator << " " << exponent;
        }
  }
}

void expect_exact_sphere(const test::WeightedPoints& points, bool weighted) {
  const std::size_t corners = points.size(), d = points[0].size() - 1;
  std::vector<const double*> pointers;
  for (const auto& p : points) pointers.push_back(p.data());
  std::vector<std::size_t> rows(corners);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const auto expected = test::smallest_orthosphere(points, rows);
  const ExactOrthosphere sphere(pointers.data(), corners, d, weighted);
  if (!expected) {
    EXPECT_TRUE(std::isnan(sphere.square_above()) && std::isnan(sphere.radius_above()));
    EXPECT_EQ(sphere.beyond(), 0u);
    EXPECT_FALSE(sphere.is_within(SquareBound::of_square(1e300)));
    return;
  }
  std::uint64_t beyond = 0;
  for (std::size_t i = 0; i < corners; ++i)
    if (expected->barycentric[i] < 0) beyond |= std::uint64_t{1} << i;
  EXPECT_EQ(sphere.beyond(), beyond);
  EXPECT_TRUE(test::is_rounded_up(sphere.square_above(), expected->square));
  for (const double bound : {sphere.square_above(), std::nextafter(sphere.square_above(), -no_limit), 0.0})
    EXPECT_EQ(sphere.is_within(SquareBound::of_square(bound)), expected->square <= Rational(bound));
  if (expected->square < 0) return;
  const double radius = sphere.radius_above();
  EXPECT_GE(Rational(radius) * Rational(radius), expected->square);
  if (radius > 0) {
    const Rational before(std::nextafter(radius, 0.0));
    EXPECT_LT(before * before, expected->square);
  }
}

TEST(ExactOrthosphere, SmallIntegersAndUnevenNumbers) {
  test::Random random(3);
  for (std::size_t d = 1; d <= 4; ++d)
    for (std::size_t corners = 1; corners <= d + 1; ++corners)
      for (const bool weighted : {false, true})
        for (const bool is_integer : {true, false})  // of integers many are dependent, and many have ties
          for (int round = 0; round < 8; ++round) {
            test::WeightedPoints points(corners, std::vector<double>(d + 1, 0.0));
            for (auto& p : points)
              for (std::size_t j = 0; j < d + (weighted ? 1 : 0); ++j)
                p[j] = is_integer ? random.integer(-2, 2) : random.real() - 0.5;
            expect_exact_sphere(points, weighted);
          }
}

TEST(ExactOrthosphere, NumbersOfVeryDifferentSizes) {
  expect_exact_sphere({{0x1p-500, 0, 0}, {1, 0x1p-40, 0}, {0, 1, 0}}, false);
  expect_exact_sphere({{0, 0, 0x1p-60}, {0x1p60, 0, 0}, {0, 0x1p60, 0x1p70}}, true);
}

}  // namespace
}  // namespace delone::internal
