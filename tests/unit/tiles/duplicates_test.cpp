// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/duplicates.hpp"
#include "pages/page_order.hpp"

#include <gtest/gtest.h>

namespace {

using namespace delone::pages;
using namespace delone::tiles;

TEST(TakeDuplicates, KeepsTheFirstRow) {
  std::vector<double> records;
  const auto add = [&](double x, double y, std::int64_t row) {
    records.insert(records.end(), {x, y, coded_row(row)});
  };
  add(1, 0.0, 7);
  add(2, 0.0, 1);
  add(1, -0.0, 3);  // an earlier row
  add(2, 1.0, 4);
  add(1, 0.0, 9);
  const std::vector<Duplicate> duplicates = take_duplicates(records, 2);
  ASSERT_EQ(records.size(), 9u);
  EXPECT_EQ(row_of(records[2]), 3);
  EXPECT_EQ(row_of(records[5]), 1);
  EXPECT_EQ(row_of(records[8]), 4);
  ASSERT_EQ(duplicates.size(), 2u);
  EXPECT_EQ(duplicates[0].row, 7);
  EXPECT_EQ(duplicates[0].first_row, 3);
  EXPECT_EQ(duplicates[1].row, 9);
  EXPECT_EQ(duplicates[1].first_row, 3);
}

TEST(TakeDuplicates, Many) {
  std::vector<double> records;
  for (std::int64_t row = 0; row < 3000; ++row)
    records.insert(records.end(), {static_cast<double>(row * 7 % 11), coded_row(row)});
  EXPECT_EQ(take_duplicates(records, 1).size(), 3000u - 11u);
  EXPECT_EQ(records.size(), 22u);
  std::vector<double> none;
  EXPECT_TRUE(take_duplicates(none, 3).empty());
}

}  // namespace
