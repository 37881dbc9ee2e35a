// SPDX-License-Identifier: BSD-3-Clause
// The map from the plane to a picture: its larger side is 1000 units, y points up, and no box overflows.
#include "io/complexes/picture_frame.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace delone::io {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

TEST(PictureFrame, PlacesTheCornersOfABox) {
  const PictureFrame wide({-1, 2}, {3, 4}, 10);
  EXPECT_THAT(wide.place(-1, 2), ElementsAre(20, 520));
  EXPECT_THAT(wide.place(3, 4), ElementsAre(1020, 20));
  EXPECT_THAT(wide.place(1, 3), ElementsAre(520, 270));
  const PictureFrame tall({0, 0}, {1, 2}, 10);
  EXPECT_THAT(tall.place(1, 0), ElementsAre(520, 1020));
}

TEST(PictureFrame, OfFlatAndOfHugeBoxes) {
  EXPECT_THAT(PictureFrame({5, 5}, {5, 5}, 1).place(5, 5), ElementsAre(20, 20)) << "one point";
  EXPECT_THAT(PictureFrame({0, 7}, {4, 7}, 2).place(4, 7), ElementsAre(1020, 20));
  constexpr double largest = std::numeric_limits<double>::max();
  const PictureFrame huge({-largest, -largest}, {largest, largest}, 2);
  EXPECT_THAT(huge.place(largest, largest), ElementsAre(1020, 20));
  EXPECT_THAT(huge.place(0, 0), ElementsAre(DoubleNear(520, 1e-9), DoubleNear(520, 1e-9)));
}

TEST(PictureFrame, LinesAreThinnerForMorePoints) {
  const auto stroke = [](std::size_t count) { return PictureFrame({0, 0}, {1, 1}, count).stroke(); };
  EXPECT_EQ(stroke(0), 1.5);
  EXPECT_EQ(stroke(1599), 0.5);
  EXPECT_EQ(stroke(100000000), 0.1);
}

}  // namespace
}  // namespace delone::io
