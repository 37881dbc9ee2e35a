// SPDX-License-Identifier: BSD-3-Clause
// What a run has cost: the part of --stats and of summaries that all commands which build something share.
#pragma once

#include <delone/delone.hpp>

#include <nlohmann/json_fwd.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

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
  double build = 0;  ///< ordering included
  double write = 0;
  double total = 0;
  std::size_t peak_rss_bytes = 0;
};

/// Adds the members of --stats from `cost` to `version`. `num_cells`: infinite ones included.
void add_cost(nlohmann::ordered_json& json, const Statistics& statistics, std::size_t num_cells,
              const Cost& cost, std::uint64_t seed);

/// The value of --order.
InsertionOrder insertion_order(const std::string& name);

}  // namespace delone::cli
