// SPDX-License-Identifier: BSD-3-Clause
#include "hull/growing_shell.hpp"

#include "kernel/exact_nearest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace delone::hull {
namespace {

std::vector<double> points_of(int d, std::size_t n, std::uint64_t seed, double unit) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> points(n * static_cast<std::size_t>(d));
  for (double& x : points) x = unit > 0 ? std::nearbyint(uniform(random) / unit) * unit : uniform(random);
  return points;
}

TEST(GrowingShell, HasAllPointsWithinTheTolerance) {
  for (int d = 2; d <= 4; ++d)
    for (const double unit : {0.0, 0.2, 1.0 / 7})
      for (const double tolerance : {1e-13, 0.01}) {
        const std::vector<double> points = points_of(d, 80, static_cast<std::uint64_t>(d), unit);
        PointSieve sieve(points, d);
        sieve.run();
        ASSERT_TRUE(sieve.has_shell());
        int calls = 0;
        GrowingShell growth(sieve, tolerance, [&] { ++calls; });
        ASSERT_TRUE(growth.is_possible() && growth.run({}));
        EXPECT_GT(calls, 0);
        const HullState& shell = sieve.shell();
        std::vector<const double*> vertices;
        for (Index site = 0; site < shell.sites().size(); ++site)
          vertices.push_back(shell.sites().point(site));
        for (std::size_t at = 0; at < points.size(); at += static_cast<std::size_t>(d)) {
          const auto nearest = kernel::nearest_in_hull_exactly(vertices, points.data() + at, d);
          EXPECT_NE(nearest.compare(tolerance), Sign::positive);
        }
        EXPECT_TRUE(std::is_sorted(growth.covered().begin(), growth.covered().end()));
        for (const std::size_t i : growth.covered()) {
          EXPECT_FALSE(sieve.is_in_shell(i));
          EXPECT_LT(growth.cell_of(i), shell.hull().num_cells());
        }
      }
}

TEST(GrowingShell, GivesUpBeyondTheNumberOfVertices) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> sphere;
  for (int i = 0; i < 300; ++i) {
    const double x = normal(random), y = normal(random), z = normal(random), r = std::hypot(x, y, z);
    sphere.insert(sphere.end(), {x / r, y / r, z / r});
  }
  PointSieve sieve(sphere, 3);
  sieve.run();
  GrowingShell growth(sieve, 1e-13, [] {});
  EXPECT_FALSE(growth.run({.vertices = 40}));
  EXPECT_FALSE(growth.open().empty());
}

TEST(GrowingShell, GivesUpBeyondTheNumberOfProducts) {
  const std::vector<double> points = points_of(3, 2000, 1, 0);
  PointSieve few(points, 3), enough(points, 3);
  few.run();
  enough.run();
  EXPECT_FALSE(GrowingShell(few, 1e-13, [] {}).run({.products = 0}));
  EXPECT_TRUE(GrowingShell(enough, 1e-13, [] {}).run({.products = 1000 * 2000}));
}

TEST(GrowingShell, NeedsModerateNumbers) {
  std::vector<double> points = points_of(3, 100, 1, 0);
  for (double& x : points) x *= 0x1p600;
  PointSieve sieve(points, 3);
  sieve.run();
  ASSERT_TRUE(sieve.has_shell());
  EXPECT_FALSE(GrowingShell(sieve, 1, [] {}).is_possible());
}

}  // namespace
}  // namespace delone::hull
