// SPDX-License-Identifier: BSD-3-Clause
#include "base/require_finite.hpp"

#include <delone/error.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace delone::internal {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double largest = std::numeric_limits<double>::max();
constexpr double least = std::numeric_limits<double>::denorm_min();

TEST(RequireFinite, AcceptsFiniteNumbers) {
  EXPECT_NO_THROW(require_finite({}, 3, "a coordinate"));
  EXPECT_NO_THROW(require_finite(std::vector<double>{largest, -largest, least, -0.0}, 2, "a coordinate"));
}

TEST(RequireFinite, NamesTheRow) {
  for (const double bad : {nan, infinity, -infinity}) {
    try {
      require_finite(std::vector<double>{1, 2, 3, bad, 5, 6}, 2, "the weight", "site");
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Errc::not_finite);
      EXPECT_THAT(error.what(), testing::HasSubstr("the weight of site 1 is not finite"));
      EXPECT_THAT(error.rows(), testing::ElementsAre(1));
    }
  }
}

TEST(RequireFinite, NamesEveryRowOnce) {
  try {
    require_finite(std::vector<double>{nan, nan, 3, 4, 5, infinity, nan, 8}, 2, "a coordinate");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("a coordinate of point 0 is not finite (and of 2 more)"));
    EXPECT_THAT(error.rows(), testing::ElementsAre(0, 2, 3));
  }
}

}  // namespace
}  // namespace delone::internal
