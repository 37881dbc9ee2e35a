// SPDX-License-Identifier: BSD-3-Clause
// Points in memory are cut as a page file cuts them: each distinct one is in one tile, inside its box.
#include "tiles/memory_pages.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

namespace delone::tiles {
namespace {

TEST(MemoryPages, HaveEveryRowOnce) {
  for (const std::size_t num_tiles : {1u, 4u}) {
    std::vector<double> rows = make_point_set("uniform", 2, 300, 1);
    const std::vector<double> again(rows.begin() + 20, rows.begin() + 60);  // 20 duplicates
    rows.insert(rows.end(), again.begin(), again.end());
    rows[0] = -0.0;
    rows.insert(rows.end(), {0.0, rows[1]});  // and one by the sign of zero
    const MemoryPages pages(rows, 2, num_tiles, 16);
    EXPECT_EQ(pages.survey().num_points, 321u);
    EXPECT_EQ(pages.table().num_points(), 300u);
    ASSERT_EQ(pages.table().tiles.size(), num_tiles);
    std::vector<int> seen(321, 0);
    for (std::size_t t = 0; t < num_tiles; ++t) {
      const TilePoints points = pages.points(t);
      ASSERT_EQ(points.points.size(), 2 * points.rows.size());
      const pages::Tile& tile = pages.table().tiles[t];
      for (std::size_t i = 0; i < points.rows.size(); ++i) {
        const auto row = static_cast<std::size_t>(points.rows[i]);
        ++seen[row];
        for (std::size_t j = 0; j < 2; ++j) {
          EXPECT_EQ(points.points[2 * i + j], rows[2 * row + j]);
          EXPECT_LE(tile.low[j], points.points[2 * i + j]);
          EXPECT_GE(tile.high[j], points.points[2 * i + j]);
        }
      }
      for (const Duplicate& duplicate : points.duplicates) {
        const auto row = static_cast<std::size_t>(duplicate.row),
                   first = static_cast<std::size_t>(duplicate.first_row);
        ++seen[row];
        EXPECT_LT(first, row);
        EXPECT_EQ(rows[2 * row], rows[2 * first]);
        EXPECT_TRUE(std::binary_search(points.rows.begin(), points.rows.end(), duplicate.first_row) ||
                    std::count(points.rows.begin(), points.rows.end(), duplicate.first_row) == 1);
      }
      for (std::size_t page = tile.first_page; page < tile.last_page; ++page) {
        EXPECT_LE(pages.table().page_size(page), 16u);
        EXPECT_EQ(pages.source().find(page)->size(), pages.table().page_size(page));
      }
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 321);
  }
}

TEST(MemoryPages, OfOnePointHaveOnePage) {
  const MemoryPages pages(std::vector<double>{1, 2, 3}, 3, 1);
  EXPECT_EQ(pages.table().num_pages(), 1u);
  EXPECT_EQ(pages.points(0).rows, std::vector<std::int64_t>{0});
  EXPECT_EQ(pages.points(0).points, (std::vector<double>{1, 2, 3}));
}

}  // namespace
}  // namespace delone::tiles
