// SPDX-License-Identifier: BSD-3-Clause
#include "base/compensated_sum.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace delone::internal {
namespace {

TEST(CompensatedSum, KeepsWhatWouldBeRoundedAway) {
  CompensatedSum sum;
  for (const double x : {1.0, 1e100, 1.0, -1e100}) sum.add(x);
  EXPECT_EQ(sum.value(), 2);
}

TEST(CompensatedSum, AddsOtherSumsWithTheirCorrections) {
  CompensatedSum sum, other;
  for (const double x : {1.0, 1e100}) sum.add(x);
  for (const double x : {1.0, -1e100}) other.add(x);
  sum.add(other);
  EXPECT_EQ(sum.value(), 2);
}

TEST(CompensatedSum, OverflowsToInfinity) {
  CompensatedSum sum;
  for (int i = 0; i < 3; ++i) sum.add(1.5e308);
  EXPECT_EQ(sum.value(), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace delone::internal
