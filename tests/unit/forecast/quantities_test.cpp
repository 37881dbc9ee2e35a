// SPDX-License-Identifier: BSD-3-Clause
// From costs to forecasts: ranges that contain what is expected, whole numbers, and no infinities.
#include "forecast/quantities.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace delone::cost_model {
namespace {

TEST(Quantities, RangesAreTheFactorsOfTheUncertainty) {
  Cost cost;
  cost.affine_dimension = 3;
  cost.vertices = 100.4;
  cost.cells = 600.5;
  cost.bytes = 1e7;
  cost.seconds = 2;
  const Forecast one = as_forecast(cost, 3, 100, 1, {.cells = 2, .speed = 1.5});
  EXPECT_EQ(one.threads, 1u);
  EXPECT_EQ(one.vertices.expected, 100);
  EXPECT_EQ(one.vertices.low, 100);
  EXPECT_EQ(one.vertices.high, 101);
  EXPECT_EQ(one.cells.low, 300);
  EXPECT_EQ(one.cells.high, 1201);
  EXPECT_DOUBLE_EQ(one.bytes.low, 1e7 / 2.2);
  EXPECT_DOUBLE_EQ(one.bytes.high, 2.2e7 + 1e6) << "and some pages";
  EXPECT_DOUBLE_EQ(one.seconds.expected, 2);
  EXPECT_DOUBLE_EQ(one.seconds.low, 2.0 / 3);
  EXPECT_DOUBLE_EQ(one.seconds.high, 6);
}

TEST(Quantities, ManyThreadsMayShareAllOfTheWork) {
  EXPECT_EQ(speedup(0), 1);
  EXPECT_EQ(speedup(1), 1);
  EXPECT_GT(speedup(2), 1.3);
  EXPECT_LT(speedup(1000), 3);
  Cost cost;
  cost.affine_dimension = 3;
  cost.seconds = 8;
  const Forecast four = as_forecast(cost, 3, 1000000, 4, {.cells = 1, .speed = 1});
  ASSERT_EQ(four.threads, 4u);
  EXPECT_DOUBLE_EQ(four.seconds.expected, 8 / speedup(4));
  EXPECT_DOUBLE_EQ(four.seconds.low, 2);
}

TEST(Quantities, WhatIsNoNumberIsVeryLarge) {
  Cost cost;
  cost.cells = std::numeric_limits<double>::infinity();
  cost.bytes = std::numeric_limits<double>::quiet_NaN();
  cost.seconds = 1e300;
  const Forecast found = as_forecast(cost, 30, 10, 1, {});
  for (const ForecastQuantity& quantity : {found.cells, found.bytes, found.seconds}) {
    EXPECT_EQ(quantity.expected, 1e300);
    EXPECT_TRUE(std::isfinite(quantity.high));
    EXPECT_LE(quantity.low, quantity.expected);
  }
}

}  // namespace
}  // namespace delone::cost_model
