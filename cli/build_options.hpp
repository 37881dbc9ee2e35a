// SPDX-License-Identifier: BSD-3-Clause
// The options of all commands that build something: where the result goes, how to build it, what to report.
#pragma once

#include "command.hpp"
#include "output.hpp"
#include "progress_bar.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace delone::cli {

struct BuildOptions {
  std::string output, output_format;
  std::string qhull;  ///< outputs in the form of Qhull, instead of a format
  std::uint64_t seed = 0;
  std::string order = "automatic";
  unsigned threads = 0;
  bool stats = false, quiet = false, force = false;
  std::uint64_t memory = 0;  ///< 0: not given
  double time = 0;           ///< seconds; 0: not given

  /// --output, --output-format and --force. `what` names the result, as in "the hull".
  void add_output(CLI::App& command, const std::string& what, const std::vector<std::string>& formats);
  /// --qhull. `program` is the one of Qhull, `names` its outputs that there are. After add_output().
  void add_qhull(CLI::App& command, const std::string& program, const std::string& names);
  /// --seed, --order, --memory, --time, --stats and --quiet. `what` is built; `beyond`: what happens beyond
  /// the memory.
  void add_construction(CLI::App& command, const std::string& what = "the triangulation",
                        const std::string& beyond = "the command ends");
  /// --memory, --time and --quiet.
  void add_limits(CLI::App& command, const std::string& what, const std::string& beyond = "the command ends");

  /// Where the command writes: the result, `others`, and the report: with --stats, or if nothing else is
  /// written.
  std::vector<Output> outputs(std::vector<Output> others = {}) const;
  /// The options for the library. They refer to the bar.
  Options to_options(ProgressBar& bar) const;
};

/// --threads.
void add_threads(CLI::App& command, unsigned& threads);

}  // namespace delone::cli
