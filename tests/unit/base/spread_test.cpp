// SPDX-License-Identifier: BSD-3-Clause
// Lists made by counting, against vectors of vectors.
#include "base/spread.hpp"

#include "base/random.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace delone::internal {
namespace {

template <class Offset>
void expect_lists(std::size_t num_lists, const std::vector<std::pair<std::size_t, int>>& pairs,
                  std::vector<Offset>& offsets, std::vector<int>& items) {
  std::vector<std::vector<int>> expected(num_lists);
  for (const auto& [list, item] : pairs) expected[list].push_back(item);
  spread(num_lists, offsets, items, [&](const auto& put) {
    for (const auto& [list, item] : pairs) put(list, item);
  });
  ASSERT_EQ(offsets.size(), num_lists + 1);
  EXPECT_EQ(items.size(), pairs.size());
  for (std::size_t l = 0; l < num_lists; ++l)
    EXPECT_EQ(std::vector<int>(items.begin() + static_cast<std::ptrdiff_t>(offsets[l]),
                               items.begin() + static_cast<std::ptrdiff_t>(offsets[l + 1])),
              expected[l])
        << "list " << l << " of " << num_lists;
}

/// The arrays are used again, as by owners that make many lists one after the other.
TEST(Spread, ItemsKeepTheirOrder) {
  random::Generator random(1);
  std::vector<std::size_t> offsets;
  std::vector<std::int32_t> short_offsets;
  std::vector<int> items;
  for (const std::size_t num_lists : {1, 2, 7, 100, 3})
    for (const int num_items : {0, 1, 5, 200, 2}) {
      std::vector<std::pair<std::size_t, int>> pairs;
      for (int i = 0; i < num_items; ++i)
        pairs.emplace_back(static_cast<std::size_t>(random.uniform() * static_cast<double>(num_lists)), i);
      expect_lists(num_lists, pairs, offsets, items);
      expect_lists(num_lists, pairs, short_offsets, items);
    }
}

TEST(Spread, NoLists) {
  std::vector<std::size_t> offsets{5};
  std::vector<int> items{1, 2};
  expect_lists(0, {}, offsets, items);
}

}  // namespace
}  // namespace delone::internal
