// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/period.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace delone::periodic {
namespace {

TEST(Period, GradientsAreDualToTheVectors) {
  const Period period({1, 0, 0.25, 0.5, 2, 0}, 2, 3);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t l = 0; l < 2; ++l)
      EXPECT_NEAR(period.fraction(i, period.vector(l)), i == l ? 1 : 0,
                  period.fraction_slack(i, period.vector(l)));
  const std::vector<double> normal{-0.5, 0.125, 2};  // orthogonal to both
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(period.fraction(i, normal.data()), 0, period.fraction_slack(i, normal.data()));
}

TEST(Period, FloorsAreExact) {
  const Period period({3, 1, -1, 3}, 2, 2);
  for (int a = -3; a <= 3; ++a)
    for (int b = -3; b <= 3; ++b) {
      const double x[] = {3.0 * a - b, 1.0 * a + 3 * b};
      EXPECT_EQ(period.floor_of_fraction(0, x), a);
      EXPECT_EQ(period.floor_of_fraction(1, x), b);
      const double less[] = {std::nextafter(x[0], -100), x[1]};
      EXPECT_EQ(period.floor_of_fraction(0, less), a - 1);
      EXPECT_EQ(period.floor_of_fraction(1, less), b);  // the second fraction grows as x falls
    }
}

TEST(Period, TheReachOfACubeIsTwo) {
  const Period period({1, 0, 0, 0, 1, 0, 0, 0, 1}, 3, 3);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(period.reach(i), 2);
  double x[] = {0.25, 0.5, 0.75};
  period.translate(std::vector<std::int32_t>{2, 0, -1}, x);
  EXPECT_EQ(x[0], 2.25);
  EXPECT_EQ(x[1], 0.5);
  EXPECT_EQ(x[2], -0.25);
}

}  // namespace
}  // namespace delone::periodic
