// SPDX-License-Identifier: BSD-3-Clause
// Sets of small numbers in words of 64 bits, at and across the ends of words.
#include "polyhedra/bit_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace delone::polyhedra {
namespace {

using ::testing::ElementsAre;

std::vector<std::size_t> members(ConstBits set) {
  std::vector<std::size_t> all;
  for_each(set, [&](std::size_t i) { all.push_back(i); });
  return all;
}

TEST(BitRows, HoldNumbersAcrossWords) {
  EXPECT_EQ(words_for(0), 0u);
  EXPECT_EQ(words_for(64), 1u);
  EXPECT_EQ(words_for(65), 2u);
  BitRows rows(3, 129);
  EXPECT_EQ(rows.words(), 3u);
  for (const std::size_t i : {0u, 63u, 64u, 127u, 128u}) insert(rows[1], i);
  EXPECT_THAT(members(rows[1]), ElementsAre(0, 63, 64, 127, 128));
  EXPECT_EQ(count(rows[1]), 5u);
  EXPECT_EQ(count(rows[0]) + count(rows[2]), 0u) << "rows are apart";
  EXPECT_TRUE(test(rows[1], 64));
  EXPECT_FALSE(test(rows[1], 65));
}

TEST(BitRows, ContainEachOther) {
  BitRows rows(3, 100);
  for (const std::size_t i : {1u, 70u, 99u}) insert(rows[0], i);
  for (const std::size_t i : {1u, 99u}) insert(rows[1], i);
  EXPECT_TRUE(contains(rows[0], rows[1]));
  EXPECT_FALSE(contains(rows[1], rows[0]));
  EXPECT_TRUE(contains(rows[0], rows[0]));
  EXPECT_TRUE(contains(rows[2], rows[2])) << "empty ones";
  insert(rows[1], 64);
  EXPECT_FALSE(contains(rows[0], rows[1])) << "the last word tells";
}

TEST(BitRows, TransposedTwiceAreTheSame) {
  BitRows rows(70, 3);
  insert(rows[0], 0);
  insert(rows[63], 2);
  insert(rows[64], 2);
  insert(rows[69], 1);
  const BitRows columns = rows.transposed(3);
  ASSERT_EQ(columns.size(), 3u);
  EXPECT_EQ(columns.words(), 2u);
  EXPECT_THAT(members(columns[2]), ElementsAre(63, 64));
  EXPECT_THAT(members(columns[1]), ElementsAre(69));
  EXPECT_EQ(columns.transposed(70), rows);
}

TEST(BitRows, NewRowsAreEmpty) {
  BitRows rows(1, 64);
  insert(rows[0], 5);
  rows.resize(3);
  EXPECT_THAT(members(rows[0]), ElementsAre(5));
  EXPECT_EQ(count(std::as_const(rows)[2]), 0u);
  insert(rows[2], 6);
  rows.resize(1);
  rows.resize(3);
  EXPECT_EQ(count(rows[2]), 0u) << "what was dropped does not come back";
}

}  // namespace
}  // namespace delone::polyhedra
