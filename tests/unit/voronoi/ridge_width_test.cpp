// SPDX-License-Identifier: BSD-3-Clause
// Widths of polygons and polytopes that are known, and the quick test against the bound.
#include "voronoi/ridge_width.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace delone::voronoi {
namespace {

std::vector<const double*> rows(const std::vector<double>& x, std::size_t d) {
  std::vector<const double*> result;
  for (std::size_t i = 0; i < x.size(); i += d) result.push_back(x.data() + i);
  return result;
}

TEST(RidgeWidth, OfSegmentsAndPolygons) {
  const std::vector<double> segment{1, 1, 4, 5};
  EXPECT_NEAR(RidgeWidth(2, 2).bound(rows(segment, 2)), 5, 1e-14);
  const std::vector<double> rectangle{0, 0, 7, 3, 0, 7, 3, 2, 7, 0, 2, 7};
  EXPECT_NEAR(RidgeWidth(3, 3).bound(rows(rectangle, 3)), 2, 1e-14);
  // A long triangle in a tilted plane: its height over the longest side.
  const std::vector<double> triangle{0, 0, 0, 1000, 1000, 0, 500, 500, 0.25};
  EXPECT_NEAR(RidgeWidth(3, 3).bound(rows(triangle, 3)), 0.25, 1e-12);
  const std::vector<double> line{0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3};
  EXPECT_LE(RidgeWidth(3, 3).bound(rows(line, 3)), 1e-14);
  EXPECT_FALSE(RidgeWidth(3, 3).is_wide(rows(line, 3), 1e-100));
}

TEST(RidgeWidth, OfAFacetOfABox) {  // k = 4: a box 1 × 2 × 3 in R⁴
  std::vector<double> box;
  for (int corner = 0; corner < 8; ++corner)
    for (const int x : {corner & 1, (corner >> 1 & 1) * 2, (corner >> 2 & 1) * 3, 5}) box.push_back(x);
  const auto corners = rows(box, 4);
  const std::vector<const double*> low{corners[0], corners[2], corners[4], corners[6]},
      front{corners[0], corners[1], corners[4], corners[5]};
  EXPECT_NEAR(RidgeWidth(4, 4).facet_bound(corners, low), 1, 1e-14);
  EXPECT_NEAR(RidgeWidth(4, 4).facet_bound(corners, front), 2, 1e-14);
}

TEST(RidgeWidth, WhatIsWideIsWider) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int wide = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const double thin = std::pow(10.0, -6 * std::abs(uniform(random)));
    std::vector<double> triangle(9);
    for (double& x : triangle) x = uniform(random);
    for (std::size_t j = 0; j < 3; ++j)
      triangle[6 + j] = (triangle[j] + triangle[3 + j]) / 2 + thin * triangle[6 + j];
    RidgeWidth width(3, 3);
    const double tolerance = 1e-3, bound = width.bound(rows(triangle, 3));
    if (width.is_wide(rows(triangle, 3), tolerance)) {
      ++wide;
      EXPECT_GT(bound, tolerance);
    } else {
      EXPECT_LT(bound, 100 * tolerance);
    }
  }
  EXPECT_GT(wide, 500);
}

TEST(RidgeWidth, InfiniteVertices) {
  const std::vector<double> far{0, 0, 0, 1, 0, 0, std::numeric_limits<double>::infinity(), 0, 0};
  EXPECT_FALSE(RidgeWidth(3, 3).is_wide(rows(far, 3), 1e-9));
  EXPECT_FALSE(RidgeWidth(3, 3).bound(rows(far, 3)) <= 1e300);
}

}  // namespace
}  // namespace delone::voronoi
