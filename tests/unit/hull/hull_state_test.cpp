// SPDX-License-Identifier: BSD-3-Clause
// Several batches give the hull of one; duplicates and interior points are told; a batch may raise the
// dimension, and one that fails changes nothing.
#include "hull/hull_state.hpp"

#include <delone/error.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <span>
#include <vector>

namespace delone::hull {
namespace {

using Coordinates = std::vector<double>;

/// The sites of the cells, each increasing, in increasing order.
std::vector<std::vector<Index>> cells_of(const HullState& state) {
  const SimplicialHull& hull = state.hull();
  const auto k = static_cast<std::size_t>(state.affine_hull().dimension());
  std::vector<std::vector<Index>> cells;
  for (std::size_t cell = 0; cell * k < hull.cells.size(); ++cell) {
    const auto corners = hull.cell(cell);
    cells.emplace_back(corners.begin(), corners.end());
    std::sort(cells.back().begin(), cells.back().end());
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

TEST(HullState, SeveralBatchesGiveTheHullOfOne) {
  constexpr std::size_t n = 600;
  const Coordinates rows = make_point_set("uniform", 3, n, 1);
  HullState once(3), often(3);
  once.insert_range(rows, {});
  for (std::size_t first = 0, size = 2; first < n; first += size, size *= 3)
    often.insert_range(std::span(rows).subspan(3 * first, 3 * std::min(size, n - first)), {});
  ASSERT_EQ(often.num_rows(), n);
  ASSERT_EQ(often.sites().size(), once.sites().size());
  for (std::size_t row = 0; row < n; ++row) EXPECT_EQ(often.site_of_row(row), once.site_of_row(row));
  EXPECT_EQ(cells_of(often), cells_of(once));
  EXPECT_GT(cells_of(once).size(), 50u);
  for (const HullState* state : {&once, &often})
    for (const auto& cell : cells_of(*state))
      for (const Index site : cell) EXPECT_FALSE(state->is_surely_interior(site));
}

TEST(HullState, DuplicatesShareTheSiteOfTheirFirstRow) {
  HullState state(2);
  state.insert_range(Coordinates{0, 0, 8, 0, 0, 0, 0, 8, 8, 0, 2, 2}, {});
  state.insert_range(Coordinates{2, 2, 1, 3, -0.0, 8, 9, 9}, {});
  std::vector<Index> sites;
  for (std::size_t row = 0; row < state.num_rows(); ++row) sites.push_back(state.site_of_row(row));
  EXPECT_EQ(sites, (std::vector<Index>{0, 1, 0, 2, 1, 3, 3, 4, 2, 5}));
  EXPECT_EQ(state.row(2), 3);
  EXPECT_EQ(state.row(5), 9);
  EXPECT_TRUE(state.is_surely_interior(3));
  EXPECT_TRUE(state.is_surely_interior(4));
  EXPECT_EQ(cells_of(state), (std::vector<std::vector<Index>>{{0, 1}, {0, 2}, {1, 5}, {2, 5}}));
}

TEST(HullState, SingleRowsAreToldWhatBecameOfThem) {
  HullState state(2);
  state.insert_range(Coordinates{0, 0, 8, 0, 0, 8}, {});
  const auto insert = [&](const Coordinates& point) { return state.insert_in_flat(point.data()); };
  HullInsertResult result = insert({8, 0});
  EXPECT_TRUE(result.duplicate && !result.inserted && result.row == 3);
  result = insert({1, 2});
  EXPECT_TRUE(!result.duplicate && !result.inserted && result.row == 4);
  EXPECT_TRUE(state.is_surely_interior(state.site_of_row(4)));
  result = insert({9, 9});
  EXPECT_TRUE(!result.duplicate && result.inserted && result.row == 5);
  EXPECT_EQ(cells_of(state).size(), 4u);
}

TEST(HullState, ABatchMayRaiseTheDimension) {
  HullState state(3);
  EXPECT_EQ(state.boundary(), nullptr);
  state.insert_range(Coordinates{1, 1, 1, 1, 1, 1}, {});
  EXPECT_EQ(state.affine_hull().dimension(), 0);
  EXPECT_EQ(state.boundary(), nullptr);
  EXPECT_TRUE(cells_of(state).empty());
  state.insert_range(Coordinates{3, 1, 1, 2, 1, 1}, {});
  EXPECT_EQ(state.affine_hull().dimension(), 1);
  const Coordinates on_line{5, 1, 1}, off_line{1, 5, 1};
  EXPECT_FALSE(state.raises_dimension(on_line.data()));
  EXPECT_TRUE(state.raises_dimension(off_line.data()));
  state.insert_range(Coordinates{2, 1, 1, 1, 5, 1, 1, 1, 5, 1.5, 1.5, 1.5}, {});
  EXPECT_EQ(state.affine_hull().dimension(), 3);
  EXPECT_EQ(state.basis().size(), 4u);
  std::set<Index> vertices;
  for (const auto& cell : cells_of(state)) vertices.insert(cell.begin(), cell.end());
  vertices.erase(2);  // it is inside an edge, and may be a vertex of cells
  EXPECT_EQ(vertices, (std::set<Index>{0, 1, 3, 4}));
  EXPECT_FALSE(state.raises_dimension(off_line.data()));
}

TEST(HullState, ABatchThatIsStoppedChangesNothing) {
  HullState state(2);
  state.insert_range(Coordinates{0, 0, 8, 0, 4, 0}, {});
  Options stopped;
  stopped.progress = [](double) { return false; };
  const Coordinates rows = make_point_set("uniform", 2, 3000, 1);
  EXPECT_THROW(state.insert_range(rows, stopped), Error);
  EXPECT_EQ(state.num_rows(), 3u);
  EXPECT_EQ(state.sites().size(), 3u);
  EXPECT_EQ(state.affine_hull().dimension(), 1);
  EXPECT_EQ(cells_of(state), (std::vector<std::vector<Index>>{{0}, {1}}));

  HullState other(2);
  other.insert_range(Coordinates{0, 0, 8, 0, 4, 0}, {});
  for (HullState* each : {&state, &other}) each->insert_range(rows, {});
  EXPECT_EQ(cells_of(state), cells_of(other));
  for (std::size_t row = 0; row < other.num_rows(); ++row)
    EXPECT_EQ(state.site_of_row(row), other.site_of_row(row));
}

TEST(HullState, RowsWithoutASiteAreComparedWithLaterOnes) {
  constexpr std::size_t n = 3000;
  Coordinates rows = make_point_set("uniform", 3, n, 8);
  std::copy_n(rows.begin() + 3 * 500, 3 * 100, rows.begin() + 3 * 900);
  HullState state(3);
  state.insert_range(rows, {});
  ASSERT_GT(state.sieved_rows().rows().size(), n / 4);
  EXPECT_EQ(state.num_duplicates(), 100u);
  const auto cells = cells_of(state);
  const std::size_t sieved = state.sieved_rows().rows()[0];
  const double* at = state.point_of_row(sieved);
  EXPECT_TRUE(std::equal(at, at + 3, rows.begin() + static_cast<std::ptrdiff_t>(3 * sieved)));
  const HullState copy = state;
  const Coordinates again(at, at + 3);
  EXPECT_TRUE(state.insert_in_flat(again.data()).duplicate);
  EXPECT_TRUE(state.sieved_rows().empty());
  EXPECT_EQ(state.num_duplicates(), 101u);
  state.insert_range(rows, {});
  EXPECT_EQ(state.num_duplicates(), 101u + n);
  EXPECT_EQ(cells_of(state), cells);
  EXPECT_EQ(copy.num_duplicates(), 100u);
  for (std::size_t row = 0; row < n; ++row) EXPECT_EQ(state.site_of_row(row), state.site_of_row(row + n + 1));
}

}  // namespace
}  // namespace delone::hull
