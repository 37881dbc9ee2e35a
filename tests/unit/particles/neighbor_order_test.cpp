// SPDX-License-Identifier: BSD-3-Clause
// The order of neighbors is that of a stable sort, for few of them, which are placed without branches, and
// for many.
#include "particles/neighbor_order.hpp"

#include "degenerate.hpp"

#include <delone/periodic.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace delone::particles {
namespace {

TEST(NeighborOrder, ByRow) {
  NeighborOrder order;
  for (const std::size_t n : {0, 1, 2, 15, 16, 17, 63, 64, 65, 200}) {
    const std::vector<std::size_t> shuffled = test::random_order(n, n);
    std::vector<Index> rows(n + 1), neighbors(n);
    for (std::size_t v = 0; v < n; ++v) rows[v + 1] = static_cast<Index>(3 * shuffled[v]);
    for (std::size_t i = 0; i < n; ++i) neighbors[i] = static_cast<Index>(n - i);
    const auto places = order.find(0, neighbors, rows, nullptr);
    ASSERT_EQ(places.size(), n);
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(rows[neighbors[places[i]]], 3 * i) << n;
    EXPECT_TRUE(order.offsets(0, 0).empty());
  }
}

/// In a small box many neighbors are images of one row: these are in the order of their translations.
TEST(NeighborOrder, ImagesOfOneRow) {
  test::Random random(9);
  std::vector<double> points;
  for (int i = 0; i < 3 * 4; ++i) points.push_back(random.real());
  const std::vector<double> sides{1, 1, 1};
  const PeriodicDelaunay<3> triangulation(PointsView(points, 3), Lattice::box(sides));
  const PeriodicSites sites(triangulation);
  NeighborOrder order;
  int with_equal_rows = 0;
  const Complex complex = sites.triangulation().complex();
  for (const VertexId v : complex.finite_vertices()) {
    if (sites.image_of(index(v)).shift != 0) continue;
    std::vector<Index> neighbors;
    for (const CellId cell : complex.star(v))
      for (const VertexId w : complex.vertices(cell))
        if (w != v && w != infinite_vertex) neighbors.push_back(index(w));
    std::sort(neighbors.begin(), neighbors.end());
    neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
    const auto places = order.find(index(v), neighbors, {}, &sites);
    std::vector<std::int32_t> offsets;
    sites.find_offsets(index(v), neighbors, offsets);
    std::vector<std::pair<Index, std::vector<std::int32_t>>> names;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto of_neighbor = order.offsets(i, 3);
      names.emplace_back(sites.image_of(neighbors[places[i]]).row,
                         std::vector<std::int32_t>(of_neighbor.begin(), of_neighbor.end()));
      EXPECT_TRUE(std::equal(of_neighbor.begin(), of_neighbor.end(), offsets.begin() + 3 * places[i]));
      if (i > 0 && names[i - 1].first == names[i].first) ++with_equal_rows;
    }
    EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  }
  EXPECT_GT(with_equal_rows, 10);
}

}  // namespace
}  // namespace delone::particles
