// SPDX-License-Identifier: BSD-3-Clause
// Which steps are repaired, and which are constructed: results do not tell.
#include "periodic_sets.hpp"

#include "periodic/stored_set.hpp"

#include <delone/delaunay.hpp>
#include <delone/periodic.hpp>

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace delone::periodic {
namespace {

/// Of all points by up to a length, and of some anywhere.
std::vector<double> stirred(std::vector<double> points, double length, std::size_t num_far) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> step(-length, length), anywhere(0, 1);
  for (double& x : points) x += step(random);
  for (std::size_t i = 0; i < 3 * num_far; ++i) points[i] = anywhere(random);
  return points;
}

bool is_repaired(const PeriodicTriangulation& before, const PeriodicTriangulation& after) {
  return StoredSet::ghosts(after).comes_from(StoredSet::ghosts(before));
}

TEST(GhostStep, SmallStepsAreRepaired) {
  const Lattice box = Lattice::box(std::vector<double>{1, 1, 1});
  const std::vector<double> points = test::random_fractions(6000, 3);
  for (const int rank : {3, 2, 1}) {
    const Lattice lattice = test::of_rank(box, rank);
    const PeriodicDelaunay<3> t(PointsView(points, 3), lattice);
    const auto repairs = [&](double length, std::size_t num_far) {
      return is_repaired(t, t.moved(PointsView(stirred(points, length, num_far), 3)));
    };
    EXPECT_TRUE(repairs(0, 0));
    EXPECT_TRUE(repairs(1e-5, 0));
    EXPECT_TRUE(repairs(1e-5, 3));
    EXPECT_FALSE(repairs(1e-2, 0));
    EXPECT_FALSE(repairs(1e-5, 1000));
    EXPECT_FALSE(is_repaired(PeriodicDelaunay<3>(PointsView(points, 3), lattice), t));
  }
}

TEST(GhostStep, ManyStepsAreRepairedUntilLittleIsKnown) {
  const Lattice box = Lattice::box(std::vector<double>{1, 1, 1});
  std::vector<double> points = test::random_fractions(3000, 3);
  PeriodicDelaunay<3> t(PointsView(points, 3), box);
  const std::size_t num_ghosts = t.num_ghosts();
  int num_constructions = 0;
  for (int step = 0; step < 100; ++step) {
    for (double& x : points) x += 0x1p-10;  // the same for all: the whole set drifts
    PeriodicDelaunay<3> next = t.moved(PointsView(points, 3));
    num_constructions += is_repaired(t, next) ? 0 : 1;
    t = std::move(next);
    EXPECT_LT(t.num_ghosts(), 2 * num_ghosts);
  }
  EXPECT_GT(num_constructions, 0);
  EXPECT_LT(num_constructions, 20);
}

TEST(GhostStep, OtherWeightsAndBoxesAreRepaired) {
  Lattice box = Lattice::box(std::vector<double>{1, 1, 1});
  std::vector<double> points = test::random_fractions(6000, 3), weights = test::random_fractions(2000, 4);
  for (double& w : weights) w *= 8e-3;
  const PeriodicRegular<3> t(PointsView(points, 3), weights, box);
  EXPECT_GT(t.num_hidden(), 0u);
  for (double& w : weights) w *= 1 + 0x1p-14;
  const PeriodicRegular<3> next = t.moved(PointsView(points, 3), weights);
  EXPECT_TRUE(is_repaired(t, next));
  for (double& x : points) x *= 1 + 0x1p-14;
  for (double& x : box.vectors) x *= 1 + 0x1p-14;
  EXPECT_TRUE(is_repaired(next, next.moved(PointsView(points, 3), weights, box)));
}

}  // namespace
}  // namespace delone::periodic
