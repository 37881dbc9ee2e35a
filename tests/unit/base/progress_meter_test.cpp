// SPDX-License-Identifier: BSD-3-Clause
#include "base/progress_meter.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
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
  ProgressMeter meter(callback, 8);
  meter(2);
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

}  // namespace
}  // namespace delone::internal
