// SPDX-License-Identifier: BSD-3-Clause
#include "base/require_tolerance.hpp"

#include <delone/error.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace delone::internal {
namespace {

void expect_refusal(const std::function<void()>& f, const std::string& text) {
  try {
    f();
    FAIL() << text;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::invalid_argument);
    EXPECT_THAT(error.what(), testing::HasSubstr(text));
  }
}

TEST(RequireTolerance, IsAFiniteDistance) {
  for (const double tolerance : {0.0, 1e-300, 1e300}) EXPECT_NO_THROW(require_tolerance(tolerance));
  expect_refusal([] { require_tolerance(-0.5); }, "the tolerance is -0.5");
  expect_refusal([] { require_tolerance(std::nan("")); }, "the tolerance is nan");
  expect_refusal([] { require_tolerance(std::numeric_limits<double>::infinity()); }, "the tolerance is inf");
}

TEST(RequireTolerance, IsNotLargerThanTheSet) {
  const double nan = std::nan("");
  const std::vector<double> points{1, 5, nan, nan, 2, 8}, more{1, 1};
  EXPECT_NO_THROW(require_tolerance_within(3, points, 2));
  expect_refusal([&] { require_tolerance_within(3.5, points, 2); },
                 "the tolerance, 3.5, is larger than the set of points, whose longest side is 3");
  EXPECT_NO_THROW(require_tolerance_within(7, points, 2, more));
  expect_refusal([&] { require_tolerance_within(7.5, points, 2, more); }, "7.5");
}

TEST(RequireTolerance, CountsWhereAxesAreScaled) {
  const std::vector<double> points{1, 5, 2, 8}, huge{1, 0x1p1000, 2, 0};
  EXPECT_NO_THROW(require_tolerance_within(12, points, 2, {}, std::vector<double>{1, 4}));
  expect_refusal(
      [&] {
        require_tolerance_within(12.5, points, 2, {}, std::vector<double>{1, 4});
      },
      "whose longest side is 12");
  expect_refusal(
      [&] {
        require_tolerance_within(1, huge, 2, {}, std::vector<double>{1, 0x1p60});
      },
      "differ too much for coordinates as large as those of axis 1");
}

TEST(RequireTolerance, OfOnePointMayBeAny) {
  EXPECT_NO_THROW(require_tolerance_within(7, std::vector<double>{1, 5}, 2));
  EXPECT_NO_THROW(require_tolerance_within(7, std::vector<double>{1, 5, 1, 5}, 2));
  EXPECT_NO_THROW(require_tolerance_within(7, {}, 2));
}

TEST(RefuseTolerance, OfWhatHasNone) {
  const std::vector<double> some{0.5, 0.5};
  EXPECT_NO_THROW(refuse_tolerance(0, {}, "triangulations"));
  expect_refusal([] { refuse_tolerance(1, {}, "triangulations"); }, "triangulations have no tolerance");
  expect_refusal([&] { refuse_tolerance(0, some, "triangulations"); }, "triangulations have no tolerance");
  EXPECT_NO_THROW(refuse_axis_tolerances({}, "lower hulls"));
  expect_refusal([&] { refuse_axis_tolerances(some, "lower hulls"); }, "lower hulls have one tolerance");
}

}  // namespace
}  // namespace delone::internal
