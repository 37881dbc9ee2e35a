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
  EXPECT_GE(watch.restart(), 0.02);
  // Not so much any more, but for a thread that was interrupted just now.
  bool has_restarted = false;
  for (int i = 0; i < 100 && !has_restarted; ++i) {
    watch.restart();
    has_restarted = watch.seconds() < 0.02;
  }
  EXPECT_TRUE(has_restarted);
}

}  // namespace
}  // namespace delone::internal
