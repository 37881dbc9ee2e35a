// SPDX-License-Identifier: BSD-3-Clause
// Every cell is where it was to go, with all that it has, whatever cycles and paths the slots form.
#include "cells/move_cells.hpp"

#include "base/random.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace delone::cells {
namespace {

constexpr double coefficient(Index cell, int i) { return 10.0 * cell + i; }

template <int K>
CellMemory<K> numbered_cells(std::size_t count) {
  CellMemory<K> memory(K);
  memory.reserve(count);
  memory.prepare(count);
  for (Index cell = 0; cell < count; ++cell) {
    for (int i = 0; i <= K; ++i) memory.records().functional(cell)[i] = coefficient(cell, i);
    *memory.records().certificate(cell) = -1.0 - cell;
    for (Index i = 0; i < memory.layout().num_link_ids(); ++i) memory.links(cell)[i] = 100 * cell + i;
  }
  return memory;
}

template <int K>
void expect_cell(const CellMemory<K>& memory, Index slot, Index cell) {
  for (int i = 0; i <= K; ++i) ASSERT_EQ(memory.records().functional(slot)[i], coefficient(cell, i)) << slot;
  ASSERT_EQ(*memory.records().certificate(slot), -1.0 - cell);
  for (Index i = 0; i < memory.layout().num_link_ids(); ++i) ASSERT_EQ(memory.links(slot)[i], 100 * cell + i);
}

/// `sources`: what goes to slots 0, 1, …, of `count` slots.
template <int K>
void expect_moves(const std::vector<Index>& sources, std::size_t count) {
  std::vector<Index> vacant(count);
  std::iota(vacant.begin(), vacant.end(), Index{0});
  for (const Index source : sources) vacant[source] = invalid_index;
  std::erase(vacant, invalid_index);
  for (const unsigned threads : {1u, 3u}) {
    CellMemory<K> memory = numbered_cells<K>(count);
    std::vector<std::uint64_t> entries(sources.begin(), sources.end());
    CellMover<K>(memory, entries, vacant, threads).run();
    for (Index slot = 0; slot < sources.size(); ++slot) expect_cell(memory, slot, sources[slot]);
  }
}

template <int K>
void expect_all_moves() {
  expect_moves<K>({}, 0);
  expect_moves<K>({0}, 1);
  expect_moves<K>({2}, 3);
  random::Generator random(K);
  for (const std::size_t count : {std::size_t{7}, std::size_t{300}, test::scaled_count(20000)}) {
    std::vector<Index> sources(count);
    std::iota(sources.begin(), sources.end(), Index{0});
    expect_moves<K>(sources, count);
    // Short cycles, most of them without a start.
    for (std::size_t i = 0; i + 5 < count; i += 5)
      std::rotate(sources.begin() + static_cast<std::ptrdiff_t>(i),
                  sources.begin() + static_cast<std::ptrdiff_t>(i + i % 3),
                  sources.begin() + static_cast<std::ptrdiff_t>(i + 5));
    expect_moves<K>(sources, count);
    std::rotate(sources.begin(), sources.begin() + 1, sources.end());
    expect_moves<K>(sources, count);
    for (std::size_t i = count; i-- > 1;) std::swap(sources[i], sources[random.below(i + 1)]);
    expect_moves<K>(sources, count);
    // Fewer slots are filled than there are: paths from vacant slots to those that are given up.
    sources.resize(count - count / 5);
    expect_moves<K>(sources, count);
  }
}

TEST(MoveCells, EveryCellIsWhereItWasToGo) {
  expect_all_moves<2>();
  expect_all_moves<3>();  // certificates are apart
  expect_all_moves<5>();
}

}  // namespace
}  // namespace delone::cells
