// SPDX-License-Identifier: BSD-3-Clause
#include "base/quick_rounds.hpp"

#include <delone/progress.hpp>

#include <gtest/gtest.h>

namespace delone::internal {
namespace {

TEST(QuickRounds, Every64thAsks) {
  const ProgressScope scope([](double) { return false; });
  QuickRounds round;
  for (int i = 1; i < 64; ++i) round();
  EXPECT_THROW(round(), Error);
}

}  // namespace
}  // namespace delone::internal
