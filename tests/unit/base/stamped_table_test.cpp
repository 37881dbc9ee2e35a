// SPDX-License-Identifier: BSD-3-Clause
#include "base/stamped_table.hpp"

#include <gtest/gtest.h>

#include <map>

namespace delone::internal {
namespace {

TEST(StampedTable, KeepsTheFirstNumberOfAKey) {
  StampedTable table;
  for (std::uint64_t turn = 0; turn < 5; ++turn) {
    table.clear();
    std::map<std::uint64_t, std::uint32_t> expected;
    for (std::uint32_t i = 0; i < 300 * turn; ++i) {
      const std::uint64_t key = std::uint64_t{i * i % 211} << (i % 3 * 20);
      const auto [at, is_new] = expected.try_emplace(key, i);
      const auto [number, was_inserted] = table.insert(key, i);
      EXPECT_EQ(number, at->second);
      EXPECT_EQ(was_inserted, is_new);
    }
    EXPECT_EQ(table.size(), expected.size());
  }
}

TEST(StampedTable, IsEmptyAfterClear) {
  StampedTable table;
  EXPECT_TRUE(table.insert(0, 1).second);
  EXPECT_FALSE(table.insert(0, 2).second);
  table.clear();
  EXPECT_FALSE(table.contains(0));
  EXPECT_EQ(table.find_value(0), nullptr);
  EXPECT_TRUE(table.insert(0, 3).second);
  ASSERT_TRUE(table.contains(0));
  EXPECT_EQ(*table.find_value(0), 3u);
}

// Whether more keys come than were expected, or fewer.
TEST(StampedTable, ExpectsSomeNumberOfKeys) {
  StampedTable table;
  for (const std::uint32_t count : {3u, 1000u, 10u, 200u, 5000u, 40u, 3000u})
    for (const std::size_t expected : {std::size_t{0}, std::size_t{60}, std::size_t{5000}}) {
      table.clear(expected);
      for (std::uint32_t i = 0; i < count; ++i) EXPECT_TRUE(table.insert(7 * i, i).second);
      EXPECT_EQ(table.size(), count);
      for (std::uint32_t i = 0; i < count; ++i) EXPECT_EQ(*table.find_value(7 * i), i);
      EXPECT_FALSE(table.contains(7 * count));
    }
}

TEST(StampedTable, SetReplacesNumbers) {
  StampedTable table;
  for (std::uint32_t i = 0; i < 500; ++i) table.set(i % 200, i);
  EXPECT_EQ(table.size(), 200u);
  for (std::uint32_t i = 0; i < 200; ++i) EXPECT_EQ(*table.find_value(i), i < 100 ? 400 + i : 200 + i);
}

}  // namespace
}  // namespace delone::internal
