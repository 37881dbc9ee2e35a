// SPDX-License-Identifier: BSD-3-Clause
// The arrays of small diagrams: which cells merge, which edges have ridges, which hull facets share a ray.
#include <delone/delaunay.hpp>
#include <delone/regular.hpp>
#include <delone/voronoi.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace delone::voronoi {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Point2 = std::array<double, 2>;

/// The lattice {0 … side−1}^D.
template <int D>
std::vector<std::array<double, D>> lattice(int side) {
  std::vector<std::array<double, D>> points{{}};
  for (std::size_t j = 0; j < D; ++j) {
    const auto before = points;
    for (int x = 1; x < side; ++x)
      for (auto p : before) {
        p[j] = x;
        points.push_back(p);
      }
  }
  return points;
}

std::vector<double> list(std::span<const double> numbers) { return {numbers.begin(), numbers.end()}; }

std::vector<SignedIndex> list(std::span<const SignedIndex> numbers) {
  return {numbers.begin(), numbers.end()};
}

// All cells of a cube share one sphere: one vertex, a ridge for each edge of the cube and a ray for each
// facet, but none for diagonals.
template <int D>
void expect_cube() {
  const Delaunay<D> t(lattice<D>(2));
  const Voronoi diagram(t);
  EXPECT_THAT(list(diagram.vertices()), ::testing::Each(0.5));
  EXPECT_EQ(diagram.num_vertices(), 1u);
  EXPECT_EQ(diagram.num_ridges(), std::size_t{D} << (D - 1));
  EXPECT_EQ(diagram.num_rays(), std::size_t{2 * D});
  EXPECT_EQ(diagram.num_unbounded_regions(), std::size_t{1} << D);
  for (std::size_t r = 0; r < diagram.num_regions(); ++r)
    EXPECT_THAT(list(diagram.region(r)), ElementsAre(-1, 0));
  for (std::size_t r = 0; r < diagram.num_ridges(); ++r) {
    const auto s = diagram.site(static_cast<std::size_t>(diagram.ridge_points()[2 * r])),
               u = diagram.site(static_cast<std::size_t>(diagram.ridge_points()[2 * r + 1]));
    double distance = 0;
    for (std::size_t j = 0; j < D; ++j) distance += std::fabs(s[j] - u[j]);
    EXPECT_EQ(distance, 1);
  }
  std::set<std::vector<double>> directions;
  for (std::size_t r = 0; r < diagram.num_rays(); ++r)
    directions.insert(list(diagram.ray_directions().subspan(r * D, D)));
  EXPECT_EQ(directions.size(), std::size_t{2 * D});
}

TEST(VoronoiBuilder, MergesTheCellsOfACube) {
  expect_cube<2>();
  expect_cube<3>();
  expect_cube<4>();
  expect_cube<5>();
}

TEST(VoronoiBuilder, OfALattice) {
  const Delaunay<2> t(lattice<2>(3));
  const Voronoi plane(t);
  EXPECT_EQ(plane.num_vertices(), 4u);
  EXPECT_EQ(plane.num_ridges(), 12u);
  EXPECT_EQ(plane.num_rays(), 8u);
  EXPECT_EQ(plane.num_unbounded_regions(), 8u);
  const auto middle = static_cast<std::size_t>(plane.point_region()[4]);
  EXPECT_THAT(list(plane.site(middle)), ElementsAre(1, 1));
  EXPECT_EQ(plane.region(middle).size(), 4u);
  const Delaunay<3> solid(lattice<3>(3));
  const Voronoi space(solid);
  EXPECT_EQ(space.num_vertices(), 8u);
  EXPECT_EQ(space.num_ridges(), 54u);  // 3·(2·3·3) unit edges
  EXPECT_EQ(space.num_rays(), 24u);
  for (std::size_t r = 0; r < space.num_ridges(); ++r) {
    const auto ridge = space.ridge(r);  // a square, two rays or a quadrant
    EXPECT_EQ(ridge.size(), ridge[0] < 0 ? ridge.size() == 3 ? 3u : 2u : 4u);
  }
}

// One unit in the last place: two spheres, though their centers round to one point.
TEST(VoronoiBuilder, DoesNotMergeAcrossOneUnit) {
  const Delaunay<2> t(std::vector<Point2>{{0, 0}, {1, 0}, {1, 1}, {0x1p-60, 1}});
  const Voronoi diagram(t);
  EXPECT_EQ(diagram.num_vertices(), 2u);
  EXPECT_EQ(list(diagram.vertex(0)), list(diagram.vertex(1)));
  EXPECT_EQ(diagram.num_ridges(), 5u);
  EXPECT_EQ(diagram.num_rays(), 4u);
}

