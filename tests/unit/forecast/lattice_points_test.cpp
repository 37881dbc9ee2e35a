// SPDX-License-Identifier: BSD-3-Clause
// Which sets count as lattices, and how much of space they fill.
#include "forecast/lattice_points.hpp"

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <vector>

namespace delone::cost_model {
namespace {

LatticePoints found_in(const test::PointSet& set) {
  std::vector<std::size_t> rows = test::random_order(set.size(), 3);
  return find_lattice(set.points, set.dimension, rows, static_cast<double>(set.size()));
}

TEST(LatticePoints, ExactOnesHaveTies) {
  for (const int d : {2, 3}) {
    const LatticePoints found = found_in(test::lattice(d, 7));
    EXPECT_TRUE(found.found);
    EXPECT_TRUE(found.has_ties);
    EXPECT_NEAR(found.hull_volume, d == 2 ? 36 : 216, 1e-6);
  }
}

TEST(LatticePoints, RoundedOnesHaveNone) {
  test::PointSet rounded = test::lattice(3, 7);
  for (double& x : rounded.points) x = x * 0.1 + 0.3;
  const LatticePoints found = found_in(rounded);
  EXPECT_TRUE(found.found);
  EXPECT_FALSE(found.has_ties);
}

TEST(LatticePoints, OthersAreNone) {
  test::Random random(1);
  test::PointSet scattered{"random", 2, {}};
  for (int i = 0; i < 400; ++i) scattered.points.push_back(random.real());
  EXPECT_FALSE(found_in(scattered).found);
  EXPECT_FALSE(found_in(test::lattice(1, 40)).found) << "on a line all is known";
  EXPECT_FALSE(found_in({"few", 2, {0, 0, 1, 0, 0, 1, 1, 1}}).found);
  EXPECT_FALSE(found_in({"equal", 2, std::vector<double>(40, 1.0)}).found) << "no point has a neighbor";
}

TEST(LatticePoints, OfDistancesBeyondAllNumbersThereIsNone) {
  const LatticePoints found = found_in(test::scaled(test::lattice(2, 7), 1e300));
  EXPECT_FALSE(found.found);
}

TEST(LatticePoints, PatchesHaveNoMorePointsThanThereAre) {
  const std::vector<double> line{0, 5, 1, 1, 9};
  EXPECT_EQ(patch_around(line, 1, 0, 3), (std::vector<double>{0, 1, 1}));
  EXPECT_EQ(patch_around(line, 1, 4, 2), (std::vector<double>{9, 5}));
  EXPECT_EQ(patch_around(line, 1, 0, 99).size(), 5u);
  EXPECT_TRUE(patch_around(line, 1, 0, 0).empty());
}

}  // namespace
}  // namespace delone::cost_model
