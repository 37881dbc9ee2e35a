// SPDX-License-Identifier: BSD-3-Clause
// The arrays of cells: slots are reused, and ids never wrap.
#include "engine/cell_store.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <utility>

namespace delone::engine {

using cells::VertexIds;

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

/// What a test writes to cells: nothing of one is in its neighbors.
Index test_vertex(Index cell, int i) {
  return cells::last_narrow_vertex - 10 * (cell % 6000) - static_cast<Index>(i);
}
template <int K>
void fill(CellMemory<K>& memory, CellStore<K>& cells, Index cell) {
  for (int i = 0; i <= K; ++i) {
    memory.records().functional(cell)[i] = 100 * cell + i;
    cells.set_vertex(cell, i, test_vertex(cell, i));
    cells.neighbors(cell)[i] = 1'000'000'000 + 10 * cell + static_cast<Index>(i);
  }
  *memory.records().certificate(cell) = -1.0 * cell;
}
template <int K>
void expect_filled(CellMemory<K>& memory, CellStore<K>& cells, Index cell) {
  Index room[K + 1];
  const auto vertices = cells.vertices(cell);
  const Index *const some = vertices, *const same = cells.vertices(cell, room);
  for (int i = 0; i <= K; ++i) {
    ASSERT_EQ(memory.records().functional(cell)[i], 100 * cell + i) << "cell " << cell;
    const Index vertex = test_vertex(cell, i);
    ASSERT_EQ(cells.vertex(cell, i), vertex) << "cell " << cell;
    ASSERT_EQ(some[i], vertex);
    ASSERT_EQ(same[i], vertex);
    ASSERT_EQ(cells.slot_of_vertex(cell, vertex), i);
    ASSERT_EQ(cells.neighbors(cell)[i], 1'000'000'000 + 10 * cell + static_cast<Index>(i));
  }
  ASSERT_EQ(*memory.records().certificate(cell), -1.0 * cell);
}

template <int K>
void expect_widening_keeps_all() {
  for (const Index count : {1, 2, 9, 30'000}) {  // from the heap, and from pages
    SCOPED_TRACE(testing::Message() << "dimension " << K << ", " << count << " cells");
    CellMemory<K> memory(K, VertexIds::narrow);
    CellStore<K> cells(memory);
    cells.reserve(count);
    cells.reserve_vacancies(count);
    for (Index i = 0; i < count; ++i) fill(memory, cells, cells.allocate());
    for (Index cell = 3; cell < count; cell += 7) cells.release(cell);
    const auto expect_all = [&] {
      for (Index cell = 0; cell < count; ++cell) {
        ASSERT_EQ(cells.is_vacant(cell), cell % 7 == 3) << "cell " << cell;
        if (cells.is_vacant(cell)) continue;
        ASSERT_NO_FATAL_FAILURE(expect_filled(memory, cells, cell));
      }
    };
    expect_all();
    cells.admit_vertices(cells::last_narrow_vertex);
    ASSERT_EQ(memory.layout().is_narrow(), cells::may_be_narrow(K));
    CellMemory<K> other_memory(K);
    CellStore<K> other(other_memory);
    other_memory.copy(memory, cells.num_slots());
    other.copy_slots(cells);
    cells.admit_vertices(cells::last_narrow_vertex + 1);
    ASSERT_FALSE(memory.layout().is_narrow());
    expect_all();
    ASSERT_EQ(other_memory.layout().is_narrow(), cells::may_be_narrow(K));
    if (count > 1) expect_filled(other_memory, other, 1);
    other.widen_vertices();
    if (count > 1) expect_filled(other_memory, other, 1);
    cells.set_vertex(0, 1, cells::last_narrow_vertex + 1);
    EXPECT_EQ(cells.vertex(0, 1), cells::last_narrow_vertex + 1);
    cells.reserve(10);
    for (Index i = 0; i < 10; ++i) fill(memory, cells, cells.allocate());
    for (Index cell = 1; cell < cells.num_slots(); ++cell) {
      if (cells.is_vacant(cell)) continue;
      ASSERT_NO_FATAL_FAILURE(expect_filled(memory, cells, cell));
    }
  }
}

TEST(CellStore, VerticesThatAreMadeWideStayTheSame) {
  expect_widening_keeps_all<4>();  // wide from the first
  expect_widening_keeps_all<5>();
  expect_widening_keeps_all<6>();
}

TEST(CellStore, GivesBackTheMemoryOfSlotsThatAreNoMore) {
  constexpr Index kept = 100, most = 60'000;
  CellMemory<7> memory(7);
  CellStore<7> cells(memory);
  const auto grow = [&](Index count) {
    cells.reserve(count);
    cells.reserve_vacancies(count);
    for (Index i = 0; i < count; ++i) fill(memory, cells, cells.allocate());
  };
  for (int round = 0; round < 2; ++round) {
    grow(most);
    const std::size_t bytes = cells.bytes();
    cells.restore_slots(kept, [](Index cell) { return cell % 7 != 3; });
    EXPECT_LT(cells.bytes(), bytes / 2);
    EXPECT_EQ(cells.num_vacant(), 14u);
    for (Index cell = 0; cell < kept; ++cell)
      if (!cells.is_vacant(cell)) {
        ASSERT_NO_FATAL_FAILURE(expect_filled(memory, cells, cell));
      }
  }
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
      for (std::size_t i = 0; i < n; ++i)
        memory.records().functional(cell)[i] = static_cast<double>(100 * cell + i);
      *memory.records().certificate(cell) = -1.0 * cell;
    }
    const auto expect_all = [&](const CellMemory<0>& of) {
      for (Index cell = 0; cell < count; ++cell) {
        for (Index i = 0; i < 2 * n; ++i) ASSERT_EQ(of.links(cell)[i], 100 * cell + i);
        for (std::size_t i = 0; i < n; ++i)
          ASSERT_EQ(of.records().functional(cell)[i], static_cast<double>(100 * cell + i));
        ASSERT_EQ(*of.records().certificate(cell), -1.0 * cell);
      }
    };
    expect_all(memory);
    memory.reserve(100'000);  // from the heap to pages
    EXPECT_GE(memory.capacity(), 100'000u);
    EXPECT_GE(memory.link_capacity(), 100'000u);
    memory.prepare(100'000);
    expect_all(memory);
    memory.shrink(count);
    EXPECT_EQ(memory.capacity(), count);
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
  EXPECT_EQ(CellLayout<4>(4, VertexIds::narrow).bytes(), 88u);
  EXPECT_EQ(CellLayout<5>(5, VertexIds::narrow).bytes(), 96u);
  EXPECT_EQ(CellLayout<6>(6, VertexIds::narrow).bytes(), 112u);
  EXPECT_EQ(CellLayout<7>(7).link_stride(), 16u);
  EXPECT_EQ(CellLayout<7>(7).bytes(), 136u);
}

TEST(CellStore, MarksLiveBesideTheCertificate) {
  CellMemory<3> memory(3);
  CellStore<3> cells(memory);
  cells.reserve(2);
  const Index cell = cells.allocate(), other = cells.allocate();
  const double certificate = std::bit_cast<double>(~cells::mark_bits::all);
  *memory.records().certificate(cell) = *memory.records().certificate(other) = certificate;
  auto marks = cells.marks();
  for (const Mark mark : {Mark::in_conflict, Mark::not_in_conflict, Mark::unseen}) {
    marks.set(cell, mark);
    EXPECT_EQ(marks(cell), mark);
    EXPECT_EQ(marks(other), Mark::unseen);
  }
  EXPECT_EQ(std::bit_cast<std::uint64_t>(*memory.records().certificate(cell)), ~cells::mark_bits::all);
  marks.set_if(cell, false);
  EXPECT_EQ(marks(cell), Mark::unseen);
  marks.set_if(cell, true);
  EXPECT_EQ(marks(cell), Mark::in_conflict);
  EXPECT_EQ(cells.mark(cell), Mark::in_conflict);
}

}  // namespace
}  // namespace delone::engine
