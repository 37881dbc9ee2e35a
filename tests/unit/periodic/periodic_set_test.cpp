// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/periodic_set.hpp"

#include "kernel/grid.hpp"
#include "made_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace delone::periodic {
namespace {

TEST(PeriodicSet, PointsAreInTheBoxAndOnTheGrid) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-20, 20);
  const std::vector<double> lattice{1.1, 0.1, 0, 0.3, 0.9, 0.2, 7.7, 0.3, 1.3};  // skewed
  std::vector<double> points(300);
  for (double& x : points) x = uniform(random);
  const PeriodicSet set = set_of(points, lattice, 3);
  EXPECT_GT(set.displacement, 0);
  EXPECT_LE(set.displacement, std::ldexp(1, set.grid - 1));
  for (std::size_t row = 0; row < set.num_points(); ++row) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(set.period.floor_of_fraction(i, set.row(row)), 0);
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_GE(kernel::trailing_exponent(set.row(row)[j]), set.grid);
      double back = set.row(row)[j];
      for (std::size_t i = 0; i < 3; ++i) back += set.wraps[row * 3 + i] * set.period.vector(i)[j];
      EXPECT_NEAR(back, points[row * 3 + j], 1e-13);
    }
  }
}

/// Where rounded fractions cannot tell, integers do.
TEST(PeriodicSet, PointsOnTheBorder) {
  const std::vector<double> lattice{3, 1, -1, 3};
  std::vector<double> points;
  for (int a = -2; a <= 2; ++a)
    for (int b = -2; b <= 2; ++b) points.insert(points.end(), {3.0 * a - b, 1.0 * a + 3 * b});
  const PeriodicSet set = set_of(points, lattice, 2);
  for (const double x : set.rows) EXPECT_EQ(x, 0);
}

TEST(PeriodicSet, CoarseInputIsNotMoved) {
  std::vector<double> points{0.1f, 0.7f, 100.3f, -5.9f};
  const PeriodicSet set = set_of(points, {12.5f, 0, 0, 7.25f}, 2);
  EXPECT_EQ(set.displacement, 0);
  EXPECT_EQ(set.given_points(points, 1), points);
}

TEST(PeriodicSet, OffsetsAreThoseOfTheCaller) {
  const PeriodicSet set = set_of({0.5, 0.5}, {1, 0, 5, 1}, 2);
  for (const std::vector<std::int64_t>& k : {std::vector<std::int64_t>{1, 0}, {0, 1}, {-2, 3}}) {
    std::int32_t given[2];
    set.to_given_basis(k, given);
    for (std::size_t j = 0; j < 2; ++j) {
      double short_sum = 0, given_sum = 0;
      for (std::size_t i = 0; i < 2; ++i) {
        short_sum += static_cast<double>(k[i]) * set.period.vector(i)[j];
        given_sum += given[i] * set.lattice[i * 2 + j];
      }
      EXPECT_EQ(short_sum, given_sum);
    }
  }
}

TEST(PeriodicSet, ExtremeSizesAreScaled) {
  for (const int exponent : {-1000, 1000}) {
    const double unit = std::ldexp(1, exponent);
    const PeriodicSet set = set_of({0.25 * unit, 1.5 * unit}, {unit, 0, 0, unit}, 2);
    EXPECT_EQ(set.displacement, 0);
    EXPECT_EQ(set.outer(set.row(0)[0]), 0.25 * unit);
    EXPECT_EQ(set.outer(set.row(0)[1]), 0.5 * unit);
  }
}

TEST(PeriodicSet, WeightsComeBack) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  PeriodicSet set;
  for (const double unit : {0.01, 0.1, 1e-3, 3.7})
    for (int i = 0; i < 1000; ++i) {
      set.unit = unit;
      const double w = set.inner_weight(uniform(random));
      EXPECT_EQ(set.inner_weight(set.outer_weight(w)), w);
    }
}

// A set without rows has the same grid, whatever parts of the points its free extent comes from, and places
// points where one with rows has them.
TEST(PeriodicSet, PlacesPointsOneAfterTheOther) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-20, 20);
  for (const double unit : {0.0, 0.01})
    for (const double scale : {1.0, 0x1p400})
      for (const std::size_t rank : {1, 2, 3}) {
        if (unit > 0 && scale > 1) continue;
        std::vector<double> lattice{1.1, 0.1, 0, 0.3, 0.9, 0.2, 7.7, 0.3, 1.3}, points(120), weights(40);
        lattice.resize(3 * rank);
        for (double& x : lattice) x *= scale;
        for (double& x : points) x = uniform(random) * scale;
        for (double& w : weights) w = uniform(random) * scale * scale;
        SetInput input;
        input.lattice = lattice;
        input.dimension = 3;
        input.is_weighted = true;
        input.unit = unit;
        std::vector<double> free(3, 0.0);
        for (const std::size_t first : {0, 60}) {
          const std::vector<double> part = free_extent(input, [&](const auto& visit) {
            for (std::size_t at = first; at < first + 60; at += 3) visit(&points[at]);
          });
          for (std::size_t j = 0; j < 3; ++j) free[j] = std::max(free[j], part[j]);
        }
        const PeriodicSet set = make_set_without_rows(input, free);
        input.points = points;
        input.weights = weights;
        const PeriodicSet with_rows = make_periodic_set(input);
        EXPECT_EQ(set.grid, with_rows.grid);
        EXPECT_EQ(set.largest, with_rows.largest);
        for (std::size_t row = 0; row < 40; ++row) {
          std::vector<double> point(&points[3 * row], &points[3 * row] + 3);
          point.push_back(weights[row]);
          set.place(row, point.data());
          EXPECT_EQ(point, std::vector<double>(with_rows.row(row), with_rows.row(row) + 4));
        }
      }
}

}  // namespace
}  // namespace delone::periodic
