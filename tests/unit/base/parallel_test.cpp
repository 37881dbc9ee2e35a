// SPDX-License-Identifier: BSD-3-Clause
#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace delone::internal {
namespace {

TEST(Parallel, CountsCores) {
  EXPECT_GE(num_cores(), 1u);
  EXPECT_EQ(threads_to_use(1), 1u);
  const unsigned all = threads_to_use(0);
  EXPECT_TRUE(all == num_cores() || all == 1);
  EXPECT_TRUE(threads_to_use(5) == 5 || threads_to_use(5) == 1) << "without threads it is one";
}

TEST(Parallel, ReadsQuotas) {
  EXPECT_EQ(cores_of_quota("max 100000"), std::nullopt);
  EXPECT_EQ(cores_of_quota("-1 100000"), std::nullopt);
  EXPECT_EQ(cores_of_quota(""), std::nullopt);
  EXPECT_EQ(cores_of_quota(" "), std::nullopt);
  EXPECT_EQ(cores_of_quota("100000"), std::nullopt);
  EXPECT_EQ(cores_of_quota("100000 0"), std::nullopt);
  EXPECT_EQ(cores_of_quota("200000 100000"), 2u);
  EXPECT_EQ(cores_of_quota("399999 100000"), 3u);
  EXPECT_EQ(cores_of_quota("10000 100000"), 1u);
}

TEST(Parallel, EveryWorkerRunsOnce) {
  for (const unsigned n : {1u, 2u, 8u, 40u}) {
    std::vector<std::atomic<int>> runs(n);
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<bool> first_is_here = false;
    run_workers(n, [&](unsigned worker) {
      ++runs[worker];
      if (worker == 0) first_is_here = std::this_thread::get_id() == caller;
    });
    for (const auto& count : runs) EXPECT_EQ(count, 1);
    EXPECT_TRUE(first_is_here);
  }
}

TEST(Parallel, PassesOnAnExceptionWhenAllHaveEnded) {
  std::atomic<int> ended = 0;
  EXPECT_THROW(run_workers(4,
                           [&](unsigned worker) {
                             ++ended;
                             if (worker % 2 == 1) throw std::runtime_error("odd");
                           }),
               std::runtime_error);
  EXPECT_EQ(ended, 4);
}

TEST(Parallel, ForCoversEveryNumberOnce) {
  for (const std::size_t size : {0u, 1u, 99u, 100u, 101u}) {
    std::vector<std::atomic<int>> visits(size);
    parallel_for(3, size, 10, [&](std::size_t first, std::size_t last) {
      EXPECT_LE(last - first, 10u);
      for (std::size_t i = first; i < last; ++i) ++visits[i];
    });
    for (const auto& count : visits) EXPECT_EQ(count, 1);
  }
}

TEST(Parallel, ForBeginsNoPartAfterAnException) {
  std::atomic<int> parts = 0;
  EXPECT_THROW(parallel_for(1, 100, 1,
                            [&](std::size_t first, std::size_t) {
                              ++parts;
                              if (first == 7) throw std::runtime_error("seven");
                            }),
               std::runtime_error);
  EXPECT_EQ(parts, 8);
}

TEST(Parallel, WorksInsideOfItself) {
  std::atomic<int> runs = 0;
  run_workers(3, [&](unsigned) { run_workers(3, [&](unsigned) { ++runs; }); });
  EXPECT_EQ(runs, 9);
}

}  // namespace
}  // namespace delone::internal
