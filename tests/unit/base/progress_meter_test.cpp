// SPDX-License-Identifier: BSD-3-Clause
#include "base/progress_meter.hpp"

#include <delone/progress.hpp>

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <stdexcept>
#include <thread>
#include <vector>

namespace delone::internal {
namespace {

TEST(ProgressMeter, WithoutACallbackDoesNothing) {
  const std::function<bool(double)> none;
  ProgressMeter meter(none, 10);
  for (std::size_t i = 0; i < 1000; ++i) meter(i);
}

TEST(ProgressMeter, ReportsTheShareThatIsDone) {
  std::vector<double> shares;
  const std::function<bool(double)> callback = [&](double share) { return shares.push_back(share), true; };
  {
    ProgressMeter meter(callback, 8);
    meter(2);
  }
  ASSERT_EQ(shares, std::vector<double>{0.25});
  ProgressMeter of_nothing(callback, 0);
  of_nothing(0);
  ASSERT_EQ(shares.back(), 1.0);
}

TEST(ProgressMeter, CallsNowAndThen) {
  int calls = 0;
  const std::function<bool(double)> callback = [&](double) { return ++calls, true; };
  ProgressMeter meter(callback, 100);
  const auto start = std::chrono::steady_clock::now();
  int rounds = 0;
  while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(70)) meter(1), ++rounds;
  EXPECT_GE(calls, 2);
  EXPECT_LE(calls, 5) << rounds;
}

TEST(ProgressMeter, ReportsEverySlowStep) {
  int calls = 0;
  const std::function<bool(double)> callback = [&](double) { return ++calls, true; };
  ProgressMeter meter(callback, 3);
  for (int i = 1; i <= 3; ++i) {
    meter(1);
    EXPECT_EQ(calls, i);
    std::this_thread::sleep_for(std::chrono::milliseconds(21));
  }
}

TEST(ProgressMeter, FalseCancels) {
  const std::function<bool(double)> callback = [](double) { return false; };
  ProgressMeter meter(callback, 8);
  try {
    meter(1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::cancelled);
  }
}

/// Rounds that each look at the clock.
void slow_rounds(int count) {
  for (int i = 0; i < count; ++i) {
    cancellation_point();
    std::this_thread::sleep_for(std::chrono::milliseconds(21));
  }
}

TEST(ProgressMeter, InnerLoopsAskTheMeterOfTheThread) {
  cancellation_point();  // without a meter
  std::vector<double> shares;
  const std::function<bool(double)> callback = [&](double share) { return shares.push_back(share), true; };
  {
    ProgressMeter meter(callback, 4);
    meter(1);
    slow_rounds(4);
    std::thread other([] { slow_rounds(3); });
    other.join();
  }
  slow_rounds(3);
  EXPECT_GE(shares.size(), 2u);
  EXPECT_LE(shares.size(), 5u);
  for (const double share : shares) EXPECT_EQ(share, 0.25);
}

TEST(ProgressMeter, OneWithoutAFunctionCountsForTheOneAround) {
  std::vector<double> shares;
  const ProgressScope scope([&](double share) { return shares.push_back(share), true; });
  const std::function<bool(double)> none;
  ProgressMeter outer(none, 2);
  ProgressMeter inner(none, 100);  // of what the outer one counts
  outer(1);
  inner(99);
  slow_rounds(4);
  ASSERT_GE(shares.size(), 1u);
  for (const double share : shares) EXPECT_EQ(share, 0.5);
}

TEST(ProgressMeter, WithTheSameFunctionItIsAskedOnce) {
  int calls = 0;
  const std::function<bool(double)> callback = [&](double) { return ++calls, true; };
  const ProgressMeter of_all(callback);
  ProgressMeter of_part(callback, 10);
  of_part(1);
  EXPECT_EQ(calls, 1);
}

TEST(ProgressMeter, TheShareDoesNotDecrease) {
  std::vector<double> shares;
  const std::function<bool(double)> callback = [&](double share) { return shares.push_back(share), true; };
  ProgressMeter meter(callback, 4);
  for (const std::size_t done : {2, 1, 3}) {
    meter(done);
    std::this_thread::sleep_for(std::chrono::milliseconds(21));
  }
  EXPECT_EQ(shares, (std::vector<double>{0.5, 0.5, 0.75}));
}

TEST(ProgressScope, CancelsAndAsksAllAround) {
  int calls = 0;
  const ProgressScope scope([&](double) { return ++calls < 2; });
  const std::function<bool(double)> goes_on = [](double) { return true; };
  ProgressMeter meter(goes_on, 1);
  EXPECT_THROW(slow_rounds(5), Error);
  EXPECT_EQ(calls, 2);
}

TEST(ProgressScope, TheFunctionMayUseTheLibraryAndThrow) {
  const ProgressScope scope([](double) -> bool {
    delone::cancellation_point();  // asks nobody
    throw std::runtime_error("from the function");
  });
  EXPECT_THROW(delone::cancellation_point(), std::runtime_error);
}

}  // namespace
}  // namespace delone::internal
