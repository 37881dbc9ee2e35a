// SPDX-License-Identifier: BSD-3-Clause
#include "base/coarse_clock.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace delone::platform {
namespace {

TEST(CoarseClock, GoesOnWithinSomeMilliseconds) {
  using std::chrono::milliseconds;
  const auto begin = coarse_now();
  std::this_thread::sleep_for(milliseconds(30));
  const auto end = coarse_now();
  EXPECT_GE(end - begin, milliseconds(15));
  EXPECT_LT(end - begin, milliseconds(5000));
  EXPECT_GE(coarse_now(), end);
}

}  // namespace
}  // namespace delone::platform
