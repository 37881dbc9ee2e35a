// SPDX-License-Identifier: BSD-3-Clause
#include "base/axis_scale.hpp"

#include <delone/error.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace delone::internal {
namespace {

using testing::ElementsAre;

AxisScale scale_of(const std::vector<double>& wanted) { return {0, wanted, static_cast<int>(wanted.size())}; }

TEST(AxisScale, OfOneToleranceIsOne) {
  for (const AxisScale& scale : {AxisScale(), AxisScale(0.5), AxisScale(0.5, {}, 3), scale_of({0.5, 0.5}),
                                 scale_of({0, 0, 0}), scale_of({0.5, 0.75})}) {
    EXPECT_TRUE(scale.is_one());
    EXPECT_THAT(scale.factors(), ElementsAre());
    EXPECT_THAT(scale.tolerances(), ElementsAre());
  }
  EXPECT_EQ(AxisScale(0.5, {}, 3).tolerance(), 0.5);
  EXPECT_EQ(scale_of({0.75, 0.5}).tolerance(), 0.5);
}

TEST(AxisScale, MakesTolerancesEqual) {
  const AxisScale scale = scale_of({6, 0.25, 1.25});
  EXPECT_EQ(scale.tolerance(), 4);
  EXPECT_THAT(scale.factors(), ElementsAre(1, 16, 4));
  EXPECT_THAT(scale.tolerances(), ElementsAre(4, 0.25, 1));
  EXPECT_THAT(scale.scaled(std::vector<double>{1, 2, 3, -1, 0, 0.5}), ElementsAre(1, 32, 12, -1, 0, 2));
}

TEST(AxisScale, IsThatOfTheTolerancesThatAreUsed) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> wanted(3);
    for (double& each : wanted) each = std::exp2(exponent(random));
    const AxisScale scale = scale_of(wanted);
    const std::vector<double> used = scale.tolerances();
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_LE(used[j], wanted[j]);
      EXPECT_GT(used[j], wanted[j] / 2);
      EXPECT_GE(scale.factors()[j], 1);
    }
    EXPECT_EQ(scale_of(used).tolerance(), scale.tolerance());
    EXPECT_EQ(scale_of(used).tolerances(), used);
  }
}

TEST(AxisScale, RefusesWhatMeansNothing) {
  const double infinite = HUGE_VAL;
  for (const std::vector<double>& bad :
       {std::vector<double>{1, -1}, {1, infinite}, {1, std::nan("")}, {1, 0}, {0x1p600, 0x1p-600}})
    EXPECT_THROW(scale_of(bad), Error);
  EXPECT_THROW(AxisScale(0, std::vector<double>{1, 1}, 3), Error);
  EXPECT_THROW(AxisScale(-1, {}, 3), Error);
}

}  // namespace
}  // namespace delone::internal
