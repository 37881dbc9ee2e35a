// SPDX-License-Identifier: BSD-3-Clause
// An insertion that runs out of memory changes nothing, and leaves no star that a later one could start from.
#include "engine/build.hpp"
#include "engine/seed.hpp"
#include "geometry/delaunay_geometry.hpp"

#include <gtest/gtest.h>

#include <new>
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
  void perturbed_sides(std::span<const Index* const> tied, const Query& q, Sign* sides, StageCounts& counts) const {
    if (fails_at_ties) throw std::bad_alloc();
    DelaunayGeometry::perturbed_sides(tied, q, sides, counts);
  }
  bool fails = false, fails_at_ties = false;
};

TEST(Insert, ThatFailsLeavesNoStarAndNoMarks) {
  const std::vector<double> points{0, 0, 0, 0, 8, 0, 0, 8, 2, 2, 3, 3, 0, 6};  // that of vertex 0 is a dummy
  kernel::Grid grid(2);
  for (std::size_t i = 2; i < points.size(); i += 2) grid.include(points.data() + i);
  CellMemory<2> memory(2);
  CellStore<2> cells(memory);
  FailingGeometry geometry(memory, std::vector<int>{0, 1}, 2, points, grid, geometry::Frame({0, 0}, {8, 8}));
  geometry.set_rows(6);
  seed(cells, geometry, std::vector<Index>{1, 2, 3});
  Workspace work;
  Effort effort;
  const auto insert_from = [&](Index start, Index v) {
    return insert(cells, geometry, v, geometry.make_query(geometry.point(v)), start, work, effort);
  };
  ASSERT_EQ(insert_from(0, 4), 4u);
  ASSERT_FALSE(work.star().empty());
  const Index start = work.star().back().created;
  const Index before = cells.num_cells();

  const auto expect_nothing_has_changed = [&] {
    EXPECT_TRUE(work.star().empty());
    EXPECT_EQ(cells.num_cells(), before);
    for (Index cell = 0; cell < cells.num_slots(); ++cell)
      EXPECT_TRUE(cells.is_vacant(cell) || cells.mark(cell) == Mark::unseen);
  };
  geometry.fails = true;
  EXPECT_THROW(insert_from(start, 5), std::bad_alloc);
  expect_nothing_has_changed();
  geometry.fails = false;
  geometry.fails_at_ties = true;  // 6 is on the circle of 2, 3 and 4
  EXPECT_THROW(insert_from(start, 6), std::bad_alloc);
  expect_nothing_has_changed();

  geometry.fails_at_ties = false;
  EXPECT_EQ(insert_from(start, 5), 5u);
  EXPECT_EQ(cells.num_cells(), before + 2);
  EXPECT_EQ(insert_from(start, 6), 6u);
}

}  // namespace
}  // namespace delone::engine
