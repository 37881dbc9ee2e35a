// SPDX-License-Identifier: BSD-3-Clause
#include "engine/work_ranges.hpp"

#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace delone::engine {
namespace {

TEST(WorkRanges, StretchesAreConsecutive) {
  WorkRanges ranges(2);
  ranges.assign(10, 15);
  std::size_t number = 0;
  for (const std::size_t expected : {10u, 11u}) {
    ASSERT_TRUE(ranges.next(0, number));
    EXPECT_EQ(number, expected);
  }
  ASSERT_TRUE(ranges.next(1, number));
  EXPECT_EQ(number, 12u);
  ASSERT_TRUE(ranges.next(0, number)) << "the back half of the other's 13, 14";
  EXPECT_EQ(number, 14u);
  ASSERT_TRUE(ranges.next(0, number));
  EXPECT_EQ(number, 13u);
  EXPECT_FALSE(ranges.next(0, number));
  EXPECT_FALSE(ranges.next(1, number));
}

TEST(WorkRanges, EveryNumberOnceForAnyNumberOfWorkers) {
  for (const unsigned workers : {1u, 3u, 8u}) {
    WorkRanges ranges(workers);
    std::vector<std::atomic<int>> taken(5000);
    for (int round = 0; round < 2; ++round) {
      ranges.assign(0, taken.size());
      internal::run_workers(workers, [&](unsigned worker) {
        for (std::size_t number = 0; ranges.next(worker, number);) ++taken[number];
      });
      for (const auto& count : taken) ASSERT_EQ(count, round + 1);
    }
  }
}

}  // namespace
}  // namespace delone::engine
