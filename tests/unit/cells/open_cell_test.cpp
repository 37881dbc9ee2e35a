// SPDX-License-Identifier: BSD-3-Clause
// A limit of comparisons counts up to its last one, and what is beyond it, too.
#include "cells/open_cell.hpp"

#include <gtest/gtest.h>

namespace delone::cells {
namespace {

TEST(ComparisonLimit, AllowsAsManyAsItSays) {
  ComparisonLimit limit;
  EXPECT_TRUE(limit.allows(std::size_t{1} << 40)) << "without a limit";
  limit.reset(10);
  EXPECT_EQ(limit.count(), 0u);
  EXPECT_TRUE(limit.allows(7));
  EXPECT_TRUE(limit.allows(3));
  EXPECT_FALSE(limit.allows(1));
  EXPECT_FALSE(limit.allows(0)) << "it stays exceeded";
  EXPECT_EQ(limit.count(), 11u);
  limit.reset(0);
  EXPECT_TRUE(limit.allows(0));
  EXPECT_FALSE(limit.allows(1));
}

}  // namespace
}  // namespace delone::cells
