// SPDX-License-Identifier: BSD-3-Clause
#include "base/parallel_parts.hpp"

#include <delone/progress.hpp>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace delone::internal {
namespace {

TEST(ParallelParts, CoverEveryNumberOnce) {
  for (const unsigned threads : {0u, 1u, 2u, 3u, 8u})
    for (const std::size_t size : {0u, 1u, 9u, 10u, 11u, 1000u}) {
      std::vector<std::atomic<int>> visits(size);
      for_parts(threads, size, 10, [&](std::size_t first, std::size_t last, const StopPoint& stop) {
        EXPECT_EQ(first % 10, 0u);
        EXPECT_TRUE(last == first + 10 || last == size);
        stop();
        for (std::size_t i = first; i < last; ++i) ++visits[i];
      });
      for (const auto& count : visits) EXPECT_EQ(count, 1);
    }
}

TEST(ParallelParts, EachThreadHasItsOwnWork) {
  std::atomic<int> made = 0;
  work_in_parts(3, 100, 1, [&] {
    ++made;
    return [thread = std::this_thread::get_id()](std::size_t, std::size_t, const StopPoint&) {
      EXPECT_EQ(thread, std::this_thread::get_id());
    };
  });
  EXPECT_GE(made, 1);
  EXPECT_LE(made, 3);
}

TEST(ParallelParts, OneThreadForFewParts) {
  EXPECT_EQ(threads_for_parts(1, 100), 1u);
  EXPECT_EQ(threads_for_parts(8, 1), 1u);
  EXPECT_EQ(threads_for_parts(0, 3), 1u);
  EXPECT_EQ(threads_for_parts(8, 5), threads_to_use(5));
}

/// The exception that work in parts ends with; part 3 takes long before it throws.
template <class Throw>
std::string failure(unsigned threads, Throw throw_in) {
  try {
    for_parts(threads, 40, 1, [&](std::size_t part, std::size_t, const StopPoint& stop) {
      if (part == 3) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      throw_in(part);
      stop();
    });
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(ParallelParts, TheExceptionIsThatOfTheFirstPartThatThrows) {
  for (int round = 0; round < 5; ++round)
    for (const unsigned threads : {1u, 2u, 3u, 8u})
      EXPECT_EQ(failure(threads,
                        [](std::size_t part) {
                          if (part >= 3) throw std::runtime_error(std::to_string(part));
                        }),
                "3");
}

TEST(ParallelParts, LaterPartsStopAtOnce) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THROW(for_parts(4, 8, 1,
                         [&](std::size_t part, std::size_t, const StopPoint& stop) {
                           if (part == 0) throw std::runtime_error("0");
                           const auto now = [] { return std::chrono::steady_clock::now(); };
                           while (now() - begin < std::chrono::seconds(20)) stop();
                         }),
               std::runtime_error);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST(ParallelParts, TheCallingThreadCancelsWhileItWaits) {
  const std::thread::id caller = std::this_thread::get_id();
  const auto begin = std::chrono::steady_clock::now();
  if (threads_for_parts(2, 2) != 2) GTEST_SKIP() << "no threads in this build";
  std::atomic<bool> others_run = false;
  const auto make = [&] {
    return [&](std::size_t, std::size_t, const StopPoint& stop) {
      const auto is_late = [&] {
        return std::chrono::steady_clock::now() - begin > std::chrono::seconds(20);
      };
      if (std::this_thread::get_id() == caller) {
        while (!others_run && !is_late()) std::this_thread::yield();
        return;
      }
      others_run = true;
      while (!is_late()) stop();
    };
  };
  try {
    const ProgressScope scope([&](double) {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      return false;
    });
    work_in_parts(2, 2, 1, make);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::cancelled);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST(ParallelParts, CancellationAndLimitsStopEarlierPartsToo) {
  const std::thread::id caller = std::this_thread::get_id();
  const auto begin = std::chrono::steady_clock::now();
  for (const Errc code : {Errc::cancelled, Errc::time_limit, Errc::out_of_memory}) try {
      for_parts(2, 200, 1, [&](std::size_t part, std::size_t, const StopPoint& stop) {
        if (std::this_thread::get_id() == caller && part > 0) throw Error(code, "enough");
        if (std::this_thread::get_id() == caller) return;
        while (std::chrono::steady_clock::now() - begin < std::chrono::seconds(20)) stop();
      });
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
    }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

}  // namespace
}  // namespace delone::internal
