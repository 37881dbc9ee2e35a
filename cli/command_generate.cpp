// SPDX-License-Identifier: BSD-3-Clause
// delone generate: named point sets, the same bits for the same arguments.
#include "command.hpp"
#include "messages/in_quotes.hpp"
#include "numbers.hpp"
#include "output.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

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

int run_generate(const GenerateOptions& options) {
  const std::size_t n = count_of(options.count);
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

std::size_t count_of(const std::string& text) {
  const std::optional<std::uint64_t> count = parse_count(text);
  if (!count)
    throw UsageError(fmt::format("-n wants a whole number of points, not {}", messages::in_quotes(text)));
  if (*count > std::numeric_limits<std::size_t>::max() || *count == beyond_numbers)
    throw Error(Errc::out_of_memory, fmt::format("not enough memory for {} points", printable(text)));
  return static_cast<std::size_t>(*count);
}

Run add_generate(CLI::App& app) {
  auto options = std::make_shared<GenerateOptions>();
  std::vector<std::string> names;
  std::string footer = "Kinds:\n";
  for (const PointSetKind& kind : point_set_kinds()) {
    names.emplace_back(kind.name);
    footer += fmt::format("  {:<14}{}\n", kind.name, kind.description);
  }
  app.add_option("KIND", options->kind, "The kind of points, listed below")
      ->required()
      ->type_name("")
      ->check(CLI::IsMember(names).description(""));
  app.add_option("-d,--dimension", options->dimension, "Coordinates per point")
      ->required()
      ->check(CLI::Range(1, 1000000));
  app.add_option("-n,--points", options->count, "The number of points, such as 1000 or 1e6")
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
