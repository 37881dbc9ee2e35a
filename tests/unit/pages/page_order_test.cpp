// SPDX-License-Identifier: BSD-3-Clause
#include "pages/page_order.hpp"

#include "../tiles/tile_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace delone::pages {
namespace {

std::vector<double> records_of(const test::TileSet& set) {
  std::vector<double> records;
  const auto width = static_cast<std::size_t>(set.row_size);
  for (std::size_t i = 0; i < set.rows.size(); i += width) {
    records.insert(records.end(), &set.rows[i], &set.rows[i] + width);
    records.push_back(coded_row(static_cast<std::int64_t>(i / width)));
  }
  return records;
}

PageTable empty_table(const test::TileSet& set) {
  PageTable table;
  table.dimension = set.dimension();
  table.weighted = set.weighted;
  table.first_point = {0};
  return table;
}

TEST(PageOrder, CutsPages) {
  for (const test::TileSet& set : test::tile_sets(test::scaled_count(600)))
    for (const std::size_t page_points : {1, 7, 128, 5000}) {
      SCOPED_TRACE(set.name + ", pages of " + std::to_string(page_points));
      const std::vector<double> given = records_of(set);
      std::vector<double> records = given;
      PageTable table = empty_table(set);
      order_pages(records, page_points, table);
      const auto width = static_cast<std::size_t>(set.row_size),
                 d = static_cast<std::size_t>(set.dimension());
      const std::size_t n = set.rows.size() / width;
      ASSERT_EQ(table.num_points(), n);
      EXPECT_EQ(table.num_pages(), (n + page_points - 1) / page_points);
      ASSERT_EQ(table.tiles.size(), 1u);
      EXPECT_EQ(table.tiles[0].first_page, 0u);
      EXPECT_EQ(table.tiles[0].last_page, table.num_pages());
      ASSERT_EQ(records.size(), given.size());
      std::set<std::int64_t> rows;
      for (std::size_t page = 0; page < table.num_pages(); ++page) {
        ASSERT_GE(table.page_size(page), 1u);
        ASSERT_LE(table.page_size(page), page_points);
        const double* const first = &records[table.first_point[page] * (width + 1)];
        std::vector<double> low(first, first + width), high = low;
        for (std::size_t i = 0; i < table.page_size(page); ++i) {
          const double* const record = first + i * (width + 1);
          const std::int64_t row = row_of(record[width]);
          ASSERT_TRUE(rows.insert(row).second);
          ASSERT_TRUE(std::equal(record, record + width, &set.rows[static_cast<std::size_t>(row) * width]));
          for (std::size_t axis = 0; axis < width; ++axis) {
            low[axis] = std::min(low[axis], record[axis]);
            high[axis] = std::max(high[axis], record[axis]);
          }
        }
        EXPECT_TRUE(std::equal(table.low(page), table.low(page) + d, low.begin()));
        EXPECT_TRUE(std::equal(table.high(page), table.high(page) + d, high.begin()));
        if (set.weighted) {
          EXPECT_EQ(table.weights[page], high[d]);
        }
      }
      EXPECT_EQ(rows.size(), n);
    }
}

/// The rows on each page, whatever the order of the records was.
TEST(PageOrder, DependsOnPointsAlone) {
  for (const test::TileSet& set : test::tile_sets(300)) {
    SCOPED_TRACE(set.name);
    const auto pages_of = [&](std::vector<double> records) {
      PageTable table = empty_table(set);
      order_pages(records, 20, table);
      std::vector<std::set<std::int64_t>> pages(table.num_pages());
      const auto size = static_cast<std::size_t>(set.row_size) + 1;
      for (std::size_t page = 0; page < pages.size(); ++page)
        for (std::uint64_t i = table.first_point[page]; i < table.first_point[page + 1]; ++i)
          pages[page].insert(row_of(records[i * size + size - 1]));
      return pages;
    };
    const std::vector<double> records = records_of(set);
    std::vector<double> reversed;
    const auto size = static_cast<std::ptrdiff_t>(set.row_size) + 1;
    for (auto i = static_cast<std::ptrdiff_t>(records.size()); i > 0; i -= size)
      reversed.insert(reversed.end(), records.begin() + i - size, records.begin() + i);
    EXPECT_EQ(pages_of(records), pages_of(reversed));
  }
}

}  // namespace
}  // namespace delone::pages
