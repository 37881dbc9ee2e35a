// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of corners against the exact ones: where binary64 is enough, where pairs of doubles are, and
// where integers decide.
#include "kernel/grid.hpp"
#include "voronoi/region_clipper.hpp"

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace delone::voronoi {
namespace {

/// How far corners are off at most, in units of the longest side, where they may be off by roundings of
/// coordinates less the site, too: `far`, the largest of these.
void expect_corners(const Box& box, const std::vector<double>& points, const std::vector<double>& weights,
                    const std::vector<double>& halfspaces, double far) {
  const std::size_t d = box.low.size();
  RegionClipper clipper(box, false, halfspaces);
  std::vector<RegionClipper::Site> others;
  for (std::size_t i = 1; i < weights.size(); ++i) others.push_back({points.data() + i * d, weights[i]});
  clipper.clip({points.data(), weights[0]}, others);
  const ClippedRegion region = clipper.geometry();
  ASSERT_FALSE(region.corners.empty());
  double side = 0;
  for (std::size_t j = 0; j < d; ++j) side = std::max(side, box.high[j] - box.low[j]);
  for (const RegionClipper::Corner corner : clipper.corners()) {
    const RegionClipper::ExactCorner exact = clipper.exact_corner(corner);
    double nearest = INFINITY;
    for (std::size_t i = 0; i < region.corners.size(); i += d) {
      double distance = 0;
      for (std::size_t j = 0; j < d; ++j) {
        const double expected =
            kernel::nearest_double(exact.at.numerators[j], exact.at.denominator, exact.grid);
        distance = std::max(distance, std::abs(region.corners[i + j] - expected));
      }
      nearest = std::min(nearest, distance);
    }
    EXPECT_LE(nearest, 0x1p-44 * side + 0x1p-51 * far);
  }
}

TEST(ClippedCorners, OfPlanesAtManyAngles) {
  test::Random random(3);
  // Bisectors of sites in nearly one direction: the more so, the more digits their corners need.
  for (const double angle : {1.0, 1e-4, 1e-7, 1e-9, 1e-12})
    for (int repeat = 0; repeat < 20; ++repeat)
      for (const std::size_t d : {2u, 3u}) {
        std::vector<double> points(d, 0.25), weights{0};
        for (int other = 0; other < 4; ++other) {
          points.push_back(0.75);
          for (std::size_t j = 1; j < d; ++j) points.push_back(0.25 + angle * (random.real() - 0.5));
          weights.push_back(angle * (random.real() - 0.5));
        }
        expect_corners({std::vector<double>(d, 0), std::vector<double>(d, 1)}, points, weights, {}, 1);
      }
}

TEST(ClippedCorners, OfHalfspaces) {
  test::Random random(4);
  for (const double angle : {1.0, 1e-6, 1e-10})
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::vector<double> halfspaces;
      for (int row = 0; row < 3; ++row) {
        const double slope = angle * (random.real() - 0.5), other = angle * (random.real() - 0.5);
        // Through a place in the box, so that they cut each other there.
        halfspaces.insert(halfspaces.end(), {1, slope, other, -(0.75 + 0.3 * slope + 0.6 * other)});
      }
      expect_corners({{0, 0, 0}, {1, 1, 1}}, {0.1, 0.5, 0.5}, {0}, halfspaces, 1);
    }
}

TEST(ClippedCorners, OfSitesFarAwayAndOfHugeAndTinyBoxes) {
  // A site beside the box, 2^30 sides away.
  expect_corners({{0, 0}, {1, 1}}, {-0x1p30, 0.5, 0x1p30 + 1, 0.25}, {0, 0}, {}, 0x1p31);
  for (const double scale : {1e-150, 1e-90, 1e90, 1e150})
    expect_corners({{0, 0}, {scale, scale}}, {0.1 * scale, 0.2 * scale, 0.9 * scale, 0.7 * scale}, {0, 0}, {},
                   scale);
  // Sides of very different lengths.
  expect_corners({{0, 0}, {1, 0x1p-40}}, {0.25, 0, 0.625, 0x1p-41}, {0, 0}, {}, 1);
}

}  // namespace
}  // namespace delone::voronoi
