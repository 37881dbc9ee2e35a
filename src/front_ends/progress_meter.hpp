// SPDX-License-Identifier: BSD-3-Clause
// Calls the user's progress function now and then, and turns its `false` into Errc::cancelled.
#pragma once

#include <delone/error.hpp>

#include <chrono>
#include <cstddef>
#include <functional>

namespace delone::front_ends {

class ProgressMeter {
 public:
  ProgressMeter(const std::function<bool(double)>& callback, std::size_t total) : callback_(callback), total_(total) {}

  void operator()(std::size_t done) {
    if (!callback_ || Clock::now() - last_ < std::chrono::milliseconds(20)) return;
    last_ = Clock::now();
    if (!callback_(total_ == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(total_)))
      throw Error(Errc::cancelled, "cancelled by the progress callback");
  }

 private:
  using Clock = std::chrono::steady_clock;
  const std::function<bool(double)>& callback_;
  std::size_t total_;
  Clock::time_point last_{};
};

}  // namespace delone::front_ends
