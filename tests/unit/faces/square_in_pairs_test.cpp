// SPDX-License-Identifier: BSD-3-Clause
// Squared radii in pairs of doubles against rationals: within the error that they come with.
#include "faces/square_in_pairs.hpp"

#include "degenerate.hpp"
#include "orthosphere_brute_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

namespace delone::internal {
namespace {

/// Points, each with a weight of 0 behind it. Returns whether the square was certain.
bool expect_square_within_error(const test::WeightedPoints& points) {
  const std::size_t corners = points.size(), d = points[0].size() - 1;
  std::vector<const double*> pointers;
  for (const auto& p : points) pointers.push_back(p.data());
  std::vector<std::size_t> rows(corners);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const auto exact = test::smallest_orthosphere(points, rows);
  const std::optional<SquareInPairs> found = square_in_pairs(pointers.data(), corners, d);
  if (!exact) {
    EXPECT_FALSE(found) << "of dependent points";
    return false;
  }
  if (!found) return false;
  const test::Rational value = test::Rational(found->value.high) + test::Rational(found->value.low);
  EXPECT_LE(abs(test::Rational(value - exact->square)), test::Rational(found->error));
  EXPECT_LE(found->error, 0x1p-80 * found->value.high);
  return true;
}

test::WeightedPoints simplex(std::size_t corners, std::size_t d, double scale, test::Random& random) {
  test::WeightedPoints points(corners, std::vector<double>(d + 1, 0.0));
  for (auto& p : points)
    for (std::size_t j = 0; j < d; ++j) p[j] = scale * (random.real() - 0.5);
  return points;
}

TEST(SquareInPairs, RandomSimplicesAreCertain) {
  test::Random random(1);
  for (std::size_t d = 1; d <= 6; ++d)
    for (std::size_t corners = 2; corners <= d + 1; ++corners)
      for (const double scale : {1.0, 1e-30, 1e30}) {
        int certain = 0;
        for (int round = 0; round < 5; ++round)
          certain += expect_square_within_error(simplex(corners, d, scale, random)) ? 1 : 0;
        EXPECT_GE(certain, 3) << corners << " points in dimension " << d;
      }
}

/// The last point is nearly, or exactly, in the flat of the others.
TEST(SquareInPairs, ThinSimplices) {
  test::Random random(2);
  for (std::size_t d = 2; d <= 5; ++d)
    for (const double height : {1e-3, 1e-7, 1e-12, 0x1p-52, 0.0}) {
      test::WeightedPoints points = simplex(d + 1, d, 1, random);
      for (std::size_t i = 0; i < d; ++i) points[i][d - 1] = 0;
      points[d][d - 1] = height;
      EXPECT_TRUE(expect_square_within_error(points) || height < 1e-6) << height;
    }
}

TEST(SquareInPairs, DependentPointsHaveNone) {
  const double a[] = {0, 0, 0}, b[] = {1, 2, 3}, c[] = {2, 4, 6}, origin[] = {0, 0, 0};
  const double* const line[] = {a, b, c};
  EXPECT_FALSE(square_in_pairs(line, 3, 3));
  const double* const equal[] = {a, origin};
  EXPECT_FALSE(square_in_pairs(equal, 2, 3));
}

TEST(SquareInPairs, KnownSpheres) {
  const double a[] = {0, 0}, b[] = {6, 0}, c[] = {0, 8};
  const double* const right_triangle[] = {a, b, c};
  const std::optional<SquareInPairs> all = square_in_pairs(right_triangle, 3, 2);
  ASSERT_TRUE(all);
  EXPECT_NEAR(all->value.high, 25, 1e-13);
  const std::optional<SquareInPairs> edge = square_in_pairs(right_triangle, 2, 2);
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->value.high, 9, 1e-13);
}

}  // namespace
}  // namespace delone::internal
