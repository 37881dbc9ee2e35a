// SPDX-License-Identifier: BSD-3-Clause
// The arrays of cells: slots are reused, memory grows without losing entries, and ids never wrap.
#include "engine/cell_store.hpp"
#include "growable_array.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace delone::engine {
namespace {

TEST(CellStore, ReusesReleasedSlots) {
  CellStore<2> cells(2);
  cells.reserve(3);
  EXPECT_EQ(cells.allocate(), 0u);
  EXPECT_EQ(cells.allocate(), 1u);
  cells.release(0);
  EXPECT_TRUE(cells.is_vacant(0));
  EXPECT_EQ(cells.num_cells(), 1u);
  EXPECT_EQ(cells.allocate(), 0u);
  EXPECT_EQ(cells.allocate(), 2u);
  EXPECT_EQ(cells.num_slots(), 3u);
}

TEST(CellStore, ExhaustedIdsAreAnErrorBeforeAnythingIsAllocated) {
  CellStore<2> cells(2);
  cells.reserve(1);
  cells.allocate();
  try {
    cells.reserve(static_cast<std::size_t>(max_index));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::too_many);
  }
  EXPECT_EQ(cells.num_slots(), 1u);
  EXPECT_LT(cells.bytes(), 10000u);
}

TEST(CellStore, DimensionsAtRunTimeHaveTheSameLayout) {
  CellStore<0> cells(5);
  EXPECT_EQ(cells.stride(), CellStore<5>(5).stride());
  cells.reserve(2);
  const Index cell = cells.allocate();
  EXPECT_EQ(cells.neighbors(cell) - cells.vertices(cell), 6);
}

TEST(GrowableArray, KeepsEntriesAcrossHeapAndMappedMemory) {
  GrowableArray<Index> array;
  std::size_t filled = 0;
  for (std::size_t size = 10; size < 20'000'000; size = size * 5 / 2) {
    array.reserve(size);
    ASSERT_GE(array.capacity(), size);
    for (; filled < size; filled += 7) array[filled] = static_cast<Index>(filled);
    for (std::size_t i = 0; i < filled; i += 7) ASSERT_EQ(array[i], i);
  }
  GrowableArray<Index> moved = std::move(array);
  EXPECT_EQ(array.capacity(), 0u);
  EXPECT_EQ(moved[7], 7u);
  array = std::move(moved);
  EXPECT_EQ(array[7], 7u);
}

TEST(GrowableArray, AsksForNoImpossibleMemory) {
  GrowableArray<double> array;
  array.reserve(100);
  array[99] = 1;
  EXPECT_THROW(array.reserve(static_cast<std::size_t>(-1) / 2), std::bad_alloc);
  EXPECT_THROW(array.reserve(std::size_t{1} << 50), std::bad_alloc);
  EXPECT_EQ(array[99], 1);
}

}  // namespace
}  // namespace delone::engine
