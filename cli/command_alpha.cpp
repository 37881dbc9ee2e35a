// SPDX-License-Identifier: BSD-3-Clause
// delone alpha: points in, the cells or the boundary of their alpha complex below a radius out.
#include "interrupt.hpp"
#include "memory_limit.hpp"
#include "report.hpp"
#include "weighted_input.hpp"

#include <delone/alpha.hpp>
#include <delone/data.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace delone::cli {
namespace {

struct AlphaCommandOptions {
  WeightedInput weighted;
  BuildOptions build;
  std::optional<double> radius, squared_radius;
  bool boundary = false;
};

template <class Product>
int make_complex(Product triangulation, const AlphaCommandOptions& options,
                 const std::vector<std::string>& column_names, Clock::time_point start, Cost cost) {
  const BuildOptions& build = options.build;
  const std::string name = input_name(options.weighted.input.path);
  triangulation.sort_cells();  // what is written does not depend on the threads
  auto stage_start = Clock::now();
  const AlphaComplex complex = about(name, [&] {
    ProgressBar bar(build.quiet);
    const StageGuard guard(Stage::building);
    const Execution how{.threads = build.threads, .progress = bar.callback()};
    return options.squared_radius
               ? AlphaComplex::of_squared_radius(triangulation, *options.squared_radius, how)
               : AlphaComplex(triangulation, *options.radius, how);
  });
  const double complex_seconds = seconds_since(stage_start);
  stage_start = Clock::now();
  const bool writes = !build.output.empty();
  if (writes) {
    ComplexData data = options.boundary ? complex.boundary_data() : complex.to_data();
    data.column_names = column_names;
    write_output(build.output, data, build.output_format);
  }
  cost.write = seconds_since(stage_start);
  cost.close(start);
  const std::size_t k = static_cast<std::size_t>(std::max(complex.affine_dimension(), 1)),
                    singular = complex.singular_facets().size() / k;
  const auto counts = [&] { return counts_of(triangulation, triangulation.hash().hex()); };
  print_report(
      build, writes,
      [&] {
        Json json = stats_of("alpha", counts());
        json["radius"] = options.radius ? number(*options.radius) : Json(nullptr);
        json["squared_radius"] = options.squared_radius ? number(*options.squared_radius) : Json(nullptr);
        json["alpha_cells"] = complex.cell_numbers().size();
        json["boundary_facets"] = complex.boundary_cells().size();
        json["singular_facets"] = singular;
        add_cost(json, triangulation.statistics(), triangulation.num_all_cells(), cost, build.seed);
        json["seconds"]["alpha"] = complex_seconds;
        return json;
      },
      [&] {
        const Counts all = counts();
        Summary text(options.weighted.input.path, fmt::format("alpha complex of {} in dimension {}",
                                                              counted(all.points, "point"), all.dimension));
        text.line(options.radius ? "radius" : "squared radius",
                  fmt::format("{}", options.radius ? *options.radius : *options.squared_radius));
        text.line("cells", fmt::format("{} of {}", complex.cell_numbers().size(), all.cells));
        text.line("boundary facets", fmt::format("{}", complex.boundary_cells().size()));
        text.line("singular facets", fmt::format("{}", singular));
        return text.cost(triangulation.statistics(), cost);
      });
  return exit_status::ok;
}

int run_alpha(const AlphaCommandOptions& options) {
  const BuildOptions& build = options.build;
  if (options.radius.has_value() == options.squared_radius.has_value())
    throw UsageError("alpha: either --radius or --squared-radius is needed");
  if (options.radius && !(*options.radius >= 0))
    throw UsageError("--radius: a number of at least 0 was expected");
  if (options.squared_radius && !(*options.squared_radius == *options.squared_radius))
    throw UsageError("--squared-radius: a number was expected");
  protect_files({options.weighted.input.path, options.weighted.weights}, build.outputs(), build.force);
  const MemoryLimit limit(input_name(options.weighted.input.path), build.memory);
  const auto start = Clock::now();
  Cost cost;
  std::vector<double> weights;
  const bool weighted = !options.weighted.weights.empty();
  PointTable table =
      weighted ? options.weighted.read(weights, build.threads) : options.weighted.input.read(build.threads);
  cost.read = seconds_since(start);
  if (!build.output.empty()) check_complex_output(build.output, build.output_format, table.dimension);
  const auto build_start = Clock::now();
  const auto make = [&](auto construct) {
    return about(input_name(options.weighted.input.path), [&] {
      ProgressBar bar(build.quiet);
      const StageGuard guard(Stage::building);
      return construct(build.to_options(bar));
    });
  };
  if (weighted) {
    auto t =
        make([&](const Options& o) { return Regular<>(table.coordinates, weights, table.dimension, o); });
    cost.build = seconds_since(build_start);
    return make_complex(std::move(t), options, table.column_names, start, cost);
  }
  auto t =
      make([&](const Options& o) { return Delaunay<>(std::move(table.coordinates), table.dimension, o); });
  cost.build = seconds_since(build_start);
  return make_complex(std::move(t), options, table.column_names, start, cost);
}

}  // namespace

Run add_alpha(CLI::App& app) {
  auto options = std::make_shared<AlphaCommandOptions>();
  options->weighted.add_to(app, false);
  app.add_option("--radius", options->radius,
                 "The radius: take the faces with an empty sphere of at most this radius")
      ->type_name("R");
  app.add_option("--squared-radius", options->squared_radius,
                 "The square of the radius instead; may be negative with weights")
      ->type_name("S");
  app.add_flag("--boundary", options->boundary,
               "Write the facets that enclose the cells, oriented outward, instead of the cells");
  options->build.add_output(app, "the cells of the complex, or its boundary", complex_formats());
  add_threads(app, options->build.threads);
  options->build.add_construction(app);
  return [options] { return run_alpha(*options); };
}

}  // namespace delone::cli
