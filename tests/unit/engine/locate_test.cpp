// SPDX-License-Identifier: BSD-3-Clause
// From any cell, a walk ends in one in conflict, or at the vertex at the query, or finds that it is hidden.
#include "engine/locate.hpp"
#include "engine_support.hpp"

namespace delone::engine {

namespace {

/// Vertices 1 … 9 are inserted: a square and points in it. 10 … 13 are queries: two inside, one beyond the
/// hull, one on the line of an edge of the hull.
const std::vector<double> rows{0, 0, 8, 0, 0, 8, 8, 8, 4, 4,  2, 4,  6,
                               4, 4, 2, 4, 6, 3, 5, 3, 4, 20, 3, 12, 0};
constexpr Index num_vertices = 9, num_points = 13;

class Locate : public ::testing::Test {
 protected:
  Locate() {
    points_.seed();
    for (Index v = 4; v <= num_vertices; ++v) points_.build.insert(v);
  }
  const CellStore<2>& cells() const { return points_.build.cells(); }
  const geometry::DelaunayGeometry<2>& geometry() const { return points_.build.geometry(); }
  bool in_conflict(Index cell, Index v) const {
    const auto q = geometry().query_at(v);
    StageCounts counts;
    return in_conflict_exactly(cells(), geometry(), cell, q, geometry().evaluator(q), counts);
  }

  Points<2> points_{rows, 2, -1, 21};
  StageCounts counts_;
};

TEST_F(Locate, EndsInACellInConflict) {
  for (Index v = num_vertices + 1; v <= num_points; ++v)
    for (Index start = 0; start < cells().num_slots(); ++start) {
      const auto q = geometry().query_at(v);
      const WalkResult found = locate(cells(), geometry(), q, start, counts_);
      EXPECT_FALSE(found.hidden);
      EXPECT_EQ(found.vertex, invalid_index);
      EXPECT_TRUE(in_conflict(found.cell, v)) << v << " from " << start;
      const WalkResult exact = walk_exactly(cells(), geometry(), q, start, true, counts_);
      EXPECT_TRUE(in_conflict(exact.cell, v)) << v << " from " << start;
      EXPECT_GE(exact.visited, 1u);
      EXPECT_TRUE(in_conflict(search_all(cells(), geometry(), q, counts_).cell, v));
    }
}

TEST_F(Locate, FindsTheVertexAtTheQuery) {
  for (Index v = 1; v <= num_vertices; ++v)
    for (Index start = 0; start < cells().num_slots(); ++start) {
      const WalkResult found = locate(cells(), geometry(), geometry().query_at(v), start, counts_);
      EXPECT_EQ(found.vertex, v);
      EXPECT_LT(cells().slot_of_vertex(found.cell, v), 3);
      EXPECT_EQ(cells().vertex(found.cell, cells().slot_of_vertex(found.cell, v)), v);
    }
}

TEST_F(Locate, AWalkThatDoesNotStopAtConflictsEndsAroundTheQuery) {
  for (Index start = 0; start < cells().num_slots(); ++start) {
    for (const Index inside : {10u, 11u}) {
      const auto q = geometry().query_at(inside);
      const Index cell = walk_exactly(cells(), geometry(), q, start, false, counts_).cell;
      ASSERT_LT(cells().infinite_slot(cell), 0);
      for (int slot = 0; slot <= 2; ++slot)
        EXPECT_NE(geometry().side_of_facet(cells().vertices(cell), slot, q), Sign::negative);
    }
    for (const Index outside : {12u, 13u}) {
      const auto q = geometry().query_at(outside);
      const Index cell = walk_exactly(cells(), geometry(), q, start, false, counts_).cell;
      const int slot = cells().infinite_slot(cell);
      ASSERT_GE(slot, 0);
      const Index finite = cells().neighbors(cell)[slot];
      EXPECT_EQ(geometry().side_of_facet(cells().vertices(finite), cells().slot_of_neighbor(finite, cell), q),
                Sign::negative);
    }
  }
}

TEST_F(Locate, StartsInTheStarAtACellInConflictIfThereIsOne) {
  const std::span<const HorizonFacet> star = points_.build.star();
  ASSERT_FALSE(star.empty());
  for (Index v = num_vertices + 1; v <= num_points; ++v) {
    const Index start = start_in_star(geometry(), geometry().query_at(v), star);
    const auto is_start = [&](const HorizonFacet& facet) { return facet.created == start; };
    EXPECT_TRUE(std::any_of(star.begin(), star.end(), is_start));
  }
  // 10 is next to 9, the vertex of the star.
  EXPECT_TRUE(in_conflict(start_in_star(geometry(), geometry().query_at(10), star), 10));
}

TEST(LocateWeighted, FindsWhatIsHidden) {
  // 4 is far too light; 5 is exactly on the hyperplane of the triangle, on an edge; 6 is in conflict with it.
  const std::vector<double> weighted{0, 0, 0, 8, 0, 0, 0, 8, 0, 2, 2, -100, 4, 0, -16, 2, 2, 0};
  Points<2> points(weighted, 2, -100, 100, true);
  points.seed();
  StageCounts counts;
  const auto& cells = points.build.cells();
  const auto& geometry = points.build.geometry();
  for (Index start = 0; start < cells.num_slots(); ++start) {
    const WalkResult hidden = locate(cells, geometry, geometry.query_at(4), start, counts);
    EXPECT_TRUE(hidden.hidden && hidden.strictly);
    EXPECT_EQ(hidden.vertex, invalid_index);
    EXPECT_FALSE(locate(cells, geometry, geometry.query_at(5), start, counts).strictly);
    EXPECT_FALSE(locate(cells, geometry, geometry.query_at(6), start, counts).hidden);
  }
  EXPECT_TRUE(search_all(cells, geometry, geometry.query_at(4), counts).hidden);
  EXPECT_FALSE(search_all(cells, geometry, geometry.query_at(6), counts).hidden);
  EXPECT_EQ(points.build.insert(4), invalid_index);
  EXPECT_EQ(points.build.cells().num_cells(), 4u);
}

}  // namespace
}  // namespace delone::engine
