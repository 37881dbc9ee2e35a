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

/// A model whose cost is the fraction to a power.
CostModel model_of(double exponent) {
  return [=](double f) { return WholeCost{1e9 * std::pow(f, exponent), std::pow(f, exponent), 1.2, 1.5}; };
}

TEST(BuildLimits, AModelIsContinuedFromWhatHasPassed) {
  constexpr double before = 5e8;
  for (const double times : {0.5, 1.0, 3.0}) {
    std::vector<Passed> passed = grown_like(2, 0.3);
    for (Passed& p : passed) p.seconds *= times, p.bytes = before + times * p.bytes;
    const WholeCost whole = extrapolated(passed, model_of(2), before);
    EXPECT_NEAR(whole.seconds, times, 1e-6);
    EXPECT_NEAR(whole.bytes, before + times * 1e9, 1);
    EXPECT_LT(whole.bytes_factor, 1.2);
  }
  // Where it grows otherwise than the model says, both are in the range.
  const std::vector<Passed> passed = grown_like(2, 0.3);
  const double at_last = passed.back().bytes, stretch = 1 / passed.back().fraction;
  const WholeCost whole = extrapolated(passed, model_of(1.5), 0);
  for (const double exponent : {1.5, 2.0}) {
    EXPECT_LT(whole.bytes / whole.bytes_factor, at_last * std::pow(stretch, exponent));
    EXPECT_GT(whole.bytes * whole.bytes_factor, at_last * std::pow(stretch, exponent));
  }
}

TEST(BuildLimits, TheModelAloneTellsWhereLittleHasPassed) {
  for (const std::vector<Passed>& passed :
       {std::vector<Passed>{}, std::vector<Passed>{{0.001, 7, 1e9}}, std::vector<Passed>{{0.5, 1e-3, 1e6}}}) {
    const WholeCost whole = extrapolated(passed, model_of(2), 1e6);
    EXPECT_EQ(whole.bytes, 1.001e9);
    EXPECT_EQ(whole.seconds, 1);
    EXPECT_EQ(whole.bytes_factor, 1.2);
    EXPECT_EQ(whole.seconds_factor, 1.5);
  }
}

/// As where a model changes from one algorithm to another.
TEST(BuildLimits, AModelThatGrowsLateOrFallsGivesNumbers) {
  const std::vector<Passed> passed = grown_like(2, 0.3);
  const double last = passed.back().fraction;
  for (const double early : {0.0, -1.0}) {
    const CostModel model = [=](double f) {
      const double cost = f >= last ? f : early * f;
      return WholeCost{1e9 * cost, cost, 1.2, 1.5};
    };
    const WholeCost whole = extrapolated(passed, model, 0);
    EXPECT_NEAR(whole.bytes, passed.back().bytes / last, 1) << early;
    EXPECT_NEAR(whole.seconds, passed.back().seconds / last, 1e-9) << early;
    EXPECT_TRUE(std::isfinite(whole.bytes_factor) && std::isfinite(whole.seconds_factor)) << early;
  }
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
  limits.set_model([](double) { return WholeCost{7e15, 240, 2, 3}; });
  limits.count_items(false);
  const Error error = error_of(limits);
  EXPECT_THAT(error.what(),
              HasSubstr("while cells were made; the whole would have taken about 7 PB (3.5 PB to 14 PB) and "
                        "about 4 minutes (80 seconds to 12 minutes)"));
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
  limits.set_model([](double) { return WholeCost{1e12, 240, 1.5, 1.5}; });
  limits.count_items(false);
  EXPECT_THAT(error_of(limits).what(),
              HasSubstr(" TB) and about 4 minutes (2.7 minutes to 6 minutes), for which "
                        "a limit of memory of 1.5 TB would do"));
  if (platform::resident_memory() == 0) GTEST_SKIP() << "the system does not tell the memory in use";
  BuildLimits low(3'000'000, 0, "points");
  low.set_model([](double) { return WholeCost{0, 1}; });
  low.count_items(false);
  const std::string text = error_of(low).what();
  EXPECT_THAT(text, HasSubstr("stopped at the limit of 3 MB while cells were made"));
  const double whole = std::stod(text.substr(text.find("about ") + 6));
  const double limit = std::stod(text.substr(text.find("limit of memory of ") + 19));
  // Both have two digits, and so are off by up to 5 %.
  const double least = 0.95 * whole;
  EXPECT_GT(1.05 * limit, least + std::min(least / 7, 64.0)) << text;
}

TEST(BuildLimits, FailedAllocationsAreExplained) {
  BuildLimits limits(std::size_t{1} << 50, 0, "points");
  EXPECT_THROW(limits.guard([] { throw std::bad_alloc(); }), Error);
  BuildLimits none(0, 0, "points");
  EXPECT_THROW(none.guard([] { throw std::bad_alloc(); }), std::bad_alloc);
}

}  // namespace
}  // namespace delone::internal
