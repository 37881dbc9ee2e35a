// SPDX-License-Identifier: BSD-3-Clause
#include "build_options.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace delone::cli {
namespace {

/// The values of --order.
constexpr std::array<std::pair<const char*, InsertionOrder>, 3> insertion_orders{
    {{"automatic", InsertionOrder::automatic},
     {"as_given", InsertionOrder::as_given},
     {"shuffled", InsertionOrder::shuffled}}};

}  // namespace

void BuildOptions::add_output(CLI::App& command, const std::string& what,
                              const std::vector<std::string>& formats) {
  command.add_option("-o,--output", output, "Write " + what + " there; without it a summary is printed")
      ->type_name("OUT");
  command
      .add_option("--output-format", output_format,
                  "Format of OUT, if not told by its extension; to_meshio() in Python has more")
      ->check(CLI::IsMember(formats))
      ->needs("--output");
  add_force(command, force);
}

void BuildOptions::add_qhull(CLI::App& command, const std::string& program, const std::string& names) {
  command
      .add_option("--qhull", qhull,
                  "Write what " + program + " prints for these options, to OUT or standard output: " + names)
      ->type_name("o,Fv,...")
      ->excludes("--output-format");
  command.parse_complete_callback([this] {
    if (!qhull.empty() && output.empty()) output = "-";
  });
}

void BuildOptions::add_limits(CLI::App& command, const std::string& what, const std::string& beyond) {
  add_size(command, "--memory", memory, "The most memory to use, such as 2G: beyond it " + beyond, 1);
  add_duration(
      command, "--time", time,
      "The most time to build " + what + ", such as 90 (seconds), 10m or 2h: beyond it the command ends");
  command.add_flag("-q,--quiet", quiet, "No progress bar, no notes");
}

void BuildOptions::add_construction(CLI::App& command, const std::string& what, const std::string& beyond) {
  std::vector<std::string> names;
  for (const auto& [name, unused] : insertion_orders) names.push_back(name);
  add_seed(command, seed, "Seed of the insertion order; the result does not depend on it");
  command.add_option("--order", order, "Insertion order; the result does not depend on it")
      ->check(CLI::IsMember(names));
  command.add_flag("--stats", stats, "Print one JSON object about the result and its cost, and nothing else");
  add_limits(command, what, beyond);
}

void add_threads(CLI::App& command, unsigned& threads) {
  command
      .add_option("--threads", threads,
                  "The most threads to use; 0: one per core if the work is large enough")
      ->check(CLI::Range(0, 65536));
}

std::vector<Output> BuildOptions::outputs(std::vector<Output> others) const {
  std::vector<Output> all{{"--output", output}};
  all.insert(all.end(), others.begin(), others.end());
  const bool writes = std::any_of(all.begin(), all.end(), [](const Output& to) { return !to.path.empty(); });
  if (stats || !writes) all.push_back({stats ? "--stats" : "the summary", "-"});
  return all;
}

Options BuildOptions::to_options(ProgressBar& bar) const {
  Options options;
  options.seed = seed;
  for (const auto& [name, value] : insertion_orders)
    if (order == name) options.order = value;
  options.threads = threads;
  options.progress = bar.callback();
  options.memory_limit = memory;
  options.time_limit = time;
  return options;
}

}  // namespace delone::cli
