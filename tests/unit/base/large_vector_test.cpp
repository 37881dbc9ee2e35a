// SPDX-License-Identifier: BSD-3-Clause
#include "base/large_vector.hpp"

#include <gtest/gtest.h>

namespace delone::internal {
namespace {

TEST(LargeVector, ShrinksOnlyWhereMuchIsLeft) {
  std::vector<int> items(100'000, 7);
  const std::size_t all = items.capacity();
  shrink_large(items);
  items.resize(60'000);
  shrink_large(items);
  EXPECT_EQ(items.capacity(), all);
  items.resize(10);
  shrink_large(items);
  EXPECT_LT(items.capacity(), 1000u);
  EXPECT_EQ(items, std::vector<int>(10, 7));
}

}  // namespace
}  // namespace delone::internal
