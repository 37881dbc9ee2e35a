// SPDX-License-Identifier: BSD-3-Clause
// The final report of commands that build something: one JSON object with --stats, otherwise a summary. Both
// have one shape, whatever was built.
#pragma once

#include "build_options.hpp"
#include "cost.hpp"
#include "output.hpp"

#include <delone/delone.hpp>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>

namespace delone::cli {

using Json = nlohmann::ordered_json;

/// The number, or null if it is not finite, which JSON cannot express.
Json number(double x);

/// Lines of text; names of columns need not be UTF-8.
inline std::string as_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// The members of --stats about points and cells, in this order.
struct Counts {
  int dimension = 0, affine_dimension = -1;
  std::size_t points = 0, vertices = 0, duplicates = 0;
  std::size_t cells = 0, infinite_cells = 0;
  std::string hash;
};
Counts counts_of(const Triangulation& triangulation, std::string hash);
Counts counts_of(const ConvexHullBase& hull);
/// The number of rows that are neither vertices nor duplicates of one.
inline std::size_t num_hidden(const Counts& counts) {
  return counts.points - counts.vertices - counts.duplicates;
}

/// The first members of --stats: `command` and those of `counts`.
Json stats_of(const char* command, const Counts& counts);
/// Adds the last members, from `seconds` to `version`. `num_cells` includes infinite cells.
void add_cost(Json& json, const Statistics& statistics, std::size_t num_cells, const Cost& cost,
              std::uint64_t seed);

/// All members of --stats for a triangulation.
Json stats_of(const char* command, const Counts& counts, const Statistics& statistics, const Cost& cost,
              std::uint64_t seed);

/// A summary: a title, then lines of a name and a value.
class Summary {
 public:
  /// "INPUT: TITLE"
  Summary(const std::string& input, const std::string& title)
      : text_(input_name(input) + ": " + title + "\n") {}

  Summary& line(const std::string& name, const std::string& value);
  /// k, and what k < d means, as in "flat: triangulated inside its flat".
  Summary& affine_dimension(int k, int d, const std::string& if_flat);
  /// The counts of a triangulation.
  Summary& triangulation(const Counts& counts);
  /// Conflict tests, times, peak memory.
  Summary& cost(const Statistics& statistics, const Cost& cost);

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Prints stats() with --stats; otherwise summary(), unless a result was written.
template <class MakeStats, class MakeSummary>
void print_report(const BuildOptions& options, bool has_written, MakeStats stats, MakeSummary summary) {
  if (options.stats)
    print_output(as_text(stats()));
  else if (!has_written)
    print_output(Summary(summary()).text());
}

}  // namespace delone::cli
