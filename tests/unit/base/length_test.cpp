// SPDX-License-Identifier: BSD-3-Clause
#include "base/length.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

namespace delone::internal {
namespace {

double length(std::initializer_list<double> x) {
  return length_of(x.size(), [&](std::size_t j) { return x.begin()[j]; });
}

TEST(LengthOf, IsThatOfTheVector) {
  EXPECT_EQ(length({}), 0);
  EXPECT_EQ(length({0, -0.0}), 0);
  EXPECT_EQ(length({-3}), 3);
  EXPECT_EQ(length({3, -4}), 5);
  EXPECT_EQ(length({1, 1, 1, 1}), 2);
  EXPECT_EQ(length({2, -3, 6}), 7);
}

TEST(LengthOf, ScalesWithPowersOfTwo) {
  for (const int exponent : {-1060, -1022, -540, 540, 1020}) {
    const double unit = std::ldexp(1.0, exponent);
    EXPECT_EQ(length({3 * unit, 4 * unit}), 5 * unit) << exponent;
  }
  const double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(length({most, least}), most);
  EXPECT_EQ(length({most, most}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(length({least}), least);
  EXPECT_EQ(length({least, least}), least);
}

TEST(LengthOf, IsInfiniteIfAComponentIsNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(length({1, -infinity}), infinity);
  EXPECT_EQ(length({std::numeric_limits<double>::quiet_NaN(), 1}), infinity);
}

}  // namespace
}  // namespace delone::internal
