// SPDX-License-Identifier: BSD-3-Clause
#include "hull/flat_distance.hpp"

#include "exact_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace delone::hull {
namespace {

TEST(FlatDistance, IsDecidedAtTheLastBit) {
  const std::vector<double> a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, q{0.25, 0.5, 0x1p-40};
  const std::vector<const double*> plane{a.data(), b.data(), c.data()};
  EXPECT_TRUE(is_near_flat(plane, q.data(), 3, 0x1p-40));
  EXPECT_FALSE(is_near_flat(plane, q.data(), 3, std::nextafter(0x1p-40, 0.0)));
  EXPECT_TRUE(is_near_flat(std::vector{a.data()}, q.data(), 3, 0.56));
  EXPECT_FALSE(is_near_flat(std::vector{a.data()}, q.data(), 3, 0.55));
  EXPECT_FALSE(is_near_flat(std::vector{a.data(), a.data()}, q.data(), 3, 1));  // no flat
}

TEST(FlatDistance, OfHugeAndTinyNumbers) {
  const std::vector<double> a{1e300, 0}, b{-1e300, 1e-300}, q{0, 1e-300};
  const std::vector<const double*> line{a.data(), b.data()};
  EXPECT_TRUE(is_near_flat(line, q.data(), 2, 1e-300));
  EXPECT_FALSE(is_near_flat(line, q.data(), 2, 0.49e-300));
  NearFlat near(2, 2, 1e-300);
  near.set(line);
  EXPECT_TRUE(near.contains(q.data()));
}

// Points whose distances are close to the tolerance, in hyperplanes and in lower flats.
TEST(FlatDistance, AgreesWithRationals) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int inside = 0, outside = 0;
  for (int round = 0; round < 300; ++round) {
    const std::size_t d = 2 + round % 3, k = 1 + static_cast<std::size_t>(round) % d;
    std::vector<std::vector<double>> points(k + 1, std::vector<double>(d));
    for (auto& p : points)
      for (double& x : p) x = uniform(random);
    std::vector<const double*> flat;
    for (std::size_t i = 0; i < k; ++i) flat.push_back(points[i].data());
    const double* q = points[k].data();
    const test::Rational square = *test::squared_distance_from_flat(flat, q, d, false);
    const double about = std::sqrt(static_cast<double>(square));
    for (const double factor : {1 - 0x1p-52, 1.0, 1 + 0x1p-52, 0.5, 2.0}) {
      const double tolerance = about * factor;
      const bool expected = square <= test::Rational(tolerance) * test::Rational(tolerance);
      NearFlat near(static_cast<int>(d), static_cast<int>(k), tolerance);
      near.set(flat);
      EXPECT_EQ(near.contains(q), expected);
      EXPECT_EQ(is_near_flat(flat, q, static_cast<int>(d), tolerance), expected);
      ++(expected ? inside : outside);
    }
  }
  EXPECT_GT(inside, 300);
  EXPECT_GT(outside, 300);
}

// Cells so thin that binary64 knows nothing of their normal: the last point is within about 1e-15 of the flat
// of the others.
TEST(FlatDistance, OfThinCells) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int decided = 0, inside = 0;
  for (int round = 0; round < 200; ++round) {
    const std::size_t d = 2 + round % 4;
    std::vector<std::vector<double>> points(d + 1, std::vector<double>(d));
    for (auto& p : points)
      for (double& x : p) x = uniform(random);
    for (std::size_t j = 0; j < d && d > 2; ++j) {
      points[d - 1][j] = 0;
      for (std::size_t i = 0; i + 1 < d; ++i) points[d - 1][j] += points[i][j] / static_cast<double>(d - 1);
    }
    std::vector<const double*> cell;
    for (std::size_t i = 0; i < d; ++i) cell.push_back(points[i].data());
    const double* q = points[d].data();
    PreciseNormal precise;
    precise.set(cell, static_cast<int>(d));
    for (const double tolerance : {1e-3, 0.1, 0.3, 1.0}) {
      const bool expected = is_near_flat(cell, q, static_cast<int>(d), tolerance);
      if (const auto near = precise.is_near(q, tolerance)) {
        EXPECT_EQ(*near, expected);
        ++decided;
      }
      NearFlat near(static_cast<int>(d), static_cast<int>(d), tolerance);
      near.set(cell);
      EXPECT_EQ(near.contains(q), expected);
      inside += expected;
    }
  }
  EXPECT_GT(decided, 500);
  EXPECT_GT(inside, 100);
}

}  // namespace
}  // namespace delone::hull
