// SPDX-License-Identifier: BSD-3-Clause
#include "engine/claims.hpp"

#include "base/parallel.hpp"
#include "cells/cell_memory.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace delone::engine {
namespace {

constexpr Index num_cells = 100;

/// Cells of dimension K, in which bytes have room or not.
template <int K>
struct Cells {
  explicit Cells(unsigned workers) : memory(K, cells::VertexIds::narrow), table(workers) {
    memory.reserve(num_cells);
    table.cover(memory);
    table.clear(0, num_cells);
  }
  cells::CellMemory<K> memory;
  ClaimTable table;
};

bool claims(Claims& worker, std::vector<Index> cells) {
  try {
    Claims::Claiming claiming = worker.begin(cells.size());
    for (const Index cell : cells) claiming.add(cell);
    worker.end(claiming);
  } catch (const Clash&) {
    worker.give_up();
    return false;
  }
  return true;
}

template <int K>
void expect_exclusive() {
  Cells<K> cells(3);
  Claims one(cells.table, 0, false), two(cells.table, 2, false);
  EXPECT_TRUE(claims(one, {1, 2, 3, 2}));
  EXPECT_TRUE(claims(one, {3, 4}));
  EXPECT_FALSE(claims(two, {5, 4}));
  EXPECT_TRUE(claims(two, {5, 6}));
  EXPECT_FALSE(two.try_claim(1));
  one.give_up();
  EXPECT_TRUE(two.try_claim(1));
  EXPECT_TRUE(claims(two, {2, 3, 4}));
}

TEST(Claims, OneWorkerAtATime) {
  expect_exclusive<2>();
  expect_exclusive<3>();
  expect_exclusive<4>();
  expect_exclusive<5>();
}

TEST(Claims, SurvivorsMayBeShared) {
  Cells<5> cells(2);
  Claims one(cells.table, 0, true), two(cells.table, 1, true);
  EXPECT_TRUE(claims(one, {1, 2}));
  EXPECT_TRUE(claims(two, {2, 3}));
  EXPECT_THROW(one.own(2), Clash) << "the other holds it";
  one.give_up();
  two.own(3);
  EXPECT_TRUE(claims(one, {2}));
  EXPECT_FALSE(claims(one, {3}));
  EXPECT_TRUE(claims(one, {1}));
  one.marks().set_if(1, true);
  EXPECT_FALSE(claims(two, {1})) << "in conflict with the vertex of the other";
}

TEST(Claims, VacantSlotsAreKept) {
  Cells<3> cells(2);
  Claims one(cells.table, 0, false), two(cells.table, 1, false);
  EXPECT_TRUE(claims(one, {1, 2, 3}));
  one.marks().set_if(1, true);
  one.marks().set_if(2, false);
  EXPECT_EQ(one.marks()(1), Mark::in_conflict);
  EXPECT_TRUE(one.marks().is_unseen(2));
  one.give_up_and_keep_zone();
  EXPECT_FALSE(two.try_claim(1));
  EXPECT_FALSE(one.try_claim(1)) << "it is no cell";
  EXPECT_TRUE(two.try_claim(2));
  one.release_kept(
      1, [](std::size_t) { return Index{1}; }, invalid_index);
  EXPECT_TRUE(two.try_claim(1));
}

TEST(Claims, NoTwoWorkersHaveACell) {
  constexpr unsigned workers = 4;
  Cells<3> cells(workers);
  std::vector<int> written(num_cells, 0);  // not atomic: ThreadSanitizer would see two
  internal::run_workers(workers, [&](unsigned w) {
    Claims own(cells.table, w, false);
    for (Index turn = 0; turn < 3000; ++turn) {
      const Index cell = (turn * 7 + w) % (num_cells - 2);
      if (!claims(own, {cell, cell + 1, cell + 2})) continue;
      for (Index i = 0; i < 3; ++i) ++written[cell + i];
      own.give_up();
    }
  });
  long sum = 0;
  for (const int count : written) sum += count;
  EXPECT_GT(sum, 0);
  EXPECT_EQ(sum % 3, 0);
}

}  // namespace
}  // namespace delone::engine
