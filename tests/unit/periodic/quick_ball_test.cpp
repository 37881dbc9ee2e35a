// SPDX-License-Identifier: BSD-3-Clause
// Quick balls contain the spheres that are computed without error, and diameters are bounded by theirs.
#include "periodic/quick_ball.hpp"

#include "solve/cell_center.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace delone::periodic {
namespace {

template <int D>
void expect_balls_contain_spheres() {
  std::mt19937_64 random(D);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<int> axes(D);
  std::iota(axes.begin(), axes.end(), 0);
  solve::CenterFinder finder(D, axes, true);
  int found = 0;
  for (int round = 0; round < 20000; ++round) {
    // Ever flatter cells, somewhere.
    const double flatness = std::ldexp(1, -(round % 24));
    double corners[D + 1][D];
    const double* pointers[D + 1];
    for (int i = 0; i <= D; ++i) {
      for (int j = 0; j < D; ++j)
        corners[i][j] = uniform(random) * (j == 0 ? flatness : 1) + 100 * (round % 3);
      pointers[i] = corners[i];
    }
    Ball ball;
    if (!find_ball<D>(pointers, ball)) continue;
    ++found;
    double center[D], distance = 0, radius = 0;
    finder.find(pointers, nullptr, center);
    for (int j = 0; j < D; ++j) {
      distance += (center[j] - ball.center[j]) * (center[j] - ball.center[j]);
      radius += (center[j] - corners[0][j]) * (center[j] - corners[0][j]);
    }
    EXPECT_LT(std::sqrt(distance) + std::sqrt(radius), ball.radius);
    EXPECT_LT(ball.radius, std::sqrt(radius) * (1 + 0x1p-19));
    const double diameter = 2 * std::sqrt(radius);
    EXPECT_FALSE(is_narrower<D>(pointers, diameter * (1 - 0x1p-50)));
    EXPECT_TRUE(is_narrower<D>(pointers, diameter * (1 + 0x1p-17)));
  }
  EXPECT_GT(found, 10000);
}

TEST(QuickBall, InThePlane) { expect_balls_contain_spheres<2>(); }
TEST(QuickBall, InSpace) { expect_balls_contain_spheres<3>(); }

TEST(QuickBall, CellsThatAreFlatOrTinyAreNotNarrow) {
  const double a[] = {0, 0, 0}, b[] = {1, 0, 0}, c[] = {0, 1, 0}, flat[] = {1, 1, 0};
  const double* const in_a_plane[] = {a, b, c, flat};
  EXPECT_FALSE(is_narrower<3>(in_a_plane, 1e100));
  const double d[] = {1e-70, 0, 0}, e[] = {0, 1e-70, 0}, f[] = {0, 0, 1e-70};
  const double* const tiny[] = {a, d, e, f};
  EXPECT_FALSE(is_narrower<3>(tiny, 1e-60));
}

}  // namespace
}  // namespace delone::periodic
