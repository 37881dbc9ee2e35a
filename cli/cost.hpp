// SPDX-License-Identifier: BSD-3-Clause
// What a run has cost: time and memory.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

namespace delone::cli {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start);

/// The threads that do the work, whatever was asked for: this version builds with one.
inline constexpr int threads_used = 1;

/// In seconds, but for memory.
struct Cost {
  /// To be called when all is done but the report: hashes, which are made for it, do not count.
  void close(Clock::time_point start);

  double read = 0;
  double build = 0;               ///< ordering included
  std::optional<double> diagram;  ///< from the triangulation to its diagram
  double write = 0;
  double total = 0;
  std::size_t peak_rss_bytes = 0;
};

}  // namespace delone::cli
