// SPDX-License-Identifier: BSD-3-Clause
// Volumes of boxes and of their images by linear maps, and of the ridges of diagrams against convex hulls of
// their vertices.
#include "voronoi/face_volumes.hpp"

#include "base/random.hpp"
#include "scale.hpp"

#include <delone/convex_hull.hpp>
#include <delone/delaunay.hpp>
#include <delone/regular.hpp>
#include <delone/voronoi.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace delone::voronoi {
namespace {

/// The volume of the image of [−1, 1]^d by the map whose columns are e_j + slant·e_0, and whether it is
/// accurate. The normals of the image are the rows of the inverse.
std::pair<double, bool> slanted_box(std::size_t d, double slant, double height) {
  FaceVolumes faces(d, d);
  std::vector<double> points(d, 0.0);
  for (std::size_t plane = 0; plane < 2 * d; ++plane)
    for (std::size_t j = 0; j < d; ++j) {
      const double row = plane / 2 == j ? 1.0 : plane / 2 == 0 ? -slant : 0.0;
      points.push_back(plane % 2 == 0 ? -row : row);
    }
  faces.set_points(points);
  for (std::size_t c = 0; c < std::size_t{1} << d; ++c) {
    std::vector<double> x(d);
    std::vector<Index> labels{0};
    for (std::size_t j = 0; j < d; ++j) {
      const bool is_high = (c >> j & 1) != 0;
      x[j] = is_high ? 1 : -1;
      if (j + 1 == d && is_high) x[j] = height - 1;
      if (j > 0) x[0] += slant * x[j];
      labels.push_back(static_cast<Index>(1 + 2 * j + (is_high ? 1 : 0)));
    }
    faces.add_corner(x, 0, labels);
  }
  std::vector<unsigned char> wanted(2 * d + 1, 0);
  wanted[0] = 1;
  std::pair<double, bool> result{-1, false};
  faces.measure(1, wanted, [&](const FaceVolumes::Face& face) {
    EXPECT_EQ(face.labels[0], 0u);
    result = {face.volume, face.is_accurate};
  });
  return result;
}

TEST(FaceVolumes, Boxes) {
  for (std::size_t d = 2; d <= 7; ++d)
    for (const double slant : {0.0, 0.5, -3.0}) {
      const auto [volume, is_accurate] = slanted_box(d, slant, 2);
      EXPECT_NEAR(volume / std::pow(2.0, static_cast<double>(d)), 1, 1e-13);
      EXPECT_TRUE(is_accurate);
      EXPECT_EQ(slanted_box(d, slant, 0).first, 0);
    }
}

TEST(FaceVolumes, NotANumberIsNotAccurate) {
  EXPECT_FALSE(slanted_box(4, std::numeric_limits<double>::quiet_NaN(), 2).second);
}

/// Ridges are orthogonal to the line through their two sites; they are projected along an axis.
void expect_ridges_are_hulls(const Diagram& diagram, int d) {
  const std::vector<double> volumes = diagram.ridge_volumes();
  std::size_t num_bounded = 0;
  for (std::size_t r = 0; r < diagram.num_ridges(); ++r) {
    const auto vertices = diagram.ridge(r);
    if (vertices.front() < 0) {
      EXPECT_EQ(volumes[r], std::numeric_limits<double>::infinity());
      continue;
    }
    const auto region = [&](std::size_t end) {
      return static_cast<std::size_t>(
          diagram.point_region()[static_cast<std::size_t>(diagram.ridge_points()[2 * r + end])]);
    };
    const auto a = diagram.site(region(0)), b = diagram.site(region(1));
    std::vector<double> normal(static_cast<std::size_t>(d));
    std::size_t axis = 0;
    double square = 0;
    for (std::size_t j = 0; j < normal.size(); ++j) {
      normal[j] = b[j] - a[j];
      square += normal[j] * normal[j];
      if (std::abs(normal[j]) > std::abs(normal[axis])) axis = j;
    }
    std::vector<double> projected;
    for (const SignedIndex v : vertices)
      for (std::size_t j = 0; j < normal.size(); ++j)
        if (j != axis) projected.push_back(diagram.vertex(static_cast<std::size_t>(v))[j]);
    const ConvexHull hull(projected, d - 1);
    const double expected = hull.volume().value * std::sqrt(square) / std::abs(normal[axis]);
    EXPECT_NEAR(volumes[r], expected, 1e-9 * expected);
    ++num_bounded;
  }
  EXPECT_GT(num_bounded, 0u);
}

TEST(FaceVolumes, OfRidgesAreThoseOfHulls) {
  random::Generator generator(3);
  for (const auto& [d, n] : {std::pair{4, 40}, {5, 30}}) {
    std::vector<double> points;
    for (int i = 0; i < n * d; ++i) points.push_back(generator.uniform());
    expect_ridges_are_hulls(Voronoi(Delaunay(points, d)), d);
    std::vector<double> weights;
    for (int i = 0; i < n; ++i) weights.push_back(0.02 * generator.uniform());
    expect_ridges_are_hulls(PowerDiagram(Regular(points, weights, d)), d);
  }
}

}  // namespace
}  // namespace delone::voronoi
