// SPDX-License-Identifier: BSD-3-Clause
#include "base/arithmetic.hpp"

#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cfenv>
#include <limits>
#include <stdexcept>

namespace delone::internal {
namespace {

class RoundsUpward : public testing::Test {
 protected:
  RoundsUpward() { std::fesetround(FE_UPWARD); }
  ~RoundsUpward() override { std::fesetround(FE_TONEAREST); }
};

TEST_F(RoundsUpward, TheScopeRoundsToNearest) {
  {
    const ArithmeticScope scope;
    EXPECT_EQ(std::fegetround(), FE_TONEAREST);
    volatile double one = 1;
    EXPECT_EQ(one + std::numeric_limits<double>::min(), 1.0);
  }
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
}

TEST_F(RoundsUpward, AnExceptionEndsTheScope) {
  try {
    const ArithmeticScope scope;
    throw std::runtime_error("");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
}

TEST_F(RoundsUpward, FunctionsOfTheUserRunInTheStateOfTheCaller) {
  const ArithmeticScope outer;
  const ArithmeticScope inner;  // changes nothing
  {
    const CallersArithmetic caller;
    EXPECT_EQ(std::fegetround(), FE_UPWARD);
    {
      const ArithmeticScope nested;  // of the library, called by such a function
      EXPECT_EQ(std::fegetround(), FE_TONEAREST);
      const CallersArithmetic again;
      EXPECT_EQ(std::fegetround(), FE_UPWARD);
    }
    EXPECT_EQ(std::fegetround(), FE_UPWARD);
  }
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

TEST_F(RoundsUpward, WhatTheUserSetsLastsUntilItsFunctionReturns) {
  {
    const ArithmeticScope scope;
    {
      const CallersArithmetic caller;
      std::fesetround(FE_DOWNWARD);
    }
    EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  }
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
}

TEST(CallersArithmetic, OutsideOfScopesItChangesNothing) {
  {
    const CallersArithmetic caller;
    EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  }
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

TEST(CallersArithmetic, WhatTheUserSetsDoesNotReachTheLibrary) {
  const ArithmeticScope scope;
  {
    const CallersArithmetic caller;
    std::fesetround(FE_UPWARD);
  }
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

TEST_F(RoundsUpward, WorkersRoundToNearest) {
  std::atomic<int> num_right = 0;
  run_workers(4, [&](unsigned) { num_right += std::fegetround() == FE_TONEAREST ? 1 : 0; });
  EXPECT_EQ(num_right, 4);
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
}

}  // namespace
}  // namespace delone::internal
