// SPDX-License-Identifier: BSD-3-Clause
#include "hull/tolerance/grown_choice.hpp"

#include "kernel/nearest_in_hull.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <vector>

namespace delone::hull {
namespace {

using ::testing::ElementsAre;

struct GrownExample {
  GrownExample(std::vector<double> x, int d) : coordinates(std::move(x)), dimension(d) {
    for (std::size_t at = 0; at < coordinates.size(); at += static_cast<std::size_t>(d))
      points.push_back(coordinates.data() + at);
  }
  GrownChoice grow(double tolerance, const std::vector<Index>& required = {}) const {
    return grow_choice(points, dimension, tolerance, required, [] {});
  }
  std::vector<double> coordinates;
  int dimension;
  std::vector<const double*> points;
};

GrownExample grown_sphere(int d, std::size_t n) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> x(n * static_cast<std::size_t>(d));
  for (auto p = x.begin(); p != x.end(); p += d) {
    double square = 0;
    for (int j = 0; j < d; ++j) square += (p[j] = normal(random)) * p[j];
    for (int j = 0; j < d; ++j) p[j] /= std::sqrt(square);
  }
  return {std::move(x), d};
}

// A square with bumps: the spanning triangle first, then what is farther out than the tolerance.
TEST(GrownChoice, KeepsTheFarthestBeyondEachCell) {
  const GrownExample square({0, 0, 1, -0.0625, 2, 0, 2, 2, 1, 2.25, 0, 2}, 2);
  EXPECT_THAT(square.grow(0.1).kept, ElementsAre(0, 3, 2, 5, 4));
  EXPECT_THAT(square.grow(0.05, {1}).kept, ElementsAre(1, 0, 3, 2, 5, 4));
}

// Most points are then within the tolerance of the cell that is named.
TEST(GrownChoice, NamesCellsThatAreNear) {
  kernel::NearestInHull nearest;
  for (const int d : {2, 3, 4}) {
    const GrownExample example = grown_sphere(d, 4000);
    const double tolerance = 0.02;
    const GrownChoice grown = example.grow(tolerance);
    const std::set<Index> kept(grown.kept.begin(), grown.kept.end());
    EXPECT_EQ(kept.size(), grown.kept.size());
    EXPECT_LT(kept.size(), d == 4 ? 3000u : 800u);
    const auto width = static_cast<std::size_t>(d);
    ASSERT_EQ(grown.corners.size(), example.points.size() * width);
    std::size_t near = 0;
    for (std::size_t p = 0; p < example.points.size(); ++p) {
      std::vector<const double*> cell;
      for (std::size_t i = 0; i < width; ++i) {
        const Index corner = grown.corners[p * width + i];
        EXPECT_TRUE(kept.contains(corner));
        cell.push_back(example.points[corner]);
      }
      nearest.find(cell, example.points[p], d);
      near += nearest.upper() <= tolerance;
    }
    EXPECT_GT(near, example.points.size() * 9 / 10);
  }
}

}  // namespace
}  // namespace delone::hull
