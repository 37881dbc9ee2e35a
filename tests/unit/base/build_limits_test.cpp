// SPDX-License-Identifier: BSD-3-Clause
#include "base/build_limits.hpp"

#include "base/platform.hpp"

#include <delone/error.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <string>
#include <thread>

namespace delone::internal {
namespace {

using ::testing::HasSubstr;

/// Costs f^p seconds and 1e9·f^p bytes, from f = 0.01 on.
std::vector<Passed> grown_like(double exponent, double last) {
  std::vector<Passed> passed;
  for (double f = 0.01; f < last; f *= 1.05)
    passed.push_back({f, std::pow(f, exponent), 1e9 * std::pow(f, exponent)});
  return passed;
}

TEST(BuildLimits, ThePowerOfTheGrowthIsContinued) {
  for (const double exponent : {1.0, 1.5, 3.0}) {
    const WholeCost whole = extrapolated(grown_like(exponent, 0.6));
    EXPECT_NEAR(whole.seconds, 1, 0.05) << exponent;
    EXPECT_NEAR(whole.bytes, 1e9, 5e7) << exponent;
  }
  EXPECT_LT(extrapolated(grown_like(3, 0.5), false).bytes, 0.3e9);
  EXPECT_EQ(extrapolated({}).seconds, 0);
  EXPECT_EQ(extrapolated({{0.001, 1, 1}}).seconds, 0);
}

TEST(BuildLimits, WhatHasHardlyChangedGoesOnAsItWas) {
  std::vector<Passed> passed;
  for (double f = 0.01; f < 0.1; f *= 1.05)
    passed.push_back({f, 0.01 * std::pow(f / 0.1, 4), 1e8 + 1e6 * std::pow(f / 0.1, 4)});
  const WholeCost whole = extrapolated(passed);
  EXPECT_LT(whole.seconds, 0.11);
  EXPECT_LT(whole.bytes, 1.12e8);
}

TEST(BuildLimits, BadTimesAreErrors) {
  for (const double bad :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    try {
      const BuildLimits limits(0, bad, "points");
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Errc::invalid_argument);
      EXPECT_THAT(error.what(), HasSubstr("the limit of time is "));
    }
}

/// What a loop of 100 rounds throws that takes some milliseconds a round.
Error error_of(BuildLimits& limits) {
  const std::function<bool(double)> nobody;
  try {
    limits.guard([&] {
      ProgressMeter meter(nobody, 100);
      for (std::size_t done = 1; done <= 100; ++done) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        meter(done);
      }
    });
  } catch (const Error& error) {
    return error;
  }
  return {Errc::unsupported, "nothing"};
}

TEST(BuildLimits, TheMessageSaysHowFarItCameAndWhatTheWholeTakes) {
  BuildLimits limits(0, 0.1, "points");
  const Error error = error_of(limits);
  EXPECT_EQ(error.code(), Errc::time_limit);
  EXPECT_THAT(error.what(), HasSubstr("stopped at the limit of 0.1 seconds with "));
  EXPECT_THAT(error.what(), HasSubstr(" % of the points inserted; the whole would have taken about "));
}

TEST(BuildLimits, AModelTellsWhereTheFractionDoesNot) {
  BuildLimits limits(0, 0.05, "points");
  limits.set_model([] { return WholeCost{7e15, 240}; });
  limits.count_items(false);
  const Error error = error_of(limits);
  EXPECT_THAT(error.what(),
              HasSubstr("while cells were made; the whole would have taken about 7 PB and 4 minutes"));
}

TEST(BuildLimits, MemoryThatTheProcessHasAlreadyIsAnError) {
  if (platform::resident_memory() == 0) GTEST_SKIP() << "the system does not tell the memory in use";
  BuildLimits limits(1000, 0, "points");
  const Error error = error_of(limits);
  EXPECT_EQ(error.code(), Errc::out_of_memory);
  EXPECT_THAT(error.what(), HasSubstr("stopped at the limit of 1 kB"));
}

// Such a limit is one that would not have been reached.
TEST(BuildLimits, TheMessageTellsALimitOfMemoryThatWouldDo) {
  BuildLimits limits(std::size_t{1} << 40, 0.03, "points");
  limits.set_model([] { return WholeCost{1e12, 240}; });
  limits.count_items(false);
  EXPECT_THAT(error_of(limits).what(), HasSubstr(" TB and 4 minutes, for which a limit of memory of 1"));
  if (platform::resident_memory() == 0) GTEST_SKIP() << "the system does not tell the memory in use";
  BuildLimits low(3'000'000, 0, "points");
  low.set_model([] { return WholeCost{0, 1}; });
  low.count_items(false);
  const std::string text = error_of(low).what();
  EXPECT_THAT(text, HasSubstr("stopped at the limit of 3 MB while cells were made"));
  const double whole = std::stod(text.substr(text.find("about ") + 6));
  const double limit = std::stod(text.substr(text.find("limit of memory of ") + 19));
  EXPECT_GT(limit, whole + std::min(whole / 7, 64.0) - 1) << text;
}

TEST(BuildLimits, FailedAllocationsAreExplained) {
  BuildLimits limits(std::size_t{1} << 50, 0, "points");
  EXPECT_THROW(limits.guard([] { throw std::bad_alloc(); }), Error);
  BuildLimits none(0, 0, "points");
  EXPECT_THROW(none.guard([] { throw std::bad_alloc(); }), std::bad_alloc);
}

}  // namespace
}  // namespace delone::internal
