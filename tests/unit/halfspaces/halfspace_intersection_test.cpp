// SPDX-License-Identifier: BSD-3-Clause
// Intersections that rows are added to: all of them or none, also where they raise the rank or leave nothing
// inside.
#include <delone/halfspaces.hpp>

#include "error_code.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace delone::halfspaces {
namespace {

using test::code_of;
using ::testing::ElementsAre;
using HalfspaceRows = std::vector<double>;

/// |x| ≤ 1 and |y| ≤ 1.
const HalfspaceRows square{1, 0, -1, -1, 0, -1, 0, 1, -1, 0, -1, -1};
constexpr double inf = std::numeric_limits<double>::infinity();

TEST(HalfspaceIntersection, WhatIsRefusedLeavesItAsItWas) {
  HalfspaceIntersection<> box(square, 2);
  const std::vector<double> vertices = box.data().vertices;
  EXPECT_EQ(code_of([&] { box.insert_range(HalfspaceRows{1, 0}); }), Errc::bad_dimension);
  EXPECT_EQ(code_of([&] { box.insert_range(HalfspaceRows{1, 0, inf}); }), Errc::not_finite);
  // The interior point is on or beyond these.
  EXPECT_EQ(code_of([&] { box.insert_range(HalfspaceRows{1, 1, -1, 1, 0, 5}); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { box.insert_range(HalfspaceRows{0, 0, 1}); }), Errc::invalid_argument);
  EXPECT_EQ(box.num_halfspaces(), 4u);
  EXPECT_EQ(box.data().vertices, vertices);
  EXPECT_EQ(box.volume().value, 4);
  box.insert_range(HalfspaceRows{1, 0, -0.5, 0, 0, -1});  // x ≤ 1/2, and one that all points satisfy
  EXPECT_EQ(box.volume().value, 3);
  EXPECT_EQ(box.count(HalfspaceKind::trivial), 1u);
  EXPECT_EQ(box.count(HalfspaceKind::redundant), 1u);
}

TEST(HalfspaceIntersection, SharedArraysStayAsTheyAre) {
  HalfspaceIntersection<> box(square, 2);
  const std::shared_ptr<const IntersectionData> before = box.shared_data();
  const std::vector<double> vertices = before->vertices;
  EXPECT_EQ(before.get(), &box.data());
  box.insert_range(HalfspaceRows{1, 0, -0.5});
  EXPECT_EQ(before->vertices, vertices);
  EXPECT_NE(box.shared_data()->vertices, vertices);
}

TEST(HalfspaceIntersection, NoVolumeIsLeftBetweenTwoDoubles) {
  // 1 + 4/7·u < x < 1 + 4/5·u with u = 2⁻⁵²: all of it rounds to 1 + u.
  const HalfspaceRows thin{-7, 0, 7 + 0x1p-50, 5, 0, -(5 + 0x1p-50), 0, 1, -1, 0, -1, 0};
  const HalfspaceIntersection<> sliver(thin, 2);
  EXPECT_EQ(sliver.state(), IntersectionState::full);
  EXPECT_EQ(sliver.num_vertices(), 4u);
  EXPECT_EQ(sliver.volume().value, 0);
}

TEST(HalfspaceIntersection, ErrorsNameTheRowsThatAreAdded) {
  HalfspaceIntersection<> box(square, 2, std::vector<double>{0, 0});
  try {
    box.insert_range(HalfspaceRows{1, 0, -2, 1, 1, 0, 0, 0, 3});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.rows(), ElementsAre(1, 2)) << error.what();
  }
  EXPECT_EQ(box.num_halfspaces(), 4u);
}

TEST(HalfspaceIntersection, RowsMayRaiseTheRank) {
  HalfspaceIntersection<> strip(HalfspaceRows{1, 0, -1, -1, 0, -1}, 2, std::vector<double>{0, 0});
  EXPECT_EQ(strip.rank(), 1);
  EXPECT_FALSE(strip.is_bounded());
  EXPECT_EQ(strip.volume().value, inf);
  strip.insert(std::vector<double>{1, 0, -0.5});  // not this one
  EXPECT_EQ(strip.rank(), 1);
  strip.insert_range(HalfspaceRows{0, 1, -1, 0, -1, -1});
  EXPECT_EQ(strip.rank(), 2);
  EXPECT_EQ(strip.volume().value, 3);
}

TEST(HalfspaceIntersection, OfNoNormalIsEverythingOrNothing) {
  const HalfspaceIntersection<> everything(HalfspaceRows{0, 0, -1, 0, 0, 0}, 2);
  EXPECT_EQ(everything.state(), IntersectionState::full);
  EXPECT_EQ(everything.rank(), 0);
  EXPECT_EQ(everything.num_cells(), 0u);
  const HalfspaceIntersection<> nothing(HalfspaceRows{1, 0, -1, 0, 0, 2, 0, 0, 1}, 2);
  EXPECT_EQ(nothing.state(), IntersectionState::empty);
  EXPECT_THAT(nothing.witness(), ElementsAre(1)) << "the first one that no point satisfies";
  EXPECT_EQ(nothing.volume().value, 0);
}

TEST(HalfspaceIntersection, WithoutInteriorRowsAreSearchedAgain) {
  HalfspaceIntersection<> flat(HalfspaceRows{1, 0, 0, -1, 0, 0}, 2);  // x = 0
  EXPECT_EQ(flat.state(), IntersectionState::flat);
  flat.insert_range(HalfspaceRows{0, 1, -1});
  EXPECT_EQ(flat.state(), IntersectionState::flat);
  flat.insert_range(HalfspaceRows{1, 0, 1});  // x ≤ −1
  EXPECT_EQ(flat.state(), IntersectionState::empty);
  EXPECT_EQ(flat.num_halfspaces(), 4u);
  EXPECT_EQ(flat.volume().value, 0);
  EXPECT_EQ(flat.statistics().insertions, 0u);
}

TEST(HalfspaceIntersection, InteriorPointsAreChecked) {
  EXPECT_EQ(code_of([] { HalfspaceIntersection<>(square, 2, std::vector<double>{0}); }), Errc::bad_dimension);
  EXPECT_EQ(code_of([] {
              HalfspaceIntersection<>(square, 2, std::vector<double>{0, inf});
            }),
            Errc::not_finite);
  EXPECT_EQ(code_of([] {
              HalfspaceIntersection<>(square, 2, std::vector<double>{1, 0});
            }),
            Errc::invalid_argument)
      << "on a line";
}

}  // namespace
}  // namespace delone::halfspaces
