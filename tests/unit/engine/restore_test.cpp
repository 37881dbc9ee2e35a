// SPDX-License-Identifier: BSD-3-Clause
// Cells from a complex of the same vertices: with the same ids if that has no vacant slots, else moved
// together.
#include "engine/restore.hpp"
#include "engine_support.hpp"

namespace delone::engine {
namespace {

TEST(Restore, KeepsIdsIfNoSlotIsVacant) {
  const std::vector<double> rows{0, 0, 8, 0, 0, 8, 8, 8, 2, 3, 5, 4, 3, 6, 9, 1};
  Points<2> old(rows, 2, -10, 10), restored(rows, 2, -10, 10);
  old.seed();
  for (Index v = 4; v <= 7; ++v) ASSERT_EQ(old.build.insert(v), v);
  ASSERT_EQ(old.build.cells().num_slots(), old.build.cells().num_cells());
  restored.build.restore(old.complex(7));
  ASSERT_EQ(restored.build.cells().num_slots(), old.build.cells().num_slots());
  for (Index cell = 0; cell < old.build.cells().num_slots(); ++cell) {
    EXPECT_EQ(restored.corners(cell), old.corners(cell));
    EXPECT_TRUE(std::equal(old.build.cells().neighbors(cell), old.build.cells().neighbors(cell) + 3,
                           restored.build.cells().neighbors(cell)));
    EXPECT_EQ(restored.build.cells().mark(cell), Mark::unseen);
  }
  EXPECT_EQ(restored.sphere(), old.sphere());
  EXPECT_EQ(restored.build.num_infinite(), old.build.num_infinite());
  EXPECT_TRUE(restored.build.star().empty());
  EXPECT_EQ(restored.build.insert(8), old.build.insert(8));
  EXPECT_EQ(restored.sphere(), old.sphere());
}

TEST(Restore, LeavesOutVacantSlotsAndVerticesWithoutCells) {
  // Vertex 7 takes all cells of 5 and 6.
  const std::vector<double> rows{0, 0, 0, 8, 0, 0, 0, 8, 0, 9, 9, 0, 3, 3, 0, 4, 5, 0, 4, 4, 20, 6, 1, 15};
  Points<2> old(rows, 2, -20, 20, true), restored(rows, 2, -20, 20, true);
  old.seed();
  for (Index v = 4; v <= 7; ++v) ASSERT_EQ(old.build.insert(v), v);
  ASSERT_GT(old.build.cells().num_slots(), old.build.cells().num_cells());
  for (const std::vector<Index>& cell : old.sphere())
    EXPECT_TRUE(std::none_of(cell.begin(), cell.end(), [](Index v) { return v == 5 || v == 6; }));
  restored.build.restore(old.complex(7));
  EXPECT_EQ(restored.build.cells().num_slots(), old.build.cells().num_cells());
  EXPECT_EQ(restored.sphere(), old.sphere());
  EXPECT_EQ(restored.build.insert(8), 8u);
  EXPECT_EQ(old.build.insert(8), 8u);
  EXPECT_EQ(restored.sphere(), old.sphere());
}

}  // namespace
}  // namespace delone::engine
