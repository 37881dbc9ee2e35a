// SPDX-License-Identifier: BSD-3-Clause
// What a grid knows of the points that it has seen: exponents, ranges, and which determinants are exact.
#include "kernel/grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace delone::kernel {
namespace {

TEST(Grid, FindsTheLowestBit) {
  EXPECT_EQ(trailing_exponent(1.0), 0);
  EXPECT_EQ(trailing_exponent(-3.0), 0);
  EXPECT_EQ(trailing_exponent(12.0), 2);
  EXPECT_EQ(trailing_exponent(0.375), -3);
  EXPECT_EQ(trailing_exponent(std::numeric_limits<double>::denorm_min()), -1074);
  EXPECT_EQ(trailing_exponent(std::numeric_limits<double>::min()), -1022);
  EXPECT_EQ(trailing_exponent(std::numeric_limits<double>::max()), 971);
  EXPECT_EQ(trailing_exponent(0.0), std::numeric_limits<int>::max());
}

TEST(Grid, KeysOfSmallLatticesAreInLexicographicOrder) {
  for (const double unit : {1.0, 0.125, 4096.0})
    for (const int ambient : {1, 2, 3, 4}) {
      std::vector<std::vector<double>> points;
      Grid grid(ambient);
      for (int i = 0; i < 60; ++i) {
        std::vector<double> point;
        // The last axis is the widest, and every axis has equal entries.
        for (int j = 0; j < ambient; ++j) point.push_back(unit * ((i * (7 + 4 * j)) % (3 + 4 * j) - 2));
        grid.include(point.data());
        points.push_back(point);
      }
      ASSERT_TRUE(grid.is_small());
      for (const auto& p : points)
        for (const auto& q : points)
          EXPECT_EQ(grid.lexicographic_key(p.data()) < grid.lexicographic_key(q.data()), p < q);
    }
}

TEST(Grid, KnowsWhetherDeterminantsAreExactInBinary64) {
  const auto is_small = [](std::vector<double> coordinates, int ambient) {
    Grid grid(ambient);
    for (std::size_t i = 0; i < coordinates.size(); i += static_cast<std::size_t>(ambient))
      grid.include(&coordinates[i]);
    return grid.is_small();
  };
  EXPECT_TRUE(is_small({0, 0, 0, 99, 99, 99}, 3));
  EXPECT_TRUE(is_small({4e6, 4e6, 4e6, 4e6 + 99, 4e6 + 3, 4e6 + 7}, 3));
  EXPECT_TRUE(is_small({0, 0.25, 7, 0.5}, 2));
  EXPECT_FALSE(is_small({0, 0, 0, 1001, 1001, 1001}, 3));
  EXPECT_FALSE(is_small({0, 0, 0.1, 0.2}, 2));
  EXPECT_FALSE(is_small({0, 0, std::ldexp(1, 70), std::ldexp(1, 70)}, 2));
  EXPECT_FALSE(is_small({0, 0, std::ldexp(1, -70), std::ldexp(1, -70)}, 2));
  constexpr double huge = std::numeric_limits<double>::max();
  EXPECT_FALSE(is_small({-huge, 0, huge, 1}, 2));  // the range itself overflows
  Grid grid(1);
  const double zero = 0, one = 1, third = 1.0 / 3;
  grid.include(&zero);
  grid.include(&one);
  EXPECT_TRUE(grid.is_small());
  grid.include(&third);
  EXPECT_FALSE(grid.is_small());
}

TEST(Grid, ItsRevisionChangesWithWhatItKnows) {
  Grid grid(2);
  EXPECT_EQ(grid.revision(), 0u);
  const double low[] = {0, 0}, high[] = {8, 4}, between[] = {1, 3}, fine[] = {0.5, 1}, beyond[] = {9, 0};
  const auto include = [&](const double* point) {
    const auto before = grid.revision();
    grid.include(point);
    return grid.revision() != before;
  };
  EXPECT_TRUE(include(low));
  EXPECT_TRUE(include(high));
  EXPECT_TRUE(include(between));
  EXPECT_FALSE(include(between));
  EXPECT_TRUE(include(fine));
  EXPECT_EQ(grid.exponent(0), -1);
  EXPECT_EQ(grid.exponent(1), 0);
  EXPECT_EQ(grid.finest(), -1);
  EXPECT_EQ(grid.lift_exponent(), -2);
  EXPECT_TRUE(include(beyond));
  EXPECT_FALSE(include(low));
}

TEST(WeightedGrid, TheLiftLiesOnTheFinerOfTwoGrids) {
  const auto grid_of = [](std::vector<double> rows) {  // of R^1
    Grid grid(1, true);
    for (std::size_t i = 0; i < rows.size(); i += 2) grid.include(&rows[i]);
    return grid;
  };
  EXPECT_EQ(grid_of({0.5, 1, 1, 3}).lift_exponent(), -2);
  EXPECT_EQ(grid_of({4, 8, 8, 0}).lift_exponent(), 3);
  EXPECT_EQ(grid_of({4, 32, 8, 0}).lift_exponent(), 4);
  EXPECT_EQ(grid_of({4, 0.1, 8, 0.1}).lift_exponent(), 4) << "equal weights cancel";
  EXPECT_EQ(grid_of({0, 3, 0, 1}).lift_exponent(), 0);
}

TEST(WeightedGrid, KnowsWhetherDeterminantsAreExactInBinary64) {
  const auto is_small = [](std::vector<double> rows, int ambient) {
    Grid grid(ambient, true);
    for (std::size_t i = 0; i < rows.size(); i += static_cast<std::size_t>(ambient) + 1)
      grid.include(&rows[i]);
    return grid.is_small();
  };
  EXPECT_TRUE(is_small({0, 0, 0, 5, 99, 99, 99, 1005}, 3));
  EXPECT_TRUE(is_small({0, 0, 0, 0.1, 99, 99, 99, 0.1}, 3));
  EXPECT_FALSE(is_small({0, 0, 0, 0.1, 99, 99, 99, 0.2}, 3));
  EXPECT_TRUE(is_small({0, std::ldexp(1, 40), 9, 0}, 1));
  EXPECT_FALSE(is_small({0, std::ldexp(1, 52), 9, 0}, 1));
  EXPECT_FALSE(is_small({0, std::ldexp(1, 130), 0, 0}, 1));
  EXPECT_FALSE(is_small({0, std::ldexp(1, -130), 0, 0}, 1));
  constexpr double huge = std::numeric_limits<double>::max();
  EXPECT_FALSE(is_small({0, huge, 1, -huge}, 1));
}

}  // namespace
}  // namespace delone::kernel
