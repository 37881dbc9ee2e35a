// SPDX-License-Identifier: BSD-3-Clause
// Whatever a batch has done, undone it has not: the same cells in the same slots, with the same neighbors.
#include "engine/undo_log.hpp"

#include "base/random.hpp"
#include "engine/build.hpp"
#include "engine/hole/refill.hpp"
#include "geometry/delaunay_geometry.hpp"
#include "kernel/predicates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace delone::engine {

using cells::VertexIds;

namespace {

/// Points by their vertices; the engine inserts them in turn.
template <int K>
struct Growing {
  using Geometry = geometry::DelaunayGeometry<K>;

  Growing(Index n, double grid_size, VertexIds ids)
      : points(K, 0.0), grid(K), build(K, ids, axes(), K, points, grid, frame(grid_size)) {
    random::Generator random(5);
    kernel::AffineHull hull(K);
    std::vector<Index> simplex;
    for (Index v = 1; v <= n; ++v) {
      std::vector<double> x(K);
      for (double& c : x) c = grid_size > 0 ? std::floor(random.uniform() * grid_size) : random.uniform();
      points.insert(points.end(), x.begin(), x.end());
      grid.include(x.data());
      (hull.add(x.data()) ? simplex : others).push_back(v);
    }
    build.geometry().set_rows(n);
    if (build.geometry().orientation(simplex.data()) == Sign::negative) std::swap(simplex[0], simplex[1]);
    build.seed(simplex);
  }
  static std::vector<int> axes() {
    std::vector<int> all(K);
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  static geometry::Frame frame(double size) {
    return {std::vector<double>(K, 0.0), std::vector<double>(K, std::max(size, 1.0))};
  }
  void insert(std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) build.insert(others[i]);
  }
  /// Of each slot the vertices and neighbors of its cell, nothing if it is vacant.
  std::vector<std::vector<Index>> cells() const {
    std::vector<std::vector<Index>> all(build.cells().num_slots());
    for (Index cell = 0; cell < all.size(); ++cell)
      for (int i = 0; i <= K && !build.cells().is_vacant(cell); ++i) {
        all[cell].push_back(build.cells().vertex(cell, i));
        all[cell].push_back(build.cells().neighbors(cell)[i]);
      }
    return all;
  }

