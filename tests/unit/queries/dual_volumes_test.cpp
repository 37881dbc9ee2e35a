// SPDX-License-Identifier: BSD-3-Clause
#include "queries/dual_volumes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace delone::queries {
namespace {

using kernel::Integer;
using ::testing::ElementsAre;

// Sites at −2 and 4, the query at 0: its region is from −1 to 2, and 1 is between those of the sites.
TEST(DualVolumes, OfALine) {
  const ZoneSphere sphere{1, 3, {1, 2, 0, 2, 0, 1}, {1, -1, 1}};
  const int axes[] = {0};
  const std::vector<double> x = {1, 2, -1};
  DualVolumes<double> rounded;
  rounded.compute(sphere, axes, 1, x.data(), 0x1p-50, true);
  const double sign = rounded.volumes[0] < 0 ? 1 : -1;
  EXPECT_EQ(rounded.volumes[0] * sign, -3);
  EXPECT_EQ(rounded.volumes[1] * sign, 2);
  EXPECT_EQ(rounded.volumes[2] * sign, 1);
  EXPECT_EQ(rounded.moments[1] * sign, -1);
  EXPECT_EQ(rounded.moments[2] * sign, 4);
  for (const double error : rounded.errors) EXPECT_TRUE(error >= 0x1p-50 && error < 0x1p-46);
}

// The query in the middle of a square with corners (±2, ±2), in both numbers. The centers of the new cells
// are (±2, 0) and (0, ±2), that of both cells of the zone is the query; each corner loses a square of which
// half is the cone of the facet between. Which diagonal divides the square makes no difference.
TEST(DualVolumes, OfASquare) {
  const int axes[] = {0, 1};
  // 1: (−2, −2), 2: (2, −2), 3: (2, 2), 4: (−2, 2).
  const ZoneSphere diagonal_13{
      2, 5, {1, 2, 3, 1, 3, 4, 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 1, 4}, {1, 1, -1, -1, -1, 1}};
  const ZoneSphere diagonal_24{
      2, 5, {1, 2, 4, 2, 3, 4, 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 1, 4}, {1, 1, -1, -1, -1, 1}};
  const std::vector<Integer> x = {0, 0, 0, 0, 0, -2, 2, 0, 0, 2, -2, 0};
  for (const ZoneSphere* sphere : {&diagonal_13, &diagonal_24}) {
    DualVolumes<Integer> exact;
    exact.compute(*sphere, axes, 2, x.data(), Integer(0), true);
    const Integer sign = exact.volumes[0] < 0 ? 1 : -1;
    for (Integer& v : exact.volumes) v *= sign;
    EXPECT_THAT(exact.volumes, ElementsAre(-16, 4, 4, 4, 4));
    EXPECT_THAT(exact.errors, ElementsAre(0, 0, 0, 0, 0));
    // The corners of the facet towards vertex 3 are (2, 0) and (0, 2), and twice the area of its cone is 4.
    EXPECT_EQ(exact.moments[6] * sign, 8);
    EXPECT_EQ(exact.moments[7] * sign, 8);
    std::vector<double> rounded_x;
    for (const Integer& value : x) rounded_x.push_back(static_cast<double>(value));
    DualVolumes<double> rounded;
    rounded.compute(*sphere, axes, 2, rounded_x.data(), 0x1p-50, false);
    for (std::size_t v = 0; v < 5; ++v) {
      EXPECT_EQ(rounded.volumes[v] * static_cast<double>(sign), static_cast<double>(exact.volumes[v]));
      EXPECT_LT(rounded.errors[v], 0x1p-42);
    }
  }
}

// With so many vertices that a face is no longer packed into one key, the same as with few.
TEST(DualVolumes, OfManyVertices) {
  ZoneSphere sphere{4, 6, {1, 2, 3, 4, 5}, {1}};
  for (std::uint32_t without = 1; without <= 5; ++without) {
    sphere.cells.push_back(0);
    for (std::uint32_t v = 1; v <= 5; ++v)
      if (v != without) sphere.cells.push_back(v);
    sphere.signs.push_back(without % 2 == 1 ? -1 : 1);
  }
  const int axes[] = {0, 1, 2, 3};
  std::vector<Integer> x;
  for (int i = 0; i < 24; ++i) x.push_back(i * i % 17 - 8);
  DualVolumes<Integer> few, many;
  few.compute(sphere, axes, 4, x.data(), Integer(1), true);
  sphere.num_vertices = std::size_t{1} << 17;
  many.compute(sphere, axes, 4, x.data(), Integer(1), true);
  many.volumes.resize(6);
  many.errors.resize(6);
  many.moments.resize(24);
  EXPECT_EQ(few.volumes, many.volumes);
  EXPECT_EQ(few.errors, many.errors);
  EXPECT_EQ(few.moments, many.moments);
  EXPECT_NE(few.volumes[0], 0);
}

// What moved corners change is within the bound.
TEST(DualVolumes, ErrorsBoundTheEffectOfDelta) {
  const int axes[] = {0, 1};
  const ZoneSphere sphere{
      2, 5, {1, 2, 3, 1, 3, 4, 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 1, 4}, {1, 1, -1, -1, -1, 1}};
  const std::vector<Integer> x = {0, 0, 0, 0, 0, -2000, 2000, 0, 0, 2000, -2000, 0};
  DualVolumes<Integer> before, after;
  before.compute(sphere, axes, 2, x.data(), Integer(2), false);
  for (unsigned pattern = 0; pattern < 4096; pattern += 7) {
    std::vector<Integer> moved = x;
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += (pattern >> i & 1) != 0 ? 1 : -1;
    after.compute(sphere, axes, 2, moved.data(), Integer(0), false);
    for (std::size_t v = 0; v < 5; ++v)
      EXPECT_LE(abs(after.volumes[v] - before.volumes[v]), before.errors[v]);
  }
}

}  // namespace
}  // namespace delone::queries
