// SPDX-License-Identifier: BSD-3-Clause
// check() of damaged hulls: every level must be seen to fail, naming the right rows.
#include <delone/check.hpp>

#include "small_results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace delone {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

template <class Damage>
CheckReport damaged(Damage damage) {
  HullData data = test::small_hull();
  damage(data);
  return check(data);
}

template <class Damage>
void expect_failure(std::string_view level, const char* message, Damage damage) {
  const CheckReport report = damaged(damage);
  EXPECT_FALSE(report.ok) << message;
  EXPECT_EQ(report.reached.name, level) << report.violation;
  EXPECT_THAT(report.violation, HasSubstr(message));
}

TEST(CheckHull, SoundOnesPass) {
  EXPECT_TRUE(check(test::small_hull()).ok) << check(test::small_hull()).violation;
  const CheckReport report = damaged([](HullData& hull) {  // points and cells are enough
    HullData bare;
    bare.dimension = bare.affine_dimension = 2;
    bare.points = hull.points;
    bare.cells = hull.cells;
    hull = bare;
  });
  EXPECT_TRUE(report.ok) << report.violation;
}

TEST(CheckHull, Ties) {
  // The point on the first edge divides it into two cells of one facet.
  const CheckReport report = damaged([](HullData& hull) {
    hull.cells = {0, 4, 4, 1, 1, 2, 2, 0};
    hull.neighbors.clear();
    hull.facet_of_cell = {0, 0, 1, 2};
  });
  EXPECT_TRUE(report.ok) << report.violation;
  EXPECT_EQ(report.ties, 1u);
}

TEST(CheckHull, Storage) {
  expect_failure("storage", "cell 1 has the vertex 6", [](HullData& hull) { hull.cells[3] = 6; });
  expect_failure("storage", "twice", [](HullData& hull) { hull.cells[3] = 1; });
  expect_failure("storage", "cell 2 is part of facet 3", [](HullData& hull) { hull.facet_of_cell[2] = 3; });
  expect_failure("storage", "offsets", [](HullData& hull) { hull.facet_offsets[3] = 5; });
  expect_failure("storage", "fall from", [](HullData& hull) { hull.facet_offsets[1] = 5; });
  expect_failure("storage", "equations", [](HullData& hull) { hull.equations.resize(6); });
  expect_failure("storage", "point_kinds", [](HullData& hull) { hull.point_kinds.pop_back(); });
  expect_failure("storage", "ridge 0", [](HullData& hull) { hull.ridge_facets[1] = -1; });
  expect_failure("storage", "no cell", [](HullData& hull) {
    hull.cells.clear();
    hull.neighbors.clear();
    hull.facet_of_cell.clear();
  });
  expect_failure("storage", "not finite",
                 [](HullData& hull) { hull.points[3] = std::numeric_limits<double>::quiet_NaN(); });
}

TEST(CheckHull, Incidence) {
  expect_failure("incidence", "neighbor 0 of cell 0", [](HullData& hull) { hull.neighbors[0] = 2; });
  expect_failure("incidence", "open", [](HullData& hull) {
    hull.cells.resize(4);
    hull.neighbors.clear();
    hull.facet_of_cell.resize(2);
  });
  expect_failure("incidence", "coherently", [](HullData& hull) {
    std::swap(hull.cells[0], hull.cells[1]);
    std::swap(hull.neighbors[0], hull.neighbors[1]);
  });
}

TEST(CheckHull, ConvexityAndSupport) {
  expect_failure("convexity", "not oriented outwards", [](HullData& hull) {
    for (std::size_t c = 0; c < 6; c += 2) std::swap(hull.cells[c], hull.cells[c + 1]);
    hull.neighbors.clear();
  });
  expect_failure("convexity", "affine dimension", [](HullData& hull) {
    for (std::size_t row = 0; row < 6; ++row) hull.points[2 * row + 1] = 0;
  });
  const CheckReport report = damaged([](HullData& hull) {
    hull.points[6] = 5;  // the inner point leaves through the long edge
    hull.points[7] = 5;
  });
  EXPECT_EQ(report.reached.name, "support") << report.violation;
  EXPECT_THAT(report.points, Contains(3u));
  EXPECT_THAT(report.cells, Contains(1u));
}

TEST(CheckHull, Completeness) {
  expect_failure("completeness", "facet 1 has the extreme points {1, 2}",
                 [](HullData& hull) { hull.facet_vertices[2] = 0; });
  expect_failure("completeness", "hyperplane", [](HullData& hull) { hull.facet_of_cell[2] = 1; });
  expect_failure("completeness", "ridge", [](HullData& hull) { hull.ridge_facets[1] = 1; });
  expect_failure("completeness", "equation of facet 1", [](HullData& hull) { hull.equations[5] = -2; });
  expect_failure("completeness", "point 3 is in the list",
                 [](HullData& hull) { hull.vertices.push_back(3); });
  expect_failure("completeness", "point 4 is on the boundary",
                 [](HullData& hull) { hull.point_kinds[4] = PointKind::interior; });
  expect_failure("completeness", "point 5 is first in row 0",
                 [](HullData& hull) { hull.vertex_of_point[5] = 5; });
}

}  // namespace
}  // namespace delone
