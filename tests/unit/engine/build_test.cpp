// SPDX-License-Identifier: BSD-3-Clause
// An insertion that runs out of memory changes nothing, and leaves no star that a later one could start from.
// A star takes the places of the cells that it replaces.
#include "engine/build.hpp"
#include "geometry/delaunay_geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <new>
#include <set>
#include <span>
#include <vector>

namespace delone::engine {
namespace {

struct FailingGeometry : geometry::DelaunayGeometry<2> {
  using DelaunayGeometry::DelaunayGeometry;
  void reserve_star(Index v, std::size_t facets) {
    if (fails) throw std::bad_alloc();
    DelaunayGeometry::reserve_star(v, facets);
  }
  void perturbed_sides(std::span<const Index* const> tied, const Query& q, Sign* sides,
                       StageCounts& counts) const {
    if (fails_at_ties) throw std::bad_alloc();
    DelaunayGeometry::perturbed_sides(tied, q, sides, counts);
  }
  bool fails = false, fails_at_ties = false;
};

TEST(Insert, ThatFailsLeavesNoStarAndNoMarks) {
  const std::vector<double> points{0, 0, 0, 0, 8, 0, 0, 8, 2, 2, 3, 3, 0, 6};  // that of vertex 0 is a dummy
  kernel::Grid grid(2);
  for (std::size_t i = 2; i < points.size(); i += 2) grid.include(points.data() + i);
  Build<2, FailingGeometry> build(2, cells::VertexIds::wide, std::vector<int>{0, 1}, 2, points, grid,
                                  geometry::Frame({0, 0}, {8, 8}));
  FailingGeometry& geometry = build.geometry();
  geometry.set_rows(6);
  build.seed(std::vector<Index>{1, 2, 3});
  ASSERT_EQ(build.insert(4, 0), 4u);
  ASSERT_FALSE(build.star().empty());
  const Index start = build.star().back().created;
  const Index before = build.cells().num_cells();

  const auto expect_nothing_has_changed = [&] {
    EXPECT_TRUE(build.star().empty());
    EXPECT_EQ(build.cells().num_cells(), before);
    for (Index cell = 0; cell < build.cells().num_slots(); ++cell)
      EXPECT_TRUE(build.cells().is_vacant(cell) || build.cells().mark(cell) == Mark::unseen);
  };
  geometry.fails = true;
  EXPECT_THROW(build.insert(5, start), std::bad_alloc);
  expect_nothing_has_changed();
  geometry.fails = false;
  geometry.fails_at_ties = true;  // 6 is on the circle of 2, 3 and 4
  EXPECT_THROW(build.insert(6, start), std::bad_alloc);
  expect_nothing_has_changed();

  geometry.fails_at_ties = false;
  EXPECT_EQ(build.insert(5, start), 5u);
  EXPECT_EQ(build.cells().num_cells(), before + 2);
  EXPECT_EQ(build.insert(6, start), 6u);
}

/// Inserts the points of a grid in an order that is none; on a grid, horizons are not found in the order of
/// the zone.
TEST(Insert, PutsCellsWhereThoseWereThatTheyAreMadeFrom) {
  constexpr Index side = 5, num_points = side * side * side;
  std::vector<double> points{0, 0, 0};  // that of vertex 0 is a dummy
  for (const Index i : {0u, side - 1, side * (side - 1), side * side * (side - 1)})  // a simplex first
    for (const Index x : {i % side, i / side % side, i / side / side}) points.push_back(x);
  for (Index j = 0; j < num_points; ++j) {
    const Index i = j * 47 % num_points;
    if (i == 0 || i == side - 1 || i == side * (side - 1) || i == side * side * (side - 1)) continue;
    for (const Index x : {i % side, i / side % side, i / side / side}) points.push_back(x);
  }
  kernel::Grid grid(3);
  for (std::size_t i = 3; i < points.size(); i += 3) grid.include(points.data() + i);
  const double last = side - 1;
  Build<3, geometry::DelaunayGeometry<3>> build(3, cells::VertexIds::wide, std::vector<int>{0, 1, 2}, 3,
                                                points, grid, geometry::Frame({0, 0, 0}, {last, last, last}));
  CellStore<3>& cells = build.cells();
  auto& geometry = build.geometry();
  const Workspace& work = build.workspace();
  geometry.set_rows(num_points);
  std::vector<Index> simplex{1, 2, 3, 4};
  if (geometry.orientation(simplex.data()) == Sign::negative) std::swap(simplex[0], simplex[1]);
  build.seed(simplex);
  for (Index v = 5; v <= num_points; ++v) {
    std::set<Index> before;
    for (Index cell = 0; cell < cells.num_slots(); ++cell)
      if (!cells.is_vacant(cell)) before.insert(cell);
    const Index slots = cells.num_slots(), vacant = slots - cells.num_cells();
    ASSERT_EQ(build.insert(v), v);

    const std::set<Index> dead(work.zone.cells.data(), work.zone.cells.data() + work.zone.num_cells);
    std::set<Index> created;
    std::map<Index, Index> made_last;  // by dead cell
    for (const HorizonFacet& facet : work.star()) {
      EXPECT_TRUE(created.insert(facet.created).second);
      EXPECT_TRUE(dead.contains(facet.created) || !before.contains(facet.created));
      EXPECT_EQ(cells.mark(facet.created), Mark::unseen);
      made_last[facet.dead] = facet.created;
    }
    for (const auto& [from, cell] : made_last) EXPECT_EQ(cell, from);
    const auto num_dead = static_cast<Index>(dead.size()), num_created = static_cast<Index>(created.size());
    EXPECT_EQ(cells.num_cells(), slots - vacant - num_dead + num_created);
    EXPECT_EQ(cells.num_slots(), std::max(slots, slots - vacant - num_dead + num_created));
    for (Index cell = 0; cell < cells.num_slots(); ++cell)
      EXPECT_EQ(cells.is_vacant(cell),
                !created.contains(cell) && (!before.contains(cell) || dead.contains(cell)));
  }
}

}  // namespace
}  // namespace delone::engine
