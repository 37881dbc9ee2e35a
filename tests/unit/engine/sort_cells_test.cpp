// SPDX-License-Identifier: BSD-3-Clause
// Sorted cells are the same whatever the order in which their vertices were inserted, and they are still a
// triangulation that grows.
#include "engine/sort_cells.hpp"

#include "base/progress_meter.hpp"
#include "engine_support.hpp"
#include "scale.hpp"

#include <delone/error.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace delone::engine {
namespace {

/// Vertices and neighbors of all slots, after cells have been sorted in a copy.
template <int K, int HashBits>
std::vector<std::vector<Index>> sorted_links(Points<K>& points, Index num_vertices, unsigned threads) {
  const CellStore<K>& from = std::as_const(points.build).cells();
  CellMemory<K> memory(K);
  memory.copy(points.build.memory(), from.num_slots());
  CellStore<K> cells(memory);
  cells.copy_slots(from);
  CellSorter<K, HashBits>(memory, cells, {num_vertices, threads > 1}, threads).run();
  EXPECT_EQ(cells.num_slots(), from.num_cells());
  std::vector<std::vector<Index>> links(cells.num_slots());
  Index newest = 0;
  for (Index cell = 0; cell < links.size(); ++cell) {
    const Index before = std::exchange(newest, 0);
    for (int i = 0; i <= K; ++i) {
      links[cell].push_back(cells.vertex(cell, i));
      links[cell].push_back(cells.neighbors(cell)[i]);
      newest = std::max(newest, cells.vertex(cell, i));
      if (i > 0 && i + 1 < K) {
        EXPECT_LT(cells.vertex(cell, i - 1), cells.vertex(cell, i));
      }
    }
    EXPECT_GE(newest, before);
  }
  return links;
}

template <int K>
void expect_same_order(std::size_t usual) {
  SCOPED_TRACE(K);
  const std::size_t count = test::scaled_count(usual);
  const auto n = static_cast<Index>(count);
  const std::vector<double> rows = make_point_set("uniform", K, count, 3);
  Points<K> up(rows, K, 0, 1), down(rows, K, 0, 1);
  up.seed();
  down.seed();
  for (Index v = K + 2; v <= n; ++v) up.build.insert(v);
  for (Index v = n; v >= K + 2; --v) down.build.insert(v);
  const auto links = sorted_links<K, 32>(up, n + 1, 1);
  for (const unsigned threads : {1u, 3u}) {
    EXPECT_EQ((sorted_links<K, 32>(down, n + 1, threads)), links);
    // Equal hashes.
    EXPECT_EQ((sorted_links<K, 1>(up, n + 1, threads)), (sorted_links<K, 1>(down, n + 1, 1)));
  }
  const auto sphere = up.sphere();
  up.build.sort_cells({n + 1, true}, 2);
  EXPECT_EQ(up.sphere(), sphere);
  EXPECT_EQ((sorted_links<K, 32>(up, n + 1, 1)), links);
}

TEST(SortCells, OrderDependsOnVerticesAlone) {
  expect_same_order<2>(2000);
  expect_same_order<3>(1000);  // certificates are apart
}

TEST(SortCells, CancelledSortingChangesNothing) {
  const Index n = 400;
  const std::vector<double> rows = make_point_set("uniform", 3, n, 3);
  Points<3> points(rows, 3, 0, 1);
  points.seed();
  for (Index v = 5; v <= n; ++v) points.build.insert(v);
  const CellStore<3>& cells = std::as_const(points.build).cells();
  const auto links = [&] {
    std::vector<Index> all;
    for (Index cell = 0; cell < cells.num_slots(); ++cell)
      for (int i = 0; i <= 3 && !cells.is_vacant(cell); ++i) {
        all.push_back(cells.vertex(cell, i));
        all.push_back(cells.neighbors(cell)[i]);
      }
    return all;
  };
  const std::vector<Index> before = links();
  const std::function<bool(double)> stop = [](double) { return false; };
  for (const bool has_gaps : {false, true}) {
    const internal::ProgressMeter meter(stop);
    EXPECT_THROW(points.build.sort_cells({n + 1, has_gaps}, 2), Error);
  }
  EXPECT_EQ(links(), before);
  EXPECT_THROW(
      {
        const internal::ProgressMeter meter(stop);
        CellMemory<3> copy(3);
        copy.copy(points.build.memory(), cells.num_slots());
      },
      Error);
  const auto sphere = points.sphere();
  points.build.sort_cells({n + 1, false}, 1);
  EXPECT_NE(links(), before);
  EXPECT_EQ(points.sphere(), sphere);
}

TEST(SortCells, SortedCellsGrow) {
  const std::size_t count = test::scaled_count(400);
  const auto n = static_cast<Index>(count);
  const std::vector<double> rows = make_point_set("uniform", 3, count, 3);
  Points<3> sorted(rows, 3, 0, 1), reference(rows, 3, 0, 1);
  sorted.seed();
  reference.seed();
  for (Index v = 5; v <= n; ++v) {
    sorted.build.insert(v);
    reference.build.insert(v);
    if (v % 50 == 0) sorted.build.sort_cells({n + 1, false}, 1);
  }
  EXPECT_EQ(sorted.sphere(), reference.sphere());
}

}  // namespace
}  // namespace delone::engine