// Counterclockwise regions; bisectors of the square {−2, 2}² and the origin.
TEST(VoronoiBuilder, OrdersRegionsInThePlane) {
  const Delaunay<2> t(std::vector<Point2>{{0, 0}, {2, 2}, {-2, 2}, {-2, -2}, {2, -2}});
  const Voronoi diagram(t);
  const auto region = diagram.region(0);
  ASSERT_EQ(region.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto p = diagram.vertex(static_cast<std::size_t>(region[i])),
               q = diagram.vertex(static_cast<std::size_t>(region[(i + 1) % 4]));
    EXPECT_EQ(p[0] * q[1] - p[1] * q[0], 4);  // the corners are (±2, 0) and (0, ±2)
  }
  for (std::size_t r = 1; r < 5; ++r) {
    EXPECT_FALSE(diagram.is_bounded(r));
    EXPECT_EQ(diagram.region(r)[0], -1);
    EXPECT_EQ(diagram.region(r).size(), 3u);
  }
}

TEST(VoronoiBuilder, OfFlatInput) {
  const Delaunay<2> line(std::vector<Point2>{{0, 0}, {4, 2}, {2, 1}, {0, 0}});
  const Voronoi diagram(line);
  EXPECT_EQ(diagram.num_vertices(), 2u);
  EXPECT_EQ(diagram.vertices()[0] + diagram.vertices()[2], 4);  // (1, 1/2) and (3, 3/2)
  EXPECT_EQ(diagram.num_ridges(), 2u);
  EXPECT_THAT(list(diagram.point_region()), ElementsAre(0, 1, 2, 0));
  EXPECT_THAT(list(diagram.region_points()), ElementsAre(0, 1, 2));
  EXPECT_TRUE(diagram.is_bounded(2));
  EXPECT_FALSE(diagram.is_bounded(0));
  EXPECT_EQ(diagram.num_rays(), 2u);
  for (std::size_t r = 0; r < 2; ++r)
    EXPECT_NEAR(std::fabs(diagram.ray_directions()[2 * r] + diagram.ray_directions()[2 * r + 1]),
                3 / std::sqrt(5.0), 1e-12);
}

TEST(VoronoiBuilder, OfOnePointAndOfNone) {
  const Delaunay<2> one(std::vector<Point2>{{1, 2}, {1, 2}});
  const Voronoi point(one);
  EXPECT_EQ(point.num_vertices(), 0u);
  EXPECT_EQ(point.num_regions(), 1u);
  EXPECT_FALSE(point.is_bounded(0));
  EXPECT_THAT(list(point.point_region()), ElementsAre(0, 0));
  const Delaunay<2> empty;
  const Voronoi none(empty);
  EXPECT_EQ(none.num_regions(), 0u);
  EXPECT_THAT(list(none.region_vertices()), IsEmpty());
}

// Hidden points have no region, and the bisector moves with the weights.
TEST(VoronoiBuilder, OfWeightedPoints) {
  const Regular<1> t(std::vector<std::array<double, 1>>{{0}, {4}, {1}}, std::vector<double>{9, 1, -99});
  const PowerDiagram diagram(t);
  EXPECT_THAT(list(diagram.vertices()), ElementsAre(3));  // x² − 9 = (x − 4)² − 1
  EXPECT_THAT(list(diagram.point_region()), ElementsAre(0, 1, -1));
  EXPECT_EQ(diagram.num_regions(), 2u);
  EXPECT_EQ(diagram.weight(0), 9);
}

TEST(VoronoiBuilder, NumbersOutOfRangeAreRefusedWhenHardened) {
  if (!DELONE_HARDENED) GTEST_SKIP() << "not a hardened build";
  const std::vector<std::array<double, 2>> corners{{0, 0}, {2, 0}, {0, 3}};
  const Voronoi diagram{Delaunay<2>(corners)};
  EXPECT_NO_THROW(diagram.region(2));
  EXPECT_THROW(diagram.vertex(1), Error);
  EXPECT_THROW(diagram.ridge(3), Error);
  EXPECT_THROW(diagram.region(3), Error);
  EXPECT_THROW(diagram.is_bounded(3), Error);
  EXPECT_THROW(diagram.site(3), Error);
  EXPECT_THROW(diagram.weight(3), Error);
}

}  // namespace
}  // namespace delone::voronoi
