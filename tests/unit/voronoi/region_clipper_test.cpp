// SPDX-License-Identifier: BSD-3-Clause
// Regions of a few sites in a box, with bisectors through corners, along faces and one unit beside them.
#include "voronoi/region_clipper.hpp"

#include "degenerate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

namespace delone::voronoi {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Box cube(std::size_t d, double low, double high) { return {std::vector(d, low), std::vector(d, high)}; }

/// The region of point 0 among the points.
struct Clipped {
  Clipped(const Box& box, const std::vector<double>& points, std::vector<double> weights = {})
      : clipper(box) {
    const std::size_t d = box.low.size(), n = points.size() / d;
    weights.resize(n, 0);
    std::vector<RegionClipper::Site> others;
    for (std::size_t i = 1; i < n; ++i) others.push_back({points.data() + i * d, weights[i]});
    clipper.clip({points.data(), weights[0]}, others);
    volume = clipper.volume();
    if (d <= 3) region = clipper.geometry();
  }
  std::set<std::vector<double>> corners() const {
    const std::size_t d = dimension();
    std::set<std::vector<double>> result;
    for (std::size_t i = 0; i < region.corners.size(); i += d)
      result.emplace(region.corners.begin() + static_cast<std::ptrdiff_t>(i),
                     region.corners.begin() + static_cast<std::ptrdiff_t>(i + d));
    EXPECT_EQ(result.size() * d, region.corners.size()) << "corners are distinct";
    return result;
  }
  std::size_t dimension() const { return region.faces.empty() ? 1 : region.faces.size() == 1 ? 2 : 3; }

  RegionClipper clipper;
  double volume;
  ClippedRegion region;
};

TEST(RegionClipper, OfOneSiteIsTheBox) {
  for (std::size_t d = 1; d <= 5; ++d)
    EXPECT_NEAR(Clipped(cube(d, -1, 2), std::vector(d, 7.0)).volume, std::pow(3.0, d), 1e-12) << d;
  const Clipped square(cube(2, 0, 1), {0.25, 0.5});
  EXPECT_EQ(square.corners(), (std::set<std::vector<double>>{{0, 0}, {0, 1}, {1, 0}, {1, 1}}));
  const Clipped solid(cube(3, 0, 1), {0.25, 0.5, 0.5});
  EXPECT_EQ(solid.region.faces.size(), 6u);
  EXPECT_EQ(solid.corners().size(), 8u);
}

TEST(RegionClipper, OnALine) {
  const Clipped piece(cube(1, 0, 10), {4, 3, 7, 1, 100});
  EXPECT_EQ(piece.volume, 2);
  EXPECT_THAT(piece.region.corners, ElementsAre(3.5, 5.5));
  EXPECT_THAT(piece.region.faces, ElementsAre(ElementsAre(0, 1)));
}

// The bisector passes through two corners of the box, along one of its edges, or misses it.
TEST(RegionClipper, BisectorsThroughCorners) {
  const Clipped triangle(cube(2, 0, 1), {0, 0, 1, 1});
  EXPECT_NEAR(triangle.volume, 0.5, 1e-15);
  EXPECT_EQ(triangle.corners(), (std::set<std::vector<double>>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_THAT(triangle.region.faces, ElementsAre(::testing::SizeIs(3)));
  const Clipped all(cube(2, 0, 1), {0.5, 0.5, 1.5, 0.5});
  EXPECT_EQ(all.volume, 1);
  EXPECT_EQ(all.corners().size(), 4u);
  const Clipped none(cube(2, 0, 1), {1.5, 0.5, 0.5, 0.5});  // touches the box in an edge
  EXPECT_EQ(none.volume, 0);
  EXPECT_THAT(none.region.faces, IsEmpty());
  EXPECT_THAT(none.region.corners, IsEmpty());
}

TEST(RegionClipper, SeesOneUnitInTheLastPlace) {
  const double beyond = std::nextafter(1.5, 1.0);
  const Clipped strip(cube(2, 0, 1), {beyond, 0.5, 0.5, 0.5});  // bisector one unit inside the box
  EXPECT_EQ(strip.corners().size(), 4u);
  EXPECT_EQ(strip.volume, 0x1p-53);
}

// Counterclockwise polygons, whatever side the site is on.
TEST(RegionClipper, OrientsPolygons) {
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}}) {
    const Clipped triangle(cube(2, 0, 1), {x, y, 1 - x, 1 - y});
    const auto& face = triangle.region.faces.at(0);
    double twice_area = 0;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const double* p = triangle.region.corners.data() + 2 * face[i];
      const double* q = triangle.region.corners.data() + 2 * face[(i + 1) % face.size()];
      twice_area += p[0] * q[1] - p[1] * q[0];
    }
    EXPECT_EQ(twice_area, 1);
  }
}

