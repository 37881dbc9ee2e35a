// SPDX-License-Identifier: BSD-3-Clause
// Blocks are prepared and finished in the same order in any number of threads, each part is done once, and
// failures end the whole.
#include "engine/wrap/pipeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace delone::engine {
namespace {

/// Blocks of tokens. Each token is an amount of work left; a block that is finished gives new ones.
class Tokens {
 public:
  std::uint32_t prepare(unsigned block) {
    auto& taken = blocks_[block];
    taken.clear();
    while (!waiting_.empty() && taken.size() < 5) {
      taken.push_back({waiting_.back(), 0});
      waiting_.pop_back();
    }
    log_ += "prepare " + std::to_string(block) + ": " + std::to_string(taken.size()) + "\n";
    return static_cast<std::uint32_t>(taken.size());
  }
  bool do_part(unsigned block, std::uint32_t part, unsigned) {
    ++num_done;
    blocks_[block][part].result += blocks_[block][part].token - 1;
    if (delay_at == num_done) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return num_done != fail_at;
  }
  bool finish(unsigned block) {
    for (const auto& [token, result] : blocks_[block]) {
      log_ += std::to_string(token) + " → " + std::to_string(result) + "\n";
      waiting_.insert(waiting_.end(), static_cast<std::size_t>(std::max(result, 0)), result);
    }
    if (++num_finished == throw_at) throw std::bad_alloc();
    return true;
  }
  void tick() {
    EXPECT_EQ(std::this_thread::get_id(), caller_);
    if (++num_ticks == cancel_at) throw std::runtime_error("cancelled");
  }

  int fail_at = 0, throw_at = 0, cancel_at = 0, delay_at = 0;
  std::atomic<int> num_done = 0;
  int num_finished = 0, num_ticks = 0;
  const std::string& log() const { return log_; }

 private:
  struct Part {
    int token, result;
  };
  std::vector<int> waiting_{6};
  std::vector<Part> blocks_[2];
  std::string log_;
  const std::thread::id caller_ = std::this_thread::get_id();
};

TEST(Pipeline, DoesTheSameInAnyNumberOfThreads) {
  Tokens reference;
  EXPECT_TRUE(Pipeline(reference).run(1));
  EXPECT_EQ(reference.num_done, 1 + 5 + 5 * 4 + 5 * 4 * 3 + 5 * 4 * 3 * 2 + 120);  // 6 gives five times 5, …
  for (const unsigned threads : {2u, 3u, 8u})
    for (int delay_at = 1; delay_at < 60; delay_at += 7) {
      Tokens tokens;
      tokens.delay_at = delay_at;
      EXPECT_TRUE(Pipeline(tokens).run(threads));
      EXPECT_EQ(tokens.num_done, reference.num_done);
      ASSERT_EQ(tokens.log(), reference.log());
    }
}

TEST(Pipeline, EndsWhereAFunctionReturnsFalse) {
  for (const unsigned threads : {1u, 2u, 8u})
    for (const int fail_at : {1, 2, 17, 100}) {
      Tokens tokens;
      tokens.fail_at = fail_at;
      EXPECT_FALSE(Pipeline(tokens).run(threads));
      EXPECT_LT(tokens.num_done, fail_at + 10);
    }
}

TEST(Pipeline, PassesExceptionsOn) {
  for (const unsigned threads : {1u, 2u, 8u}) {
    for (const int at : {1, 2, 9}) {
      Tokens exhausted;
      exhausted.throw_at = at;
      EXPECT_THROW(Pipeline(exhausted).run(threads), std::bad_alloc);
      EXPECT_EQ(exhausted.num_finished, at);
    }
    Tokens cancelled;
    cancelled.cancel_at = 1;
    EXPECT_THROW(Pipeline(cancelled).run(threads), std::runtime_error);
  }
}

TEST(Pipeline, HasNothingToDoWithoutParts) {
  struct Nothing {
    std::uint32_t prepare(unsigned) { return 0; }
    bool do_part(unsigned, std::uint32_t, unsigned) { return false; }
    bool finish(unsigned) { return false; }
    void tick() {}
  };
  Nothing nothing;
  EXPECT_TRUE(Pipeline(nothing).run(1));
  EXPECT_TRUE(Pipeline(nothing).run(3));
}

}  // namespace
}  // namespace delone::engine
