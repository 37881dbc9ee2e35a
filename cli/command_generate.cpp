// SPDX-License-Identifier: BSD-3-Clause
// delone generate: named point sets, the same bits for the same arguments.
#include "command.hpp"
#include "output.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace delone::cli {
namespace {

struct GenerateOptions {
  std::string kind, output = "-", output_format;
  int dimension = 0;
  std::string count;
  std::uint64_t seed = 0;
};

const std::vector<std::string>& point_output_formats() {
  static const std::vector<std::string> formats{"npy", "csv", "tsv", "txt", "xyz", "pts", "off", "qhull"};
  return formats;
}

/// Whole numbers, also written as 1e6.
std::size_t parse_count(const std::string& text) {
  std::size_t used = 0;
  double value = -1;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
  }
  if (used != text.size() || !(value >= 0) || value > 0x1p53 || value != std::trunc(value))
    throw UsageError(fmt::format("-n wants a whole number of points, not {}", in_quotes(text)));
  return static_cast<std::size_t>(value);
}

int run_generate(const GenerateOptions& options) {
  const std::size_t n = parse_count(options.count);
  check_writable(options.output);
  PointTable table;
  table.dimension = options.dimension;
  try {
    table.coordinates = make_point_set(options.kind, options.dimension, n, options.seed);
  } catch (const Error& e) {
    if (e.code() == Errc::invalid_argument) throw UsageError(e.what());
    throw;
  }
  write_output(options.output, table, options.output_format);
  return exit_status::ok;
}

}  // namespace

Run add_generate(CLI::App& app) {
  auto options = std::make_shared<GenerateOptions>();
  std::vector<std::string> names;
  std::string footer = "Kinds:\n";
  for (const PointSetKind& kind : point_set_kinds()) {
    names.emplace_back(kind.name);
    footer += fmt::format("  {:<14}{}\n", kind.name, kind.description);
  }
  app.add_option("KIND", options->kind, "What points; the kinds are listed below")
      ->required()
      ->type_name("")
      ->check(CLI::IsMember(names).description(""));
  app.add_option("-d,--dimension", options->dimension, "Coordinates per point")
      ->required()
      ->check(CLI::Range(1, 1000000));
  app.add_option("-n,--points", options->count, "How many points, as 1000 or 1e6")
      ->required()
      ->type_name("N");
  add_seed(app, options->seed, "Seed: the same arguments make the same points everywhere");
  app.add_option("-o,--output", options->output, "A file; standard output, in Qhull's form, if not given")
      ->type_name("OUT");
  app.add_option("--output-format", options->output_format, "Format of OUT, if not told by its extension")
      ->check(CLI::IsMember(point_output_formats()));
  app.footer(footer);
  return [options] { return run_generate(*options); };
}

}  // namespace delone::cli
