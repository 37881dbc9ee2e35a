// SPDX-License-Identifier: BSD-3-Clause
// The arrays of small intersections, written down by hand.
#include "halfspaces/intersection_arrays.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace delone::halfspaces {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using enum HalfspaceKind;

IntersectionData intersect(const std::vector<double>& rows, int d) {
  return HalfspaceIntersection(rows, d).to_data();
}

template <class Range>
std::vector<SignedIndex> list(const Range& range) {
  return {range.begin(), range.end()};
}

TEST(IsStrictlyInside, DecidesExactly) {
  const double row[] = {1, 1, -2};
  EXPECT_TRUE(is_strictly_inside(row, {{1, 1 - 0x1p-53}, {}}));
  EXPECT_FALSE(is_strictly_inside(row, {{1, 1}, {}}));
  EXPECT_FALSE(is_strictly_inside(row, {{1, 1 + 0x1p-52}, {}}));
  // (2/3, 4/3) is on the line; its rounding says nothing.
  EXPECT_FALSE(is_strictly_inside(row, {{0, 0}, {2, 4}, 3}));
  EXPECT_TRUE(is_strictly_inside(
      row,
      {{9, 9}, {kernel::Integer(1) << 200, (kernel::Integer(1) << 200) - 1}, kernel::Integer(1) << 200}));
}

TEST(IntersectionArrays, OfARay) {
  const IntersectionData ray = intersect({-1, 2, -1, 1}, 1);  // x ≥ 2 and x ≥ 1
  EXPECT_FALSE(ray.bounded);
  EXPECT_THAT(ray.vertices, ElementsAre(2));
  EXPECT_THAT(ray.directions, ElementsAre(1));
  EXPECT_THAT(ray.rays, ElementsAre(0, 0));
  EXPECT_THAT(ray.edges, IsEmpty());
  EXPECT_THAT(ray.kinds, ElementsAre(facet, redundant));
}

TEST(IntersectionArrays, OfASegment) {
  const IntersectionData segment = intersect({2, -6, -1, 1, 1, -3}, 1);  // x ≤ 3, x ≥ 1, x ≤ 3
  EXPECT_TRUE(segment.bounded);
  EXPECT_EQ(segment.num_vertices(), 2u);
  EXPECT_EQ(segment.vertices[0] + segment.vertices[1], 4);
  EXPECT_THAT(segment.edges, ElementsAre(0, 1));
  EXPECT_THAT(segment.rays, IsEmpty());
  EXPECT_THAT(segment.kinds, ElementsAre(facet, facet, duplicate));
  EXPECT_THAT(segment.first_of_halfspace, ElementsAre(0, 1, 0));
}

// The unit square, with a line through a corner, one beyond, one on an edge, and 0 ≤ 1.
TEST(IntersectionArrays, OfASquare) {
  const IntersectionData square =
      intersect({1, 0, -1, -1, 0, 0, 0, 1, -1, 0, -1, 0, 1, 1, -2, 1, 1, -3, 3, 0, -3, 0, 0, -1}, 2);
  EXPECT_TRUE(square.bounded);
  EXPECT_THAT(square.kinds, ElementsAre(facet, facet, facet, facet, touching, redundant, duplicate, trivial));
  EXPECT_THAT(square.facet_halfspaces, ElementsAre(0, 1, 2, 3));
  ASSERT_EQ(square.num_vertices(), 4u);
  EXPECT_EQ(square.num_edges(), 4u);
  std::set<std::vector<double>> corners;
  for (std::size_t v = 0; v < 4; ++v) {
    const auto x = square.vertex(v);
    corners.emplace(x.begin(), x.end());
    const std::vector<SignedIndex> expected = {x[0] == 1 ? 0 : 1, x[1] == 1 ? 2 : 3};
    EXPECT_EQ(list(square.halfspaces_of_vertex(v)), expected);  // the touching row is not among them
  }
  EXPECT_EQ(corners, (std::set<std::vector<double>>{{0, 0}, {0, 1}, {1, 0}, {1, 1}}));
  // The interior point is the center: the dual points are at ±2, and those of the rows of a corner satisfy
  // the dual equation of that corner.
  EXPECT_THAT(square.interior_point, ElementsAre(0.5, 0.5));
  EXPECT_EQ(square.dual_points[0], 2);
  for (std::size_t v = 0; v < 4; ++v)
    for (const SignedIndex row : square.halfspaces_of_vertex(v)) {
      const double* y = square.dual_points.data() + 2 * row;
      const double* equation = square.dual_equations.data() + 3 * v;
      EXPECT_NEAR(equation[0] * y[0] + equation[1] * y[1] + equation[2], 0, 1e-15);
    }
}

