// SPDX-License-Identifier: BSD-3-Clause
// The arrays of cells: slots are reused, memory grows without losing entries, and ids never wrap.
#include "engine/cell_store.hpp"
#include "growable_array.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <utility>

namespace delone::engine {
namespace {

TEST(CellStore, ReusesReleasedSlots) {
  CellMemory<2> memory(2);
  CellStore<2> cells(memory);
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
  CellMemory<2> memory(2);
  CellStore<2> cells(memory);
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
  CellMemory<0> memory(5);
  CellStore<0> cells(memory);
  const auto expect_same = [](const auto& layout) {
    const CellLayout<0> at_run_time(layout.dimension());
    EXPECT_EQ(at_run_time.functional_stride(), layout.functional_stride());
    EXPECT_EQ(at_run_time.certificates_are_apart(), layout.certificates_are_apart());
    EXPECT_EQ(at_run_time.links_are_apart(), layout.links_are_apart());
    EXPECT_EQ(at_run_time.link_stride(), layout.link_stride());
    EXPECT_EQ(at_run_time.words_before_links(), layout.words_before_links());
  };
  expect_same(CellLayout<2>(2));
  expect_same(CellLayout<3>(3));
  expect_same(CellLayout<5>(5));
  expect_same(CellLayout<7>(7));
  expect_same(CellLayout<8>(8));
  cells.reserve(2);
  const Index cell = cells.allocate();
  EXPECT_EQ(cells.neighbors(cell) - cells.vertices(cell), 6);
}

TEST(CellMemory, PartsOfCellsAreApartFromThoseOfOthersAndStayAsMemoryGrowsAndIsCopied) {
  for (int k = 1; k <= 10; ++k) {
    SCOPED_TRACE(testing::Message() << "dimension " << k);
    CellMemory<0> memory(k);
    const auto n = static_cast<std::size_t>(k) + 1;
    constexpr Index count = 9;
    // With links alone first, as wrapping does.
    memory.reserve_links(count);
    for (Index cell = 0; cell < count; ++cell)
      for (Index i = 0; i < 2 * n; ++i) memory.links(cell)[i] = 100 * cell + i;
    memory.reserve(count);
    for (Index cell = 0; cell < count; ++cell) {
      for (std::size_t i = 0; i < n; ++i) memory.records().functional(cell)[i] = static_cast<double>(100 * cell + i);
      *memory.records().certificate(cell) = -1.0 * cell;
    }
    const auto expect_all = [&](const CellMemory<0>& of) {
      for (Index cell = 0; cell < count; ++cell) {
        for (Index i = 0; i < 2 * n; ++i) ASSERT_EQ(of.links(cell)[i], 100 * cell + i);
        for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(of.records().functional(cell)[i], static_cast<double>(100 * cell + i));
        ASSERT_EQ(*of.records().certificate(cell), -1.0 * cell);
      }
    };
    expect_all(memory);
    memory.reserve(100'000);  // from the heap to pages
    EXPECT_GE(memory.capacity(), 100'000u);
    EXPECT_GE(memory.link_capacity(), 100'000u);
    memory.prepare(100'000);
    expect_all(memory);
    CellMemory<0> other(k);
    other.copy(memory, count);
    expect_all(other);
  }
}

TEST(CellMemory, FillsLinesOfTheCacheWhereItCan) {
  EXPECT_EQ(CellLayout<2>(2).bytes(), 64u);
  EXPECT_EQ(CellLayout<3>(3).functional_stride(), 8u);
  EXPECT_EQ(CellLayout<3>(3).bytes(), 72u);
  EXPECT_EQ(CellLayout<4>(4).bytes(), 88u);
  EXPECT_EQ(CellLayout<5>(5).bytes(), 104u);
  EXPECT_EQ(CellLayout<6>(6).bytes(), 128u);
  EXPECT_EQ(CellLayout<7>(7).link_stride(), 16u);
  EXPECT_EQ(CellLayout<7>(7).bytes(), 136u);
}

TEST(CellStore, MarksLiveBesideTheCertificate) {
  CellMemory<3> memory(3);
  CellStore<3> cells(memory);
  cells.reserve(2);
  const Index cell = cells.allocate(), other = cells.allocate();
  const double certificate = std::bit_cast<double>(~mark_bits::all);
  *memory.records().certificate(cell) = *memory.records().certificate(other) = certificate;
  auto marks = cells.marks();
  for (const Mark mark : {Mark::in_conflict, Mark::not_in_conflict, Mark::unseen}) {
    marks.set(cell, mark);
    EXPECT_EQ(marks(cell), mark);
    EXPECT_EQ(marks(other), Mark::unseen);
  }
  EXPECT_EQ(std::bit_cast<std::uint64_t>(*memory.records().certificate(cell)), ~mark_bits::all);
  marks.set_if(cell, false);
  EXPECT_EQ(marks(cell), Mark::unseen);
  marks.set_if(cell, true);
  EXPECT_EQ(marks(cell), Mark::in_conflict);
  EXPECT_EQ(cells.mark(cell), Mark::in_conflict);
}

TEST(PriceOfLargePages, FewDearPagesAmongManyAreAccepted) {
  PriceOfLargePages price;
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(price.pay(i % 10 == 0 ? 3e-3 : 0.1e-3, 1, 0)) << i;
  EXPECT_TRUE(price.pay(50e-3, 100, 0));  // a long time, but for many
}

TEST(PriceOfLargePages, DearPagesAreSoonTooMuchForAll) {
  PriceOfLargePages price;
  int accepted = 0;
  while (price.pay(2e-3, 1, -100)) ++accepted;
  EXPECT_EQ(accepted, 2);
  EXPECT_FALSE(PriceOfLargePages::are_worth_trying(-99.5));
  EXPECT_TRUE(PriceOfLargePages::are_worth_trying(-98));
}

TEST(GrowableArray, KeepsEntriesAcrossHeapAndMappedMemory) {
  for (const auto& [is_prepared, pages] : {std::pair{false, Pages::usual}, {true, Pages::usual}, {true, Pages::large}}) {
    GrowableArray<Index> array(pages);
    std::size_t filled = 0;
    for (std::size_t size = 10; size < 20'000'000; size = size * 5 / 2) {
      array.reserve(size);
      ASSERT_GE(array.capacity(), size);
      for (; filled < size; filled += 7) {
        if (is_prepared) array.prepare(filled + 1);
        array[filled] = static_cast<Index>(filled);
      }
      if (is_prepared) array.prepare(array.capacity());
      for (std::size_t i = 0; i < filled; i += 7) ASSERT_EQ(array[i], i);
    }
    GrowableArray<Index> moved = std::move(array);
    EXPECT_EQ(array.capacity(), 0u);
    EXPECT_EQ(moved[7], 7u);
    array = std::move(moved);
    array.prepare(array.capacity());
    EXPECT_EQ(array[7], 7u);
  }
}

TEST(GrowableArray, DiscardsNothingBesides) {
  for (const std::size_t size : {std::size_t{1000}, std::size_t{1'000'000}}) {
    GrowableArray<Index> array;
    array.reserve(size);
    for (std::size_t i = 0; i < size; ++i) array[i] = static_cast<Index>(i);
    array.discard(0, 0);
    array.discard(size / 10 + 1, size / 2 + 1);
    array.discard(size / 2 + 1, size / 2 + 3);
    for (std::size_t i = 0; i < size; ++i)
      if (i <= size / 10 || i >= size / 2 + 3) {
        ASSERT_EQ(array[i], i);
      }
    array[size / 4] = 7;  // may be written again
    EXPECT_EQ(array[size / 4], 7u);
  }
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
