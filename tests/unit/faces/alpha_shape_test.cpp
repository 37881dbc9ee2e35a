// SPDX-License-Identifier: BSD-3-Clause
// Outlines and boundaries of small shapes that are known; sums over their parts against the cells.
#include <delone/alpha_shape.hpp>
#include <delone/delaunay.hpp>
#include <delone/furthest_site.hpp>
#include <delone/regular.hpp>

#include "error_code.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

namespace delone {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The points of a lattice that `is_there` takes.
template <class IsThere>
std::vector<double> lattice_where(int d, int side, const IsThere& is_there) {
  std::vector<double> points;
  for (int i = 0; i < side * side * (d == 3 ? side : 1); ++i) {
    const int x = i % side, y = i / side % side, z = i / side / side;
    if (!is_there(x, y, z)) continue;
    points.insert(points.end(), {double(x), double(y)});
    if (d == 3) points.push_back(z);
  }
  return points;
}

TEST(AlphaShape, PolygonsOfLatticesHaveEachEdgeOnce) {
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    const Delaunay<> t(lattice_where(2, 9, [&](int, int, int) { return random() % 4 != 0; }), 2);
    for (const double square : {0.5, 0.625, 1.25, std::numeric_limits<double>::infinity()}) {
      const AlphaComplex complex = AlphaComplex::of_squared_radius(t, square);
      const Polygons polygons = delone::polygons(complex);
      const ComplexData data = t.to_data();
      std::set<std::pair<SignedIndex, SignedIndex>> edges, expected;
      double twice_area = 0, expected_area = 0;
      const auto area = [&](SignedIndex a, SignedIndex b) {
        const double *const p = &data.points[2 * static_cast<std::size_t>(a)],
                            *const q = &data.points[2 * static_cast<std::size_t>(b)];
        return p[0] * q[1] - p[1] * q[0];
      };
      for (std::size_t i = 0; i < polygons.size(); ++i)
        for (auto r = polygons.polygon_offsets[i]; r < polygons.polygon_offsets[i + 1]; ++r) {
          const auto ring = polygons.ring(static_cast<std::size_t>(r));
          double of_ring = 0;
          for (std::size_t m = 0; m < ring.size(); ++m) {
            const SignedIndex a = ring[m], b = ring[(m + 1) % ring.size()];
            EXPECT_TRUE(edges.emplace(a, b).second);
            of_ring += area(a, b);
          }
          EXPECT_EQ(of_ring > 0, r == polygons.polygon_offsets[i]);
          EXPECT_EQ(std::set<SignedIndex>(ring.begin(), ring.end()).size(), ring.size());
          twice_area += of_ring;
        }
      for (std::size_t f = 0; f < complex.boundary_cells().size(); ++f)
        expected.emplace(complex.boundary()[2 * f], complex.boundary()[2 * f + 1]);
      for (const SignedIndex c : complex.cell_numbers()) {
        const SignedIndex* const cell = &data.cells[3 * static_cast<std::size_t>(c)];
        expected_area += area(cell[0], cell[1]) + area(cell[1], cell[2]) + area(cell[2], cell[0]);
      }
      EXPECT_EQ(edges, expected);
      EXPECT_EQ(twice_area, expected_area);
    }
  }
}

TEST(AlphaShape, PolygonsThatTouchAreApart) {
  // Two triangles that have a corner in common, and three collinear points with one beside them.
  const Delaunay<> t(std::vector<double>{0, 0, 2, 1, 0, 2, 4, 0, 4, 2}, 2);
  const Polygons two = polygons(AlphaComplex::of_squared_radius(t, 1.5625));
  EXPECT_THAT(two.polygon_offsets, ElementsAre(0, 1, 2));
  EXPECT_THAT(two.rows, ElementsAre(0, 1, 2, 1, 3, 4));
  const BoundaryComponents parts = boundary_components(AlphaComplex::of_squared_radius(t, 1.5625));
  EXPECT_THAT(parts.bodies, ElementsAre(0, 1));
  const Delaunay<> line(std::vector<double>{0, 0, 1, 0, 2, 0, 1, 1}, 2);
  EXPECT_THAT(polygons(AlphaComplex(line, 9)).rows, ElementsAre(0, 1, 2, 3));
}

TEST(AlphaShape, ACavityHasASurfaceOfItsOwn) {
  const auto in_shell = [](int x, int y, int z) { return x != 2 || y != 2 || z != 2; };
  const Delaunay<> t(lattice_where(3, 5, in_shell), 3);
  const AlphaComplex complex = AlphaComplex::of_squared_radius(t, 0.75);
  const BoundaryComponents parts = boundary_components(complex);
  EXPECT_THAT(parts.bodies, ElementsAre(0, 0));
  EXPECT_EQ(parts.neighbors.size(), complex.boundary().size());
  for (std::size_t f = 0; f < parts.components.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto across = static_cast<std::size_t>(parts.neighbors[3 * f + i]);
      const auto back = std::span(parts.neighbors).subspan(3 * across, 3);
      EXPECT_EQ(std::count(back.begin(), back.end(), f), 1);
      EXPECT_EQ(parts.components[f], parts.components[across]);
    }
}

TEST(AlphaShape, OptimalValues) {
  const std::vector<double> points{0, 0, 1, 0, 0, 1, 1, 1, 4, 0, 5, 0, 4, 1};
  const Delaunay<> t(points, 2);
  EXPECT_EQ(optimal_alpha_value(t, std::nullopt), 0.5);
  EXPECT_EQ(optimal_alpha_value(t, 2), 0.5);
  const double one = optimal_alpha_value(t);
  EXPECT_EQ(boundary_components(AlphaComplex::of_squared_radius(t, one)).num_components(), 1u);
  EXPECT_EQ(optimal_alpha_value(t, 1, {.threads = 3}), one);
  EXPECT_EQ(one, 2.5);  // the rectangle between them
  EXPECT_EQ(optimal_alpha_value(Regular<>(std::vector<double>{1, 2}, std::vector<double>{4}, 2)), -4);
}

TEST(AlphaShape, FewPointsAndErrors) {
  const Delaunay<2> none;
  EXPECT_THAT(polygons(AlphaComplex(none, 1)).rows, IsEmpty());
  EXPECT_EQ(polygons(AlphaComplex(none, 1)).size(), 0u);
  EXPECT_EQ(boundary_components(AlphaComplex(none, 1)).num_components(), 0u);
  EXPECT_EQ(optimal_alpha_value(none), -std::numeric_limits<double>::infinity());
  const Delaunay<> segment(std::vector<double>{0, 0, 0, 0, 0, 2}, 3);
  EXPECT_THAT(boundary_components(AlphaComplex(segment, 1)).neighbors, ElementsAre(1, 0));
  EXPECT_EQ(test::code_of([&] { polygons(AlphaComplex(segment, 1)); }), Errc::unsupported);
  EXPECT_EQ(test::code_of([&] { optimal_alpha_value(segment, 0); }), Errc::invalid_argument);
  const FurthestSite<2> furthest(std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {0, 1}});
  EXPECT_EQ(test::code_of([&] { optimal_alpha_value(furthest); }), Errc::unsupported);
}

}  // namespace
}  // namespace delone