TEST(IntersectionArrays, OfAQuadrantAndAStrip) {
  const IntersectionData quadrant = intersect({-1, 0, 0, 0, -1, 0}, 2);
  EXPECT_THAT(quadrant.vertices, ElementsAre(0, 0));
  EXPECT_EQ(quadrant.num_directions(), 2u);
  EXPECT_EQ(quadrant.num_rays(), 2u);
  for (std::size_t r = 0; r < 2; ++r) {
    const auto direction = quadrant.direction(r);
    EXPECT_EQ(direction[0] + direction[1], 1);
    EXPECT_EQ(list(quadrant.halfspaces_of_direction(r)), std::vector<SignedIndex>{direction[0] == 1 ? 1 : 0});
  }
  EXPECT_THAT(intersect({-1, 0, 0, 0, -1, 0, -1, 0, -3}, 2).kinds, ElementsAre(facet, facet, redundant));
  // |x + y| ≤ 1 contains a line; it is a segment times that line.
  const IntersectionData strip = intersect({1, 1, -1, -1, -1, -1}, 2);
  EXPECT_EQ(strip.rank, 1);
  EXPECT_FALSE(strip.bounded);
  EXPECT_THAT(strip.axes, ElementsAre(0));
  EXPECT_EQ(strip.num_vertices(), 2u);
  EXPECT_THAT(strip.edges, ElementsAre(0, 1));
  const double half = std::sqrt(0.5);
  EXPECT_THAT(strip.lineality, ElementsAre(DoubleNear(-half, 1e-15), DoubleNear(half, 1e-15)));
}

// An octahedron by 8 rows, a touching plane at each of its 6 vertices: more rows meet there than define it.
TEST(IntersectionArrays, OfAnOctahedron) {
  std::vector<double> rows;
  for (const double x : {-1, 1})
    for (const double y : {-1, 1})
      for (const double z : {-1, 1}) rows.insert(rows.end(), {x, y, z, -1});
  for (std::size_t j = 0; j < 3; ++j)
    for (const double side : {-1, 1}) {
      double row[4] = {0, 0, 0, -1};
      row[j] = side;
      rows.insert(rows.end(), row, row + 4);
    }
  const IntersectionData octahedron = intersect(rows, 3);
  EXPECT_EQ(octahedron.num_vertices(), 6u);
  EXPECT_EQ(octahedron.num_edges(), 12u);
  EXPECT_EQ(octahedron.num_facets(), 8u);
  for (std::size_t r = 0; r < 14; ++r) EXPECT_EQ(octahedron.kinds[r], r < 8 ? facet : touching);
  for (std::size_t v = 0; v < 6; ++v) EXPECT_EQ(octahedron.halfspaces_of_vertex(v).size(), 4u);
  for (std::size_t f = 0; f < 8; ++f) {
    const auto corners = octahedron.facet(f);
    ASSERT_EQ(corners.size(), 3u);
    double p[3][3];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        p[i][j] = octahedron.vertex(static_cast<std::size_t>(corners[i]))[j];
    const double det = p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) -
                       p[0][1] * (p[1][0] * p[2][2] - p[1][2] * p[2][0]) +
                       p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
    EXPECT_EQ(det, 1);  // counterclockwise seen from outside
  }
}

// A square pillar, open upwards: its sides are unbounded facets, whose vertices come before the directions.
// The last row meets it only at infinity.
TEST(IntersectionArrays, OfAPillar) {
  const IntersectionData pillar =
      intersect({1, 0, 0, -1, -1, 0, 0, -1, 0, 1, 0, -1, 0, -1, 0, -1, 0, 0, -1, 0, 1, 0, 0, -5}, 3);
  EXPECT_FALSE(pillar.bounded);
  EXPECT_THAT(pillar.kinds, ElementsAre(facet, facet, facet, facet, facet, redundant));
  EXPECT_EQ(pillar.num_vertices(), 4u);
  EXPECT_EQ(pillar.num_edges(), 4u);
  EXPECT_EQ(pillar.num_rays(), 4u);
  EXPECT_THAT(pillar.directions, ElementsAre(0, 0, 1));
  EXPECT_THAT(list(pillar.halfspaces_of_direction(0)), ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(pillar.facet(4).size(), 4u);
  for (std::size_t f = 0; f < 4; ++f) {
    EXPECT_EQ(pillar.directions_of_facet(f).size(), 1u);
    const auto corners = pillar.facet(f);
    ASSERT_EQ(corners.size(), 2u);
    // Counterclockwise seen from outside: the edge, times the direction upwards, points outwards.
    const auto p = pillar.vertex(static_cast<std::size_t>(corners[0])),
               q = pillar.vertex(static_cast<std::size_t>(corners[1]));
    const double* n = pillar.halfspaces.data() + 4 * f;
    EXPECT_EQ((q[1] - p[1]) * n[0] - (q[0] - p[0]) * n[1], 2);
  }
}

TEST(IntersectionArrays, WithoutInteriorNameTheirWitness) {
  const IntersectionData flat = intersect({0, 1, -9, 1, 0, 0, -1, 0, 0}, 2);
  EXPECT_EQ(flat.state, IntersectionState::flat);
  EXPECT_THAT(flat.witness, ElementsAre(1, 2));
  EXPECT_THAT(flat.kinds, IsEmpty());
  EXPECT_EQ(intersect({1, 1, -1, 1}, 1).state, IntersectionState::empty);
}

TEST(IntersectionParts, WithoutRowsAreAllOfSpace) {
  const IntersectionParts parts(2);
  EXPECT_EQ(parts.rank(), 0);
  EXPECT_TRUE(std::isnan(dual_measure(parts, true).value));
  const IntersectionData space = intersection_arrays(parts);
  EXPECT_EQ(space.num_vertices(), 0u);
  EXPECT_THAT(space.lineality, ElementsAre(1, 0, 0, 1));
}

}  // namespace
}  // namespace delone::halfspaces