// The center of a 3×…×3 lattice: 3^d − 1 bisectors, most of which touch the region in less than a facet.
TEST(RegionClipper, OfALatticePoint) {
  for (int d = 1; d <= 4; ++d) {
    std::vector<double> points(static_cast<std::size_t>(d), 1.0);
    const test::PointSet lattice = test::lattice(d, 3);
    const auto width = static_cast<std::size_t>(d);
    for (std::size_t i = 0; i < lattice.size(); ++i)
      if (2 * i + 1 != lattice.size())
        points.insert(points.end(), lattice.points.begin() + static_cast<std::ptrdiff_t>(i * width),
                      lattice.points.begin() + static_cast<std::ptrdiff_t>((i + 1) * width));
    const Clipped region(cube(width, -5, 5), points);
    EXPECT_EQ(region.volume, 1) << d;
    if (d != 3) continue;
    EXPECT_EQ(region.corners().size(), 8u);
    EXPECT_EQ(region.region.faces.size(), 6u);
    for (const auto& face : region.region.faces) EXPECT_EQ(face.size(), 4u);
  }
}

// The bisectors of the 8 diagonal neighbors cut a cube into an octahedron, two corners of the cube at a time:
// |x| + |y| + |z| ≤ 3/2 of a site at 0 with others at (±1, ±1, ±1).
TEST(RegionClipper, OfAnOctahedron) {
  std::vector<double> points = {0, 0, 0};
  for (const double x : {-1, 1})
    for (const double y : {-1, 1})
      for (const double z : {-1, 1}) points.insert(points.end(), {x, y, z});
  const Clipped region(cube(3, -2, 2), points);
  EXPECT_NEAR(region.volume, 4.5, 1e-14);  // 4/3·(3/2)³
  EXPECT_EQ(region.corners().size(), 6u);  // each on four planes
  EXPECT_EQ(region.region.faces.size(), 8u);
  // Faces are counterclockwise seen from outside: their cones from the site have positive volume.
  for (const auto& face : region.region.faces) {
    ASSERT_EQ(face.size(), 3u);
    const double *p = &region.region.corners[3 * face[0]], *q = &region.region.corners[3 * face[1]],
                 *r = &region.region.corners[3 * face[2]];
    EXPECT_GT(p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) +
                  p[2] * (q[0] * r[1] - q[1] * r[0]),
              0);
  }
}

TEST(RegionClipper, WeightsMoveBisectors) {
  // (t − s)·y ≤ (|t − s|² − w_t)/2
  EXPECT_EQ(Clipped(cube(1, 0, 10), {4, 8}, {0, 8}).volume, 5);
  EXPECT_EQ(Clipped(cube(1, 0, 10), {4, 8}, {8, 0}).volume, 7);
  EXPECT_EQ(Clipped(cube(1, 0, 10), {4, 8}, {0, 48}).volume, 0);
  EXPECT_EQ(Clipped(cube(2, 0, 1), {0.5, 0.5, 0.5, 1.5}, {0, 1}).volume, 0.5);
  EXPECT_EQ(Clipped(cube(2, 0, 1), {0.5, 0.5, 0.5, 1.5}, {0, 2}).volume, 0);  // along an edge of the box
}

TEST(RegionClipper, AtTheEndsOfTheRange) {
  for (const double scale : {1e-100, 1e-70, 1e70, 1e100}) {
    const Clipped half(cube(2, 0, scale), {0, 0, scale, scale});
    EXPECT_NEAR(half.volume / scale / scale, 0.5, 1e-15) << scale;
    EXPECT_EQ(half.corners().size(), 3u);
  }
  const Clipped wide(cube(1, -1.5e308, 1.5e308), {0, 1});
  EXPECT_EQ(wide.region.corners[1], 0.5);
  // Sites far outside the box, and close to each other.
  const double next = std::nextafter(1e9, 2e9);
  EXPECT_EQ(Clipped(cube(2, 0, 1), {1e9, 0, next, 0}).volume, 1);
  EXPECT_EQ(Clipped(cube(2, 0, 1), {next, 0, 1e9, 0}).volume, 0);
}

// Volumes of all regions of a set add up to that of the box.
TEST(RegionClipper, PartitionsTheBox) {
  for (const test::PointSet& set : test::degenerate_sets(3, 12, 4)) {
    double largest = 0;
    for (const double x : set.points) largest = std::max(largest, std::fabs(x));
    if (largest > 1e4 || largest < 1e-2) continue;
    std::set<std::vector<double>> distinct;
    for (std::size_t i = 0; i < set.points.size(); i += 3)
      distinct.emplace(set.points.begin() + static_cast<std::ptrdiff_t>(i),
                       set.points.begin() + static_cast<std::ptrdiff_t>(i + 3));
    double sum = 0;
    for (const auto& first : distinct) {
      std::vector<double> points = first;
      for (const auto& other : distinct)
        if (other != first) points.insert(points.end(), other.begin(), other.end());
      sum += Clipped(cube(3, -3, 3), points).volume;
    }
    EXPECT_NEAR(sum, 216, 1e-9) << set.name;
  }
}

}  // namespace
}  // namespace delone::voronoi
