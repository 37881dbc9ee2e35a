// SPDX-License-Identifier: BSD-3-Clause
// Lattices.
#include "point_sets_support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace delone {
namespace {

TEST(LatticePointSets, AreCountedAxisByAxis) {
  EXPECT_EQ(make("grid", 2, 9),
            (Rows{{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}, {2, 0}, {2, 1}, {2, 2}}));
  EXPECT_EQ(make("grid", 3, 9).back(), (std::vector<double>{0, 2, 2}));  // side 3
  EXPECT_EQ(make("grid", 1, 4), (Rows{{0}, {1}, {2}, {3}}));
  EXPECT_EQ(make("grid", 3, 1000).back(), (std::vector<double>{9, 9, 9}));
  EXPECT_EQ(make("grid", 6, 4096).back(), std::vector<double>(6, 3));
  EXPECT_EQ(make("cube01", 3, 100),
            (Rows{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 1, 1}, {1, 0, 0}, {1, 0, 1}, {1, 1, 0}, {1, 1, 1}}));
  const Rows tilted = make("tilted_grid", 3, 125);
  EXPECT_EQ(std::set<std::vector<double>>(tilted.begin(), tilted.end()).size(), 125u);
  for (const auto& row : tilted)
    for (double v : row) EXPECT_EQ(v, std::trunc(v));
}

TEST(LatticePointSets, NudgedGridIsWithinOneUnitInTheLastPlace) {
  const Rows grid = make("grid", 3, 64), nudged = make("nudged_grid", 3, 64);
  int moved[3] = {};
  for (std::size_t i = 0; i < 64; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double v = grid[i][j] + 1, w = nudged[i][j];
      ASSERT_TRUE(w == v || w == std::nextafter(v, 0) || w == std::nextafter(v, 10)) << w;
      ++moved[w < v ? 0 : w > v ? 2 : 1];
    }
  for (int count : moved) EXPECT_GT(count, 30);
}

}  // namespace
}  // namespace delone
