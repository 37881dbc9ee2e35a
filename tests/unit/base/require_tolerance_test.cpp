// SPDX-License-Identifier: BSD-3-Clause
#include "base/require_tolerance.hpp"

#include <delone/error.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace delone::internal {
namespace {

TEST(RequireTolerance, IsAFiniteDistance) {
  for (const double tolerance : {0.0, 1e-300, 1e300}) EXPECT_NO_THROW(require_tolerance(tolerance, "a test"));
  for (const double tolerance : {-1e-300, std::nan(""), std::numeric_limits<double>::infinity()}) {
    try {
      require_tolerance(tolerance, "a test");
      FAIL() << tolerance;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Errc::invalid_argument);
      EXPECT_NE(std::string(error.what()).find("the tolerance of a test must be"), std::string::npos);
    }
  }
}

TEST(RequireTolerance, IsNotLargerThanTheSet) {
  const double nan = std::nan("");
  const std::vector<double> points{1, 5, nan, nan, 2, 8};
  EXPECT_NO_THROW(require_tolerance_within(3, points, 2, "a test"));
  EXPECT_THROW(require_tolerance_within(3.1, points, 2, "a test"), Error);
  EXPECT_NO_THROW(require_tolerance_within(7, std::vector<double>{1, 5}, 2, "a test"));
  EXPECT_NO_THROW(require_tolerance_within(7, {}, 2, "a test"));
}

}  // namespace
}  // namespace delone::internal
