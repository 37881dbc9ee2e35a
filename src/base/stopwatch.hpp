// SPDX-License-Identifier: BSD-3-Clause
// Measures wall-clock time.
#pragma once

#include <chrono>
#include <utility>

namespace delone::internal {

class Stopwatch {
 public:
  /// Seconds since construction or the last restart().
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  /// The same; starts again.
  double restart() {
    const Clock::time_point now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace delone::internal
