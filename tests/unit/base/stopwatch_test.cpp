// SPDX-License-Identifier: BSD-3-Clause
#include "base/stopwatch.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace delone::internal {
namespace {

TEST(Stopwatch, CountsFromTheLastStart) {
  Stopwatch watch;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_GE(watch.seconds(), 0.02);
  const double first = watch.restart(), second = watch.seconds();
  EXPECT_GE(first, 0.02);
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_GE(watch.restart(), second + 0.001);
  Stopwatch other;
  other.restart();
  EXPECT_LT(other.seconds(), first + 60);
}

}  // namespace
}  // namespace delone::internal
