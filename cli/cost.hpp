// SPDX-License-Identifier: BSD-3-Clause
// The cost of a run: time and memory.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

namespace delone::cli {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start);

/// Times are in seconds.
struct Cost {
  /// Stops the clock. Call it before the hashes of the report, which do not count.
  void close(Clock::time_point start);

  double read = 0;
  double build = 0;               ///< ordering included
  std::optional<double> diagram;  ///< from the triangulation to its diagram
  double write = 0;
  double total = 0;
  std::size_t peak_rss_bytes = 0;
};

}  // namespace delone::cli
