// SPDX-License-Identifier: BSD-3-Clause
// A zone has all cells in conflict and its horizon all facets to others, ties included, whatever cell it is
// searched from; marks can be taken back, or kept elsewhere.
#include "engine/conflict_zone.hpp"
#include "engine_support.hpp"

#include <utility>

namespace delone::engine {
namespace {

/// The points of a lattice, those of a simplex first; cospherical ones abound. The last is not inserted.
template <int K>
std::vector<double> lattice() {
  constexpr int side = K == 2 ? 6 : 3;
  std::vector<std::vector<double>> points(1, std::vector<double>(K, 0.0));
  for (int j = 0; j < K; ++j) {
    points.emplace_back(K, 0.0);
    points.back()[static_cast<std::size_t>(j)] = 1;
  }
  const std::set<std::vector<double>> simplex(points.begin(), points.end());
  const int size = K == 2 ? side * side : side * side * side;
  for (int i = 0; i < size; ++i) {
    std::vector<double> point;
    for (int j = 0, rest = i * 5 % size; j < K; ++j, rest /= side) point.push_back(rest % side);
    if (!simplex.contains(point)) points.push_back(point);
  }
  std::vector<double> rows;
  for (const auto& point : points) rows.insert(rows.end(), point.begin(), point.end());
  return rows;
}

using Facets = std::set<std::pair<Index, int>>;

template <int K>
void expect_right_zones() {
  const std::vector<double> rows = lattice<K>();
  Points<K> points(rows, K, -1, 6);
  auto& build = points.build;
  CellStore<K>& cells = build.cells();
  const auto& geometry = build.geometry();
  points.seed();
  const auto last = static_cast<Index>(rows.size()) / K;
  for (Index v = K + 2; v <= last; ++v) {
    const auto q = geometry.query_at(v);
    StageCounts counts;
    std::set<Index> expected;
    for (Index cell = 0; cell < cells.num_slots(); ++cell)
      if (!cells.is_vacant(cell) &&
          in_conflict_exactly(cells, geometry, cell, q, geometry.evaluator(q), counts))
        expected.insert(cell);
    Facets border;
    for (const Index cell : expected)
      for (int i = 0; i <= K; ++i)
        if (!expected.contains(cells.neighbors(cell)[i])) border.emplace(cell, i);

    ConflictZone zone;
    internal::StampedTable separate;
    const auto expect_right = [&] {
      EXPECT_EQ(std::set<Index>(zone.cells.data(), zone.cells.data() + zone.num_cells), expected);
      EXPECT_EQ(zone.num_cells, expected.size());
      Facets horizon;
      for (const HorizonFacet& facet : std::span(zone.horizon.data(), zone.num_facets)) {
        const Index dead = zone.cells[facet.dead];
        horizon.emplace(dead, facet.slot);
        EXPECT_EQ(cells.neighbors(dead)[facet.slot], facet.survivor);
      }
      EXPECT_EQ(horizon, border);
      EXPECT_EQ(zone.num_facets, border.size());
    };
    for (const Index first : {*expected.begin(), *expected.rbegin()}) {
      find_conflict_zone(cells, geometry, q, first, cells.marks(), zone, counts);
      expect_right();
      for (const Index cell : expected) EXPECT_EQ(cells.mark(cell), Mark::in_conflict);
      unmark(cells.marks(), zone);
      separate.clear();
      find_conflict_zone(cells, geometry, q, first, SeparateMarks(separate), zone, counts);
      expect_right();
      for (Index cell = 0; cell < cells.num_slots(); ++cell)
        EXPECT_TRUE(cells.is_vacant(cell) || cells.mark(cell) == Mark::unseen);
    }
    EXPECT_GT(counts.filter, 0u);
    ASSERT_EQ(build.insert(v), v);
  }
}

TEST(ConflictZone, InThePlane) { expect_right_zones<2>(); }
TEST(ConflictZone, InSpace) { expect_right_zones<3>(); }

}  // namespace
}  // namespace delone::engine
