// SPDX-License-Identifier: BSD-3-Clause
#include "base/union_find.hpp"

#include <gtest/gtest.h>

namespace delone::internal {
namespace {

TEST(UnionFind, TakesTheSmallestMemberAsRoot) {
  UnionFind sets(6);
  for (Index x = 0; x < 6; ++x) EXPECT_EQ(sets.root(x), x);
  sets.unite(5, 3);
  sets.unite(3, 4);
  EXPECT_EQ(sets.root(5), 3u);
  EXPECT_EQ(sets.root(4), 3u);
  sets.unite(4, 1);
  sets.unite(1, 5);  // together already
  for (const Index x : {1u, 3u, 4u, 5u}) EXPECT_EQ(sets.root(x), 1u);
  EXPECT_EQ(sets.root(0), 0u);
  EXPECT_EQ(sets.root(2), 2u);
}

TEST(UnionFind, FollowsLongChains) {
  constexpr Index n = 1000;
  UnionFind sets(n);
  for (Index x = n - 1; x > 0; --x) sets.unite(x - 1, x);
  EXPECT_EQ(sets.root(n - 1), 0u);
}

}  // namespace
}  // namespace delone::internal
