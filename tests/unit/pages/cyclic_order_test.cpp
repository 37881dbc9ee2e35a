// SPDX-License-Identifier: BSD-3-Clause
#include "pages/cyclic_order.hpp"

#include <gtest/gtest.h>

namespace delone::pages {
namespace {

TEST(CompareAlong, TiesOnlyEqualPositions) {
  const double a[] = {1, -0.0, 3}, b[] = {1, 0.0, 4}, c[] = {1, 0.0, 3};
  EXPECT_EQ(compare_along(a, c, 0, 3), 0);
  EXPECT_LT(compare_along(a, b, 0, 3), 0);
  EXPECT_LT(compare_along(a, b, 1, 3), 0);
  EXPECT_GT(compare_along(b, a, 2, 3), 0);
  const double d[] = {0, 5}, e[] = {1, 4};
  EXPECT_LT(compare_along(d, e, 0, 2), 0);
  EXPECT_GT(compare_along(d, e, 1, 2), 0);
}

TEST(LongestAxis, BeyondTheLargestDouble) {
  const double low[] = {-1e308, -1.5e308, 0}, high[] = {1e308, 1.5e308, 1};
  EXPECT_EQ(longest_axis(low, high, 3), 1);
}

}  // namespace
}  // namespace delone::pages
