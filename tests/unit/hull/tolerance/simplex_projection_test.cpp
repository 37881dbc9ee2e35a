// SPDX-License-Identifier: BSD-3-Clause
#include "hull/tolerance/simplex_projection.hpp"

#include "kernel/nearest_in_hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

namespace delone::hull {
namespace {

struct Projected {
  std::vector<double> corners, q;
  std::vector<const double*> points() const {
    std::vector<const double*> result;
    for (std::size_t i = 0; i < q.size(); ++i) result.push_back(corners.data() + i * q.size());
    return result;
  }
};

/// A simplex of d points of R^d, and a point about above its middle.
Projected projected(std::size_t d, double height, double scale, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Projected result{{}, std::vector<double>(d, 0.0)};
  for (std::size_t i = 0; i < d * d; ++i) {
    result.corners.push_back(scale * normal(random));
    result.q[i % d] += result.corners.back() / static_cast<double>(d);
  }
  for (double& x : result.q) x += scale * height * normal(random);
  return result;
}

// Against Wolfe's algorithm, and exactly: an upper bound, and no more than that.
TEST(SimplexProjection, IsTheNearestPoint) {
  kernel::NearestInHull nearest;
  for (std::size_t d = 2; d <= most_projected; ++d) {
    std::size_t found = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed)
      for (const double height : {0.0, 1e-12, 1e-3, 1.0}) {
        const Projected example = projected(d, height, seed % 3 == 0 ? 0x1p300 : 1, seed);
        const auto points = example.points();
        const int dimension = static_cast<int>(d);
        std::vector<double> normal(d);
        const auto distance = project_into_simplex(points, example.q.data(), normal.data());
        if (!distance) continue;
        ++found;
        nearest.find(points, example.q.data(), dimension);
        const auto exact = kernel::nearest_in_hull_exactly(points, example.q.data(), dimension);
        EXPECT_NE(exact.compare(*distance), Sign::positive);
        EXPECT_EQ(nearest.face().size(), d);
        double extent = 0, square = 0;
        for (const double x : example.corners) extent = std::max(extent, std::fabs(x));
        EXPECT_LE(*distance, nearest.upper() + 1e-11 * extent);
        for (const double x : normal) square += x * x;
        EXPECT_NEAR(std::sqrt(square), *distance, 1e-13 * extent);
      }
    EXPECT_GT(found, 300u) << d;
  }
}

TEST(SimplexProjection, RefusesWhatIsNotEasy) {
  double normal[3];
  const std::vector<double> thin{0, 0, 0, 1, 0, 0, 0.5, 1e-4, 0}, right{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const auto project = [&](const std::vector<double>& corners, std::vector<double> q) {
    return project_into_simplex(Projected{corners, q}.points(), q.data(), normal);
  };
  EXPECT_FALSE(project(thin, {0.5, 2e-5, 1}));
  EXPECT_FALSE(project(right, {0.75, 0.75, 1}));  // beyond an edge
  EXPECT_FALSE(project(right, {0, 0.25, 1}));     // on one
  EXPECT_FALSE(project(right, {0.25, 0.25, 0x1p600}));
  EXPECT_FALSE(project_into_simplex(std::vector<const double*>{right.data()}, right.data(), normal));
  const auto easy = project(right, {0.25, 0.25, -2});
  ASSERT_TRUE(easy);
  EXPECT_GE(*easy, 2);
  EXPECT_LT(*easy, 2 + 1e-13);
  EXPECT_EQ(normal[2], -2);
}

}  // namespace
}  // namespace delone::hull
