// SPDX-License-Identifier: BSD-3-Clause
// delone regular: weighted points in, regular triangulation out, and what it cost.
#include "interrupt.hpp"
#include "make_tiles.hpp"
#include "memory_limit.hpp"
#include "periodic.hpp"
#include "report.hpp"
#include "weighted_input.hpp"

#include <fmt/format.h>

#include <memory>

namespace delone::cli {
namespace {

struct RegularOptions {
  WeightedInput weighted;
  BuildOptions build;
  TilesInput tiles;
  PeriodicInput periodic;
};

Summary summary(const Regular<>& t, const Counts& counts, const Cost& cost, const RegularOptions& options) {
  return Summary(options.weighted.input.path,
                 fmt::format("regular triangulation of {} in dimension {}",
                             counted(counts.points, "weighted point"), counts.dimension))
      .triangulation(counts)
      .cost(t.statistics(), cost);
}

int run_regular(const RegularOptions& options) {
  const BuildOptions& build = options.build;
  protect_files({options.weighted.input.path, options.weighted.weights}, build.outputs(), build.force);
  MemoryLimit limit(input_name(options.weighted.input.path), build.memory, true);
  const auto start = Clock::now();
  Cost cost;
  std::vector<double> weights;
  const PointTable table = options.weighted.read(weights, build.threads);
  cost.read = seconds_since(start);
  limit.set_points(table);
  if (options.periodic.is_wanted())
    return run_periodic("regular", options.weighted.input, table, &weights, options.periodic, build, start,
                        cost);
  const bool writes = !build.output.empty();
  if (writes) check_complex_output(build.output, build.output_format, table.dimension);

  about(input_name(options.weighted.input.path), [&] { warn_of_memory(table, build); });
  auto stage_start = Clock::now();
  Regular<> triangulation = about(input_name(options.weighted.input.path), [&] {
    ProgressBar bar(build.quiet);
    const StageGuard guard(Stage::building);
    return Regular<>(table.coordinates, weights, table.dimension, build.to_options(bar));
  });
  cost.build = seconds_since(stage_start);

  stage_start = Clock::now();
  if (writes) {
    triangulation.sort_cells();
    ComplexData data = triangulation.to_data();
    data.column_names = table.column_names;
    write_output(build.output, data, build.output_format);
  }
  cost.write = seconds_since(stage_start);
  cost.close(start);
  const auto counts = [&] { return counts_of(triangulation, triangulation.hash().hex()); };
  print_report(
      build, writes,
      [&] { return stats_of("regular", counts(), triangulation.statistics(), cost, build.seed); },
      [&] { return summary(triangulation, counts(), cost, options); });
  return exit_status::ok;
}

}  // namespace

Run add_regular(CLI::App& app) {
  auto options = std::make_shared<RegularOptions>();
  options->weighted.add_to(app);
  options->build.add_output(app, "the triangulation", complex_formats());
  add_threads(app, options->build.threads);
  options->build.add_construction(app, "the triangulation", TilesInput::beyond_memory);
  options->tiles.add_to(app);
  options->periodic.add_to(app);
  return [options, &app] {
    if (options->tiles.wanted(app, options->build.output))
      return run_tiles({"regular", options->weighted.input, options->weighted.column(), options->build,
                        options->tiles, options->periodic.of_tiles(), options->periodic.unit_or_0()});
    return run_regular(*options);
  };
}

}  // namespace delone::cli
