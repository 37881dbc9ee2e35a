// SPDX-License-Identifier: BSD-3-Clause
// delone regular: weighted points in, regular triangulation out, and what it cost.
#include "command.hpp"
#include "cost.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "progress_bar.hpp"
#include "weighted_input.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace delone::cli {
namespace {

struct RegularOptions {
  WeightedInput input;
  std::string output, output_format;
  std::uint64_t seed = 0;
  bool stats = false, quiet = false;
};

nlohmann::ordered_json stats_json(const RegularTriangulation& t, const Cost& cost, std::uint64_t seed) {
  const Statistics s = t.statistics();
  const std::size_t num_cells = t.complex().num_cells();
  nlohmann::ordered_json json;
  json["command"] = "regular";
  json["dimension"] = t.dimension();
  json["affine_dimension"] = t.affine_dimension();
  json["points"] = t.num_points();
  json["vertices"] = t.num_vertices();
  json["duplicates"] = t.num_duplicates();
  json["hidden"] = t.num_hidden();
  json["cells"] = t.num_finite_cells();
  json["infinite_cells"] = t.num_infinite_cells();
  json["hash"] = t.hash().hex();
  add_cost(json, s, num_cells, cost, seed);
  return json;
}

std::string summary(const RegularTriangulation& t, const Cost& cost, const std::string& name) {
  const Statistics s = t.statistics();
  std::string text = fmt::format("{}: regular triangulation of {} weighted points in dimension {}\n", name,
                                 t.num_points(), t.dimension());
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<18}{}\n", what, value);
  };
  line("affine dimension",
       fmt::format("{}{}", t.affine_dimension(),
                   t.affine_dimension() < 0               ? " (no points)"
                   : t.affine_dimension() < t.dimension() ? " (flat: triangulated inside its flat)"
                                                          : ""));
  line("vertices", fmt::format("{} ({} hidden, {} duplicate points)", t.num_vertices(), t.num_hidden(),
                               t.num_duplicates()));
  line("cells", fmt::format("{}, and {} hull facets", t.num_finite_cells(), t.num_infinite_cells()));
  line("hash", t.hash().hex());
  line("conflict tests",
       fmt::format("{} by filter, {} direct, {} exact, {} ties", s.filter, s.direct, s.exact, s.perturbed));
  line("time", fmt::format("{:.3f} s (reading {:.3f}, ordering {:.3f}, building {:.3f})", cost.total,
                           cost.read, s.order_seconds, cost.build - s.order_seconds));
  line("peak memory", fmt::format("{:.1f} MB", static_cast<double>(cost.peak_rss_bytes) / 1e6));
  return text;
}

int run_regular(const RegularOptions& options) {
  if (options.stats && options.output == "-")
    throw UsageError("--stats and --output - both want standard output");
  const auto start = Clock::now();
  Cost cost;
  std::vector<double> weights;
  const PointTable table = options.input.read(weights);
  cost.read = seconds_since(start);
  if (!options.output.empty()) check_complex_output(options.output, options.output_format, table.dimension);

  auto stage_start = Clock::now();
  const std::string name = input_name(options.input.input.path);
  const RegularTriangulation triangulation = about(name, [&] {
    ProgressBar bar(options.quiet);
    const StageGuard guard(Stage::building);
    Options build_options;
    build_options.seed = options.seed;
    build_options.progress = bar.callback();
    return RegularTriangulation(table.coordinates, weights, table.dimension, build_options);
  });
  cost.build = seconds_since(stage_start);

  stage_start = Clock::now();
  if (!options.output.empty())
    write_complex_output(options.output, triangulation.to_data(), options.output_format);
  cost.write = seconds_since(stage_start);
  cost.close(start);
  if (options.stats)
    print_output(stats_json(triangulation, cost, options.seed).dump(2) + "\n");
  else if (options.output.empty())
    print_output(summary(triangulation, cost, name));
  return exit_status::ok;
}

}  // namespace

Run add_regular(CLI::App& app) {
  auto options = std::make_shared<RegularOptions>();
  options->input.add_to(app);
  app.add_option("-o,--output", options->output,
                 "Write the triangulation there; without it a summary is printed")
      ->type_name("OUT");
  app.add_option("--output-format", options->output_format, "Format of OUT, if not told by its extension")
      ->check(CLI::IsMember(complex_formats()));
  add_seed(app, options->seed, "Seed of the insertion order; the result does not depend on it");
  app.add_flag("--stats", options->stats,
               "Print one JSON object about the result and its cost, and nothing else");
  app.add_flag("-q,--quiet", options->quiet, "No progress bar, no notes");
  return [options] { return run_regular(*options); };
}

}  // namespace delone::cli
