// SPDX-License-Identifier: BSD-3-Clause
// What is written of a cell stays where it is when memory grows, when vertices become wide, and in copies.
#include "cells/cell_memory.hpp"

#include <gtest/gtest.h>

#include <bit>

namespace delone::cells {
namespace {

Index vertex_of(Index cell, int i) { return cell * 100 + static_cast<Index>(i) + 1; }
Index neighbor_of(Index cell, int i) { return cell * 1000 + static_cast<Index>(i); }

template <int K>
void write(CellMemory<K>& memory, Index first, Index last) {
  for (Index cell = first; cell < last; ++cell) {
    Index* const links = memory.links(cell);
    for (int i = 0; i <= memory.dimension(); ++i) {
      memory.layout().set_vertex(links, i, vertex_of(cell, i));
      links[memory.layout().ids_before_neighbors() + static_cast<std::size_t>(i)] = neighbor_of(cell, i);
      memory.records().functional(cell)[i] = cell + 0.5 * i;
    }
    *memory.records().certificate(cell) = std::bit_cast<double>(std::uint64_t{cell} + 7);
  }
}

template <int K>
void expect_written(const CellMemory<K>& memory, Index last) {
  for (Index cell = 0; cell < last; ++cell) {
    const Index* const links = memory.links(cell);
    for (int i = 0; i <= memory.dimension(); ++i) {
      EXPECT_EQ(memory.layout().vertex(links, i), vertex_of(cell, i));
      EXPECT_EQ(links[memory.layout().ids_before_neighbors() + static_cast<std::size_t>(i)],
                neighbor_of(cell, i));
      EXPECT_EQ(memory.records().functional(cell)[i], cell + 0.5 * i);
    }
    EXPECT_EQ(std::bit_cast<std::uint64_t>(*memory.records().certificate(cell)), cell + 7u);
  }
}

template <int K>
void expect_kept(int k, VertexIds ids) {
  SCOPED_TRACE(testing::Message() << "dimension " << k);
  CellMemory<K> memory(k, ids);
  memory.reserve(10);
  write(memory, 0, 10);
  memory.reserve(500);
  write(memory, 10, 500);
  expect_written(memory, 500);
  EXPECT_EQ(memory.layout().is_narrow(), ids == VertexIds::narrow && may_be_narrow(K));
  CellMemory<K> narrow_copy(k);
  narrow_copy.copy(memory, 500);
  memory.widen(500);
  EXPECT_FALSE(memory.layout().is_narrow());
  expect_written(memory, 500);
  expect_written(narrow_copy, 500);
  CellMemory<K> copy(k, ids);
  copy.copy(memory, 300);
  expect_written(copy, 300);
}

TEST(CellMemory, KeepsWhatIsWritten) {
  for (const VertexIds ids : {VertexIds::wide, VertexIds::narrow}) {
    expect_kept<1>(1, ids);
    expect_kept<2>(2, ids);
    expect_kept<3>(3, ids);  // certificates apart
    expect_kept<5>(5, ids);  // narrow vertices
    expect_kept<6>(6, ids);
    expect_kept<7>(7, ids);  // links apart
    expect_kept<0>(9, ids);
  }
}

TEST(CellMemory, CopiesLinksWhereThatIsAllThereIs) {
  CellMemory<7> memory(7);
  memory.reserve_links(50);
  for (Index cell = 0; cell < 50; ++cell) memory.layout().set_vertex(memory.links(cell), 3, cell);
  CellMemory<7> copy(7);
  copy.copy(memory, 50);
  EXPECT_EQ(copy.capacity(), 0u);
  for (Index cell = 0; cell < 50; ++cell) EXPECT_EQ(copy.layout().vertex(copy.links(cell), 3), cell);
}

TEST(MarkBits, LeaveAllOthersAlone) {
  for (const Mark mark : {Mark::unseen, Mark::in_conflict, Mark::not_in_conflict}) {
    EXPECT_EQ(mark_bits::read(mark_bits::write(mark)), mark);
    EXPECT_EQ(mark_bits::write(mark) & ~mark_bits::all, 0u);
  }
}

}  // namespace
}  // namespace delone::cells
