// SPDX-License-Identifier: BSD-3-Clause
// Measures of thin and of far regions, and which facets are proper.
#include "voronoi/region_clipper.hpp"

#include "degenerate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace delone::voronoi {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The region of point 0 among the points, all of weight 0.
class OneRegion {
 public:
  OneRegion(const Box& box, std::vector<double> points, std::vector<double> halfspaces = {})
      : points_(std::move(points)), halfspaces_(std::move(halfspaces)), clipper(box, false, halfspaces_) {
    std::vector<RegionClipper::Site> others;
    for (std::size_t i = box.low.size(); i < points_.size(); i += box.low.size())
      others.push_back({points_.data() + i, 0});
    clipper.clip({points_.data(), 0}, others);
  }
  std::map<std::size_t, double> areas() {
    std::map<std::size_t, double> found;
    for (const auto& facet : clipper.measures().facets) found[facet.label] = facet.volume;
    return found;
  }
  std::vector<std::pair<std::size_t, std::size_t>> proper() {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    if (!clipper.has_interior({})) return found;
    for (const auto& facet : clipper.facets(clipper.exact_numbers(), true))
      found.emplace_back(facet.plane, facet.corners.size());
    return found;
  }

 private:
  std::vector<double> points_, halfspaces_;

 public:
  RegionClipper clipper;
};

Box box_of(std::size_t d, double low, double high) { return {std::vector(d, low), std::vector(d, high)}; }

TEST(ClippedMeasures, OfThinRegionsHaveAllDigits) {
  for (const int thinness : {0, 19, 30, 500}) {
    const double side = std::ldexp(1.0, -thinness);
    // Half of a rectangle, left of x = 1/2; and below a diagonal.
    OneRegion half({{0, 0}, {1, side}}, {0.25, 0, 0.75, 0});
    auto measures = half.clipper.measures();
    EXPECT_EQ(measures.volume, 0.5 * side) << thinness;
    EXPECT_THAT(measures.centroid, ElementsAre(0, 0.5 * side));
    EXPECT_EQ(half.areas(), (std::map<std::size_t, double>{{0, side}, {2, 0.5}, {3, 0.5}, {4, side}}))
        << thinness;
    OneRegion triangle({{0, 0}, {1, side}}, {0.25, 0}, {1, 1 / side, -1});
    measures = triangle.clipper.measures();
    EXPECT_NEAR(measures.volume / side, 0.5, 1e-15) << thinness;
    EXPECT_NEAR(measures.centroid[0], 1.0 / 3 - 0.25, 1e-15);
    EXPECT_NEAR(measures.centroid[1] / side, 1.0 / 3, 1e-15);
    auto areas = triangle.areas();
    EXPECT_NEAR(areas[4], std::hypot(1, side), 1e-15) << thinness;
    EXPECT_EQ(areas[0], side);
    EXPECT_EQ(areas[2], 1);
  }
}

TEST(ClippedMeasures, OfFarRegionsHaveAllDigits) {
  for (const double away : {0.0, 0x1p12, 0x1p30, 0x1p50}) {
    // In a unit box far away from the site: x + 2y ≤ 1 there, and 3x + y ≤ 1, whose corner is at (1/5, 2/5).
    OneRegion region({{away, away}, {away + 1, away + 1}}, {0, 0},
                     {1, 2, -3 * away - 1, 3, 1, -4 * away - 1});
    const auto measures = region.clipper.measures();
    EXPECT_NEAR(measures.volume, 7.0 / 60, 1e-15)
        << away;  // of the corners 0, (1/3, 0), (1/5, 2/5), (0, 1/2)
    EXPECT_NEAR(region.areas().at(0), 0.5, 1e-15) << away;
    EXPECT_NEAR(region.areas().at(2), 1.0 / 3, 1e-15) << away;
    EXPECT_NEAR(measures.centroid[0] - away, 41.0 / 315, 1e-15 + away * 0x1p-52) << away;
  }
}

TEST(ClippedMeasures, FacetsWithoutAreaAreNotProper) {
  // The center of a lattice: most bisectors touch its region in an edge or a corner.
  for (std::size_t d = 1; d <= 4; ++d) {
    const test::PointSet lattice = test::lattice(static_cast<int>(d), 3);
    std::vector<double> points(d, 1.0);
    for (std::size_t i = 0; i < lattice.points.size(); i += d)
      if (2 * i + d != lattice.points.size())
        points.insert(points.end(), lattice.points.begin() + static_cast<std::ptrdiff_t>(i),
                      lattice.points.begin() + static_cast<std::ptrdiff_t>(i + d));
    OneRegion region(box_of(d, -5, 5), points);
    const auto proper = region.proper();
    EXPECT_EQ(proper.size(), 2 * d) << d;
    for (const auto& [plane, corners] : proper) {
      EXPECT_EQ(corners, std::size_t{1} << (d - 1)) << d;
      double distance = 0;
      for (std::size_t j = 0; j < d; ++j)
        distance += std::abs(points[(region.clipper.other_of(plane) + 1) * d + j] - 1);
      EXPECT_EQ(distance, 1) << "a neighbor along an axis";
    }
  }
}

TEST(ClippedMeasures, WithoutInteriorThereAreNoProperFacets) {
  for (std::size_t d = 1; d <= 4; ++d) {
    std::vector<double> points(2 * d, 0.5);
    points[0] = 1.5;  // the bisector is the side of the box on which x = 1
    OneRegion flat(box_of(d, 0, 1), points);
    EXPECT_THAT(flat.proper(), IsEmpty()) << d;
    EXPECT_EQ(flat.clipper.measures().volume, 0) << d;
    OneRegion whole(box_of(d, 0, 1), std::vector<double>(d, 0.5));
    EXPECT_EQ(whole.proper().size(), 2 * d) << d;
  }
}

TEST(ClippedMeasures, BisectorsMayBeSidesOfTheBox) {
  const Box square = box_of(2, 0, 1);
  OneRegion on_the_side(square, {0.5, 0.5, 1.5, 0.5});
  EXPECT_EQ(on_the_side.clipper.fixed_plane_of(4), 1u) << "x ≤ 1";
  EXPECT_EQ(on_the_side.clipper.fixed_plane_of(2), 2u) << "itself";
  OneRegion inside(square, {0.5, 0.5, 1.25, 0.5});
  EXPECT_EQ(inside.clipper.fixed_plane_of(4), 4u);
  OneRegion of_the_other_side(square, {1.5, 0.5, 0.5, 0.5});
  EXPECT_EQ(of_the_other_side.clipper.fixed_plane_of(4), 4u) << "x ≥ 1";
  // A side of the box and a halfspace, twice as long.
  OneRegion on_a_halfspace(square, {0.25, 0.25, 0.75, 0.75}, {2, 2, -2});
  EXPECT_EQ(on_a_halfspace.clipper.fixed_plane_of(5), 4u) << "x + y ≤ 1";
}

}  // namespace
}  // namespace delone::voronoi
