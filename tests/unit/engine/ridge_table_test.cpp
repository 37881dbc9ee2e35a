// SPDX-License-Identifier: BSD-3-Clause
// The ridges of a star: linking by hash makes those cells neighbors that share a facet.
#include "engine/ridge_table.hpp"

#include "base/random.hpp"
#include "engine/build.hpp"
#include "geometry/delaunay_geometry.hpp"
#include "kernel/predicates.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace delone::engine {

using cells::VertexIds;

namespace {

/// Expects that neighbors are the two cells of a facet, for all facets.
template <int K>
void expect_neighbors_share_facets(const CellStore<K>& cells) {
  std::map<std::vector<Index>, std::vector<std::pair<Index, int>>> sides;
  for (Index cell = 0; cell < cells.num_slots(); ++cell) {
    if (cells.is_vacant(cell)) continue;
    for (int slot = 0; slot <= K; ++slot) {
      std::vector<Index> facet;
      for (int i = 0; i <= K; ++i)
        if (i != slot) facet.push_back(cells.vertex(cell, i));
      std::sort(facet.begin(), facet.end());
      sides[facet].emplace_back(cell, slot);
    }
  }
  for (const auto& [facet, pair] : sides) {
    ASSERT_EQ(pair.size(), 2u);
    for (const std::size_t i : {0u, 1u})
      EXPECT_EQ(cells.neighbors(pair[i].first)[pair[i].second], pair[1 - i].first);
  }
}

/// The vertices of each cell, and those across its facets, after the insertion of points one by one, ridges
/// hashed `rounds` times. Vertices are the ids after `unused`, which says nothing of them here, and kept as
/// `ids` at first.
template <int K>
std::vector<std::vector<Index>> links(Index n, double grid_size, int rounds, VertexIds ids = VertexIds::wide,
                                      Index unused = 0) {
  std::vector<double> points((unused + 1) * std::size_t{K}, 0.0);
  kernel::Grid grid(K);
  kernel::AffineHull hull(K);
  std::vector<Index> simplex, others;
  random::Generator random(7);
  for (Index v = unused + 1; v <= unused + n; ++v) {
    std::vector<double> x(K);
    for (double& c : x) c = grid_size > 0 ? std::floor(random.uniform() * grid_size) : random.uniform();
    points.insert(points.end(), x.begin(), x.end());
    grid.include(x.data());
    (hull.add(x.data()) ? simplex : others).push_back(v);
  }
  std::vector<int> axes(K);
  std::iota(axes.begin(), axes.end(), 0);
  const geometry::Frame frame(std::vector<double>(K, 0.0), std::vector<double>(K, std::max(1.0, grid_size)));
  Build<K, geometry::DelaunayGeometry<K>> build(K, ids, axes, K, points, grid, frame);
  auto& geometry = build.geometry();
  geometry.set_rows(unused + n);
  if (geometry.orientation(simplex.data()) == Sign::negative) std::swap(simplex[0], simplex[1]);
  build.seed(simplex);
  build.workspace().ridges = RidgeTable(rounds);
  for (const Index v : others) build.insert(v);
  const CellStore<K>& cells = build.cells();
  EXPECT_EQ(cells.links_of_complex().narrow_vertices,
            ids == VertexIds::narrow && unused + n <= cells::last_narrow_vertex);
  expect_neighbors_share_facets(cells);
  // Which slot a cell is in depends on when slots become vacant.
  std::vector<std::vector<Index>> all;
  for (Index cell = 0; cell < cells.num_slots(); ++cell) {
    if (cells.is_vacant(cell)) continue;
    std::array<std::pair<Index, Index>, K + 1> across;
    for (std::size_t i = 0; i <= K; ++i) {
      const Index neighbor = cells.neighbors(cell)[i];
      const Index pair[] = {cells.vertex(cell, static_cast<int>(i)),
                            cells.vertex(neighbor, cells.slot_of_neighbor(neighbor, cell))};
      const auto number = [&](Index v) { return v == index(infinite_vertex) ? v : v - unused; };
      across[i] = {number(pair[0]), number(pair[1])};
    }
    std::sort(across.begin(), across.end());
    std::vector<Index>& described = all.emplace_back();
    for (const auto& [vertex, opposite] : across) described.insert(described.end(), {vertex, opposite});
  }
  std::sort(all.begin(), all.end());
  return all;
}

template <int K>
void expect_neighbors_are_linked(Index n, double grid_size) {
  SCOPED_TRACE(testing::Message() << "dimension " << K << ", " << n << " points");
  const auto in_one_round = links<K>(n, grid_size, 1);  // what it leaves, by its vertices
  EXPECT_GT(in_one_round.size(), static_cast<std::size_t>(n));
  EXPECT_EQ(in_one_round, links<K>(n, grid_size, 6));
  if constexpr (cells::may_be_narrow(K)) {
    EXPECT_EQ(in_one_round, links<K>(n, grid_size, 6, VertexIds::narrow));
    EXPECT_EQ(in_one_round, links<K>(n, grid_size, 1, VertexIds::narrow));
    EXPECT_EQ(in_one_round, links<K>(n, grid_size, 6, VertexIds::narrow, cells::last_narrow_vertex - n));
    EXPECT_EQ(in_one_round, links<K>(n, grid_size, 6, VertexIds::narrow,
                                     cells::last_narrow_vertex - n / 2));  // they are made wide
  }
}

TEST(RidgeTable, LinksNeighbors) {
  const auto size = [](Index usual, Index small) {
    return static_cast<Index>(test::scaled_size(usual, small));
  };
  expect_neighbors_are_linked<1>(30, 0);
  expect_neighbors_are_linked<2>(200, 0);
  expect_neighbors_are_linked<3>(size(300, 100), 0);
  expect_neighbors_are_linked<3>(size(300, 100), 6);
  expect_neighbors_are_linked<4>(size(150, 50), 0);
  expect_neighbors_are_linked<5>(size(80, 30), 3);
  expect_neighbors_are_linked<5>(size(60, 24), 0);
  expect_neighbors_are_linked<6>(size(40, 18), 0);
  expect_neighbors_are_linked<8>(20, 0);  // a cell's ids in more than one vector
  expect_neighbors_are_linked<9>(18, 2);
}

// Two ridges of a star with the same hash are in the same entry whatever the round.
TEST(RidgeTable, TellsApartRidgesWithTheSameHash) {
  constexpr int k = 3;
  const std::size_t halves = std::size_t{1} << half_ridge_shift(k);
  const Index apex = 1;
  // Edges {v, v + 1} and the apex, which are ridges opposite slot 3.
  constexpr std::uint32_t num_edges = 400000;
  CellMemory<k> memory(k);
  CellStore<k> cells(memory);
  cells.reserve(num_edges);
  std::vector<HorizonFacet> facets(num_edges);
  for (std::uint32_t f = 0; f < num_edges; ++f) {
    facets[f].created = cells.allocate();
    facets[f].slot = 0;
    const Index vertices[] = {apex, 2 * f + 2, 2 * f + 3, 0};
    std::copy_n(vertices, k + 1, cells.wide_vertices(facets[f].created));
  }
  std::vector<std::uint32_t> hashes(num_edges * halves + 16);
  std::vector<Index> created(num_edges);
  hash_ridges(cells.links(), facets, 0, num_edges, hashes.data(), created.data(), nullptr);
  std::vector<std::pair<std::uint32_t, Index>> by_hash;
  for (std::uint32_t f = 0; f < num_edges; ++f) by_hash.push_back({hashes[f * halves + 3], 2 * f + 2});
  std::sort(by_hash.begin(), by_hash.end());
  const auto same = std::adjacent_find(by_hash.begin(), by_hash.end(),
                                       [](const auto& a, const auto& b) { return a.first == b.first; });
  ASSERT_NE(same, by_hash.end());
  const Index a = same[0].second, c = same[1].second, b = a + 1, d = c + 1, top = 2 * num_edges + 2,
              bottom = top + 1;
  // The star over an octahedron, whose edges ab and cd are opposite.
  const Index equator[] = {a, b, c, d};
  facets.resize(8);
  for (std::uint32_t f = 0; f < 8; ++f) {
    const Index vertices[] = {apex, equator[f % 4], equator[(f + 1) % 4], f < 4 ? top : bottom};
    std::copy_n(vertices, k + 1, cells.wide_vertices(facets[f].created));
  }
  for (const int rounds : {1, 6}) {
    for (const HorizonFacet& facet : facets)
      std::fill_n(cells.neighbors(facet.created), k + 1, invalid_index);
    RidgeTable ridges(rounds);
    ridges.reserve(facets.size(), k);
    ridges.hash(cells, facets, 0, facets.size());
    ridges.link(cells, facets);
    for (std::uint32_t f = 0; f < 8; ++f) {
      const Index* const neighbors = cells.neighbors(facets[f].created);
      EXPECT_EQ(neighbors[1], facets[f / 4 * 4 + (f + 1) % 4].created);
      EXPECT_EQ(neighbors[2], facets[f / 4 * 4 + (f + 3) % 4].created);
      EXPECT_EQ(neighbors[3], facets[(f + 4) % 8].created);
    }
  }
}

// More half-ridges in a star than half of the bits of an entry can number.
TEST(RidgeTable, LinksNeighborsOfLargeStars) {
  expect_neighbors_are_linked<7>(static_cast<Index>(std::max<std::size_t>(test::scaled_count(150), 40)), 0);
}

}  // namespace
}  // namespace delone::engine