  std::vector<double> points;
  kernel::Grid grid;
  std::vector<Index> others;
  Build<K, Geometry> build;
};

template <int K>
void expect_undone(double grid_size, VertexIds ids) {
  SCOPED_TRACE(testing::Message() << K << "D, grid " << grid_size);
  constexpr Index n = K < 4 ? 200 : 60;
  Growing<K> once(n, grid_size, ids), undone(n, grid_size, ids);
  const std::size_t half = once.others.size() / 2, all = once.others.size();
  once.insert(0, all);
  undone.insert(0, half);
  const auto before = undone.cells();
  const Index num_infinite = undone.build.num_infinite();
  for (std::size_t last = half; last <= all; last += (all - half) / 3) {
    undone.build.begin_batch();
    undone.insert(half, last);
    if (last == half + (all - half) / 3) undone.build.cells().widen_vertices();
    undone.build.undo_batch();
    ASSERT_EQ(undone.cells(), before);
    EXPECT_EQ(undone.build.num_infinite(), num_infinite);
    EXPECT_TRUE(undone.build.star().empty());
    for (Index cell = 0; cell < undone.build.cells().num_slots(); ++cell)
      EXPECT_TRUE(undone.build.cells().is_vacant(cell) || undone.build.cells().mark(cell) == Mark::unseen);
  }
  undone.build.begin_batch();
  undone.insert(half, all);
  undone.build.keep_batch();
  EXPECT_EQ(undone.build.cells().num_cells(), once.build.cells().num_cells());
  EXPECT_EQ(undone.build.num_infinite(), once.build.num_infinite());
}

TEST(UndoLog, PutsCellsBackIntoTheirSlots) {
  for (const double grid_size : {0.0, 4.0}) {
    expect_undone<2>(grid_size, VertexIds::wide);
    expect_undone<3>(grid_size, VertexIds::wide);
    expect_undone<5>(grid_size, VertexIds::narrow);
  }
}

/// A small batch that removes vertices and inserts them again, in two turns.
template <int K>
void expect_small_batch_undone(double grid_size, VertexIds ids) {
  SCOPED_TRACE(testing::Message() << K << "D, grid " << grid_size);
  constexpr Index n = K < 4 ? 120 : 40;
  Growing<K> growing(n, grid_size, ids);
  growing.insert(0, growing.others.size() - 10);
  HoleFiller<K, typename Growing<K>::Geometry> filler(growing.build.cells(), growing.build.geometry());
  const auto cell_of = [&](Index v) {
    const auto& cells = growing.build.cells();
    for (Index cell = 0; cell < cells.num_slots(); ++cell)
      for (int i = 0; i <= K && !cells.is_vacant(cell); ++i)
        if (cells.vertex(cell, i) == v) return cell;
    return invalid_index;
  };
  const auto before = growing.cells();
  const Index num_infinite = growing.build.num_infinite();
  for (std::size_t turn = 0; turn < 4; ++turn) {
    growing.build.begin_batch(true);
    std::vector<CellId> gone, come;
    growing.build.changed_cells(gone, come);
    EXPECT_TRUE(gone.empty() && come.empty());
    if (turn > 0)
      for (std::size_t i = 0; i < 5 * turn; ++i) {
        const Index v = growing.others[i], cell = cell_of(v);
        EXPECT_TRUE(cell == invalid_index || remove(growing.build, v, cell, filler) == Outcome::done);
      }
    if (turn != 1) growing.insert(growing.others.size() - 10, growing.others.size());
    if (turn == 3) growing.insert(0, 5);
    growing.build.changed_cells(gone, come);
    std::sort(gone.begin(), gone.end());
    std::sort(come.begin(), come.end());
    EXPECT_EQ(std::adjacent_find(gone.begin(), gone.end()), gone.end());
    EXPECT_EQ(std::adjacent_find(come.begin(), come.end()), come.end());
    const auto after = growing.cells();
    for (Index cell = 0; cell < std::max(before.size(), after.size()); ++cell) {
      const bool was = cell < before.size() && !before[cell].empty(),
                 is = cell < after.size() && !after[cell].empty(),
                 has_gone = std::binary_search(gone.begin(), gone.end(), CellId{cell}),
                 has_come = std::binary_search(come.begin(), come.end(), CellId{cell});
      EXPECT_LE(has_gone, was);
      EXPECT_LE(has_come, is);
      EXPECT_EQ(was && !has_gone, is && !has_come) << cell;
      for (std::size_t i = 0; was && !has_gone && i < before[cell].size(); i += 2)
        EXPECT_EQ(before[cell][i], after[cell][i]) << "a vertex of cell " << cell;
    }
    // Besides those that are gone, cells that had gone and were made again in their slots.
    std::vector<CellId> put_back;
    growing.build.undo_batch([&](Index cell) { put_back.push_back(CellId{cell}); });
    std::sort(put_back.begin(), put_back.end());
    EXPECT_EQ(std::adjacent_find(put_back.begin(), put_back.end()), put_back.end());
    EXPECT_TRUE(std::includes(put_back.begin(), put_back.end(), gone.begin(), gone.end()));
    for (const CellId cell : put_back) EXPECT_FALSE(before[index(cell)].empty());
    ASSERT_EQ(growing.cells(), before);
    EXPECT_EQ(growing.build.num_infinite(), num_infinite);
  }
}

TEST(UndoLog, OfSmallBatchesPutsCellsBackIntoTheirSlots) {
  for (const double grid_size : {0.0, 4.0}) {
    expect_small_batch_undone<2>(grid_size, VertexIds::wide);
    expect_small_batch_undone<3>(grid_size, VertexIds::wide);
    expect_small_batch_undone<5>(grid_size, VertexIds::narrow);
  }
}

TEST(UndoLog, OfASmallBatchKnowsNewCellsFromOldOnes) {
  Growing<3> growing(300, 0, VertexIds::wide);
  growing.insert(0, 20);
  const auto& cells = growing.build.cells();
  UndoLog<3> log;
  for (int turn = 0; turn < 2; ++turn) {
    log.begin(cells, true);
    std::vector<CellId> noted, fresh;
    const auto look = [&] {
      noted.clear();
      fresh.clear();
      log.list_changes(cells, noted, fresh);
    };
    look();
    EXPECT_TRUE(noted.empty() && fresh.empty());
    const std::vector<Index> dying{2, 5};
    log.reserve_new(2);
    log.note_new(std::vector<Index>{7});  // as if its slot had been vacant
    log.note(cells, dying);
    log.note(cells, dying);
    log.note(cells, std::vector<Index>{7});  // new: not noted
    log.note_new(std::vector<Index>{5});     // made again in its slot
    log.note_new(std::vector<Index>{7});
    look();
    EXPECT_TRUE(noted.empty());  // the cells are there, with their vertices
    EXPECT_EQ(fresh, std::vector{CellId{7}});
    log.end();
    EXPECT_FALSE(log.is_on());
  }
}

TEST(UndoLog, OfALargeBatchListsWhatHasChangedInOrder) {
  Growing<3> growing(300, 0, VertexIds::wide);
  growing.insert(0, 20);
  const auto& cells = growing.build.cells();
  const auto vertices_of = [&] {
    std::map<CellId, std::array<Index, 4>> all;
    for (Index cell = 0; cell < cells.num_slots(); ++cell)
      if (!cells.is_vacant(cell))
        all[CellId{cell}] = {cells.vertex(cell, 0), cells.vertex(cell, 1), cells.vertex(cell, 2),
                             cells.vertex(cell, 3)};
    return all;
  };
  const auto before = vertices_of();
  growing.build.begin_batch();
  growing.insert(20, 150);
  const auto after = vertices_of();
  std::vector<CellId> gone, made, expected_gone, expected_made;
  for (const auto& [cell, vertices] : before)
    if (const auto now = after.find(cell); now == after.end() || now->second != vertices)
      expected_gone.push_back(cell);
  for (const auto& [cell, vertices] : after)
    if (const auto old = before.find(cell); old == before.end() || old->second != vertices)
      expected_made.push_back(cell);
  growing.build.changed_cells(gone, made);
  EXPECT_EQ(gone, expected_gone);
  EXPECT_EQ(made, expected_made);
  growing.build.keep_batch();
}

TEST(UndoLog, NotesEachCellOnceAndNoneThatIsNew) {
  Growing<3> growing(300, 0, VertexIds::wide);
  growing.insert(0, 20);
  const Index num_cells = growing.build.cells().num_cells();
  UndoLog<3> log;
  EXPECT_FALSE(log.is_on());
  log.begin(growing.build.cells());
  EXPECT_TRUE(log.is_on());
  std::vector<Index> all(growing.build.cells().num_slots());
  std::iota(all.begin(), all.end(), Index{0});
  log.note(growing.build.cells(), all);
  const std::size_t bytes = log.bytes();
  EXPECT_GE(bytes, num_cells * (8 * 4 + 4));
  for (int again = 0; again < 5; ++again) log.note(growing.build.cells(), all);
  EXPECT_LE(log.bytes(), 3 * bytes);
  log.end();
  EXPECT_EQ(log.bytes(), 0u);
}

}  // namespace
}  // namespace delone::engine
