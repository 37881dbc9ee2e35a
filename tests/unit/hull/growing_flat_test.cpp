// SPDX-License-Identifier: BSD-3-Clause
#include "hull/growing_flat.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace delone::hull {
namespace {

using ::testing::ElementsAre;

TEST(GrowingFlat, TakesTheFarthestEachTime) {
  for (const double scale : {1.0, 0x1p-1060, 0x1p1020}) {
    std::vector<double> x{0, 0, 0, 1, 0, 0, 4, 1, 0, 2, 3, 0, 2, 1, 1};
    for (double& each : x) each *= scale;
    const auto point = [&](std::size_t i) { return x.data() + 3 * i; };
    GrowingFlat flat({point(0), point(1), point(2), point(3), point(4)}, 3);
    EXPECT_EQ(flat.farthest(), point(2));
    flat.grow();
    EXPECT_EQ(flat.farthest(), point(3));
    EXPECT_THAT(flat.axes(), ElementsAre(0));
    flat.grow();
    EXPECT_EQ(flat.farthest(), point(4));
    EXPECT_THAT(flat.axes(), ElementsAre(0, 1));
    EXPECT_THAT(flat.basis(), ElementsAre(point(0), point(2), point(3)));
  }
}

TEST(GrowingFlat, OfCoincidentPointsHasNoLength) {
  const std::vector<double> x{1, 2, 1, 2};
  GrowingFlat flat({x.data(), x.data() + 2}, 2);
  flat.grow();
  EXPECT_THAT(flat.axes(), ElementsAre(0));
}

}  // namespace
}  // namespace delone::hull
