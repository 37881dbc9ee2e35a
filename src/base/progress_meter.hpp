// SPDX-License-Identifier: BSD-3-Clause
// Calls the user's progress function at most every 20 milliseconds, and turns its `false` into
// Errc::cancelled.
#pragma once

#include <delone/error.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>

namespace delone::internal {

class ProgressMeter {
 public:
  ProgressMeter(const std::function<bool(double)>& callback, std::size_t total)
      : callback_(callback), total_(total) {}

  /// Reads the clock less often while calls follow each other within microseconds.
  void operator()(std::size_t done) {
    if (!callback_ || ++calls_ < step_) return;
    calls_ = 0;
    const Clock::time_point now = Clock::now();
    step_ = now - last_look_ < std::chrono::milliseconds(1) ? std::min(2 * step_, longest_step) : 1;
    last_look_ = now;
    if (now - last_call_ < std::chrono::milliseconds(20)) return;
    last_call_ = now;
    if (!callback_(total_ == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(total_)))
      throw Error(Errc::cancelled, "cancelled by the progress callback");
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t longest_step = 64;
  const std::function<bool(double)>& callback_;
  std::size_t total_;
  std::size_t calls_ = 0, step_ = 1;  // since the clock was last read, and from one reading to the next
  Clock::time_point last_look_{}, last_call_{};
};

}  // namespace delone::internal
