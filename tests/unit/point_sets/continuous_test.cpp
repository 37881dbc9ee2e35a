// SPDX-License-Identifier: BSD-3-Clause
// Distributions: moments, supports and scales.
#include "point_sets_support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace delone {
namespace {

TEST(ContinuousPointSets, SpheresAndBalls) {
  for (int d : {1, 2, 3, 10}) {
    std::vector<double> mean(static_cast<std::size_t>(d));
    for (const auto& row : make("sphere", d, 4000)) {
      double sum = 0;
      for (std::size_t j = 0; j < row.size(); ++j) sum += row[j] * row[j], mean[j] += row[j] / 4000;
      ASSERT_NEAR(sum, 1, 1e-14);
    }
    for (double m : mean) EXPECT_NEAR(m, 0, 5 / std::sqrt(4000.0 * d));
    int inner = 0;
    for (const auto& row : make("ball", d, 4000)) {
      double sum = 0;
      for (double v : row) sum += v * v;
      ASSERT_LE(sum, 1 + 1e-14);
      inner += std::pow(sum, d / 2.0) < 0.5;  // half of the volume
    }
    EXPECT_NEAR(inner, 2000, 160);
  }
}

TEST(ContinuousPointSets, GaussianMoments) {
  double m1 = 0, m2 = 0, m4 = 0, beyond_2 = 0;
  const auto x = make_point_set("gaussian", 4, 50000, 3);
  for (double v : x) m1 += v, m2 += v * v, m4 += v * v * v * v, beyond_2 += std::abs(v) > 2;
  const double n = static_cast<double>(x.size());
  EXPECT_NEAR(m1 / n, 0, 0.01);
  EXPECT_NEAR(m2 / n, 1, 0.015);
  EXPECT_NEAR(m4 / n, 3, 0.1);
  EXPECT_NEAR(beyond_2 / n, 0.0455, 0.002);
}

TEST(ContinuousPointSets, CurvesAndSurfaces) {
  for (const auto& row : make("manifold", 4, 2000)) {
    ASSERT_NEAR(row[3], std::sin(3.14159265358979323846 * row[0]), 4e-16);
    ASSERT_TRUE(row[0] >= 0 && row[0] < 1 && row[1] < 1 && row[2] < 1);
  }
  for (const auto& row : make("moment", 3, 100)) {
    EXPECT_EQ(row[1], row[0] * row[0]);
    EXPECT_EQ(row[2], row[0] * row[0] * row[0]);
  }
}

TEST(ContinuousPointSets, PlummerHasHalfItsMassWithin1Point305AndBoundSpeeds) {
  int inner = 0;
  for (const auto& row : make("plummer", 6, 4000)) {
    const double r2 = row[0] * row[0] + row[1] * row[1] + row[2] * row[2],
                 v2 = row[3] * row[3] + row[4] * row[4] + row[5] * row[5];
    inner += r2 < 1.3048 * 1.3048;
    EXPECT_LE(v2 / 2, 1 / std::sqrt(1 + r2) * (1 + 1e-9));
  }
  EXPECT_NEAR(inner, 2000, 160);
}

TEST(ContinuousPointSets, ScalesAndOffsets) {
  std::set<double> offset;
  for (double v : make_point_set("offset", 2, 1000, 1)) {
    ASSERT_TRUE(v >= 4e6 && v < 4001000);
    ASSERT_EQ(v, std::round(v * 1000) / 1000);
    offset.insert(v);
  }
  EXPECT_GT(offset.size(), 1900u);
  int denormal = 0, tiny = 0, huge = 0;
  for (double v : make_point_set("mixed_scales", 3, 3000, 1)) {
    ASSERT_LT(std::abs(v), 1e151);
    denormal += std::fpclassify(v) == FP_SUBNORMAL;
    tiny += std::abs(v) < 1e-200;
    huge += std::abs(v) > 1e100;
  }
  EXPECT_GT(denormal, 300);
  EXPECT_GT(tiny, 1000);
  EXPECT_GT(huge, 500);
}

}  // namespace
}  // namespace delone
