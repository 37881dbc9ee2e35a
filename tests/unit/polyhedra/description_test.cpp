// SPDX-License-Identifier: BSD-3-Clause
// Descriptions from either side are the same, as are those of their own minimal rows; and which sets include
// which.
#include "polyhedra/description.hpp"

#include "cone_support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace delone::polyhedra {
namespace {

using ::testing::ElementsAre;

void expect_equal(const Description& a, const Description& b) {
  EXPECT_EQ(a.facets, b.facets);
  EXPECT_EQ(a.equations, b.equations);
  EXPECT_EQ(a.generators, b.generators);
  EXPECT_EQ(a.lines, b.lines);
  EXPECT_EQ(a.num_vertices, b.num_vertices);
  EXPECT_TRUE(a.incidence == b.incidence);
}

/// The triangle (0, 0), (2, 0), (0, 2) of the plane.
Description triangle() { return from_generators({{0, 0, 1}, {2, 0, 1}, {0, 2, 1}}, {}, 2); }

TEST(Description, BothWaysAndFromMinimalRowsAreTheSame) {
  random::Generator generator(3);
  for (int run = 0; run < 60; ++run) {
    const std::size_t d = 1 + static_cast<std::size_t>(run) % 4;
    Rows generators = random_rows(generator, 3 + static_cast<std::size_t>(run) % 7, d + 1, 4);
    for (Row& row : generators) row.back() = boost::multiprecision::abs(row.back());
    Rows lines;
    if (run % 5 == 0) {
      lines = random_rows(generator, 1, d + 1, 2);
      lines[0].back() = 0;
    }
    const Description made = from_generators(generators, lines, d);
    expect_equal(from_inequalities(made.facets, made.equations, d), made);
    expect_equal(from_generators(made.generators, made.lines, d), made);
    Rows facets = made.facets, vertices = made.generators;
    std::reverse(facets.begin(), facets.end());
    std::reverse(vertices.begin(), vertices.end());
    expect_equal(from_minimal_rows(facets, made.equations, vertices, made.lines, d), made);
  }
}

TEST(Description, PointsAtInfinityAloneAreNoFacet) {
  std::vector<RowKind> kinds;
  // x ≥ 0 and y ≥ 0, x + 1 ≥ 0, 0 ≥ 0, x ≥ 0 again.
  const Description quadrant =
      from_inequalities({{1, 0, 0}, {0, 1, 0}, {1, 0, 1}, {0, 0, 0}, {3, 0, 0}}, {}, 2, &kinds);
  EXPECT_THAT(kinds, ElementsAre(RowKind::essential, RowKind::essential, RowKind::redundant,
                                 RowKind::redundant, RowKind::duplicate));
  EXPECT_EQ(quadrant.num_vertices, 1u);
  EXPECT_EQ(quadrant.num_rays(), 2u);
  EXPECT_EQ(quadrant.facets.size(), 2u);
  EXPECT_EQ(quadrant.affine_dimension(), 2);
}

TEST(Description, RaysWithoutAPointHaveTheOrigin) {
  std::vector<RowKind> kinds;
  const Description cone = from_generators({{1, 0, 0}, {2, 0, 0}, {-1, 0, 0}}, {{0, 1, 0}}, 2, &kinds);
  EXPECT_THAT(kinds, ElementsAre(RowKind::implicit, RowKind::implicit, RowKind::implicit));
  EXPECT_EQ(cone.lines.size(), 2u);
  EXPECT_EQ(cone.generators, (Rows{{0, 0, 1}}));
}

TEST(Description, EmptySetsHaveOne) {
  std::vector<RowKind> kinds;
  const Description contradiction = from_inequalities({{1, -1}, {-1, 0}}, {}, 1, &kinds);  // x ≥ 1, x ≤ 0
  EXPECT_TRUE(contradiction.is_empty());
  EXPECT_EQ(contradiction.affine_dimension(), -1);
  EXPECT_THAT(kinds, ElementsAre(RowKind::redundant, RowKind::redundant));
  expect_equal(contradiction, from_generators({}, {}, 1, &kinds));
  EXPECT_TRUE(kinds.empty());
}

TEST(Description, IncludesWhatItsFacetsAndEquationsAdmit) {
  const Description whole = triangle(), edge = from_generators({{0, 0, 1}, {2, 0, 1}}, {}, 2),
                    beyond = from_generators({{0, 0, 1}, {3, 0, 1}}, {}, 2),
                    above = from_generators({{0, 0, 1}, {1, 1, 2}}, {}, 2),
                    empty = from_generators({}, {}, 2), ray = from_generators({{0, 0, 1}, {1, 0, 0}}, {}, 2),
                    line = from_generators({{0, 0, 1}}, {{1, 0, 0}}, 2), plane = from_inequalities({}, {}, 2),
                    strip = from_inequalities({{0, 1, 0}}, {}, 2);
  EXPECT_TRUE(includes(whole, edge));
  EXPECT_FALSE(includes(edge, whole)) << "off its line";
  EXPECT_FALSE(includes(whole, beyond));
  EXPECT_TRUE(includes(whole, above)) << "(1/2, 1/2)";
  EXPECT_FALSE(includes(edge, above));
  EXPECT_TRUE(includes(whole, empty) && includes(empty, empty));
  EXPECT_FALSE(includes(empty, edge));
  EXPECT_FALSE(includes(whole, ray));
  EXPECT_TRUE(includes(line, ray) && includes(plane, line) && includes(strip, line));
  EXPECT_FALSE(includes(ray, line)) << "a facet does not contain it";
  EXPECT_FALSE(includes(edge, line));
  EXPECT_FALSE(includes(strip, from_generators({{0, 0, 1}}, {{0, 1, 0}}, 2)));
  EXPECT_FALSE(includes(line, from_generators({{0, 0, 1}}, {{1, 1, 0}}, 2))) << "an equation tells";
}

}  // namespace
}  // namespace delone::polyhedra
