// SPDX-License-Identifier: BSD-3-Clause
// delone density: particles in, their density on a regular grid out.
#include "box_option.hpp"
#include "memory_limit.hpp"
#include "numbers.hpp"
#include "periodic.hpp"
#include "report.hpp"
#include "weighted_input.hpp"

#include <delone/density.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

namespace delone::cli {
namespace {

struct DensityOptions {
  WeightedInput particles{
      .input = {}, .weights = {}, .option = "--masses", .plural = "masses", .singular = "mass"};
  BuildOptions build;
  std::string grid;
  std::size_t samples = 1;
  std::vector<double> box;
  PeriodicInput periodic;
};

const std::vector<std::string>& density_formats() {
  static const std::vector<std::string> formats{"npy", "npz", "csv"};
  return formats;
}

/// Of --grid: one number for all axes, or one for each.
std::vector<std::size_t> chosen_shape(const std::string& text, std::size_t d) {
  std::vector<std::size_t> shape;
  for (const std::string& item : split_list(text)) {
    const auto parts = parse_count(item);
    if (!parts || *parts == 0)
      throw UsageError(fmt::format("--grid {}: expected numbers of parts, at least 1", text));
    shape.push_back(*parts);
  }
  if (shape.size() == 1) shape.resize(d, shape[0]);
  if (shape.size() != d)
    throw UsageError(fmt::format("--grid {}: {} numbers for points of dimension {}", text, shape.size(), d));
  return shape;
}

/// The smallest box with all points.
Box box_of(const PointTable& table) {
  const auto d = static_cast<std::size_t>(table.dimension);
  if (table.num_points() == 0) throw UsageError("--grid without points needs --box");
  Box box{{table.coordinates.begin(), table.coordinates.begin() + static_cast<std::ptrdiff_t>(d)}, {}};
  box.high = box.low;
  for (std::size_t i = 0; i < table.coordinates.size(); ++i) {
    box.low[i % d] = std::min(box.low[i % d], table.coordinates[i]);
    box.high[i % d] = std::max(box.high[i % d], table.coordinates[i]);
  }
  return box;
}

template <class Build>
int run_with(Build build, const DensityGrid& grid, const std::vector<double>& masses, Cost cost,
             Clock::time_point start, const DensityOptions& options) {
  const std::string name = input_name(options.particles.input.path);
  auto stage_start = Clock::now();
  ProgressBar bar(options.build.quiet);
  const auto triangulation = about(name, [&] {
    const StageGuard guard(Stage::building);
    return build(options.build.to_options(bar));
  });
  cost.build = seconds_since(stage_start);

  stage_start = Clock::now();
  const std::vector<double> field = about(name, [&] {
    const StageGuard guard(Stage::building);
    const Execution how{.threads = options.build.threads, .progress = bar.callback()};
    return density_on_grid(triangulation, dtfe_densities(triangulation, masses, how), grid, options.samples,
                           how);
  });
  bar.clear();
  const double seconds = seconds_since(stage_start);

  stage_start = Clock::now();
  {
    const StageGuard guard(stage_of_writing(options.build.output));
    about(output_name(options.build.output),
          [&] { write(options.build.output, grid, field, options.build.output_format); });
  }
  cost.write = seconds_since(stage_start);
  cost.close(start);
  if (!options.build.stats) return exit_status::ok;
  const Counts counts = counts_of(triangulation, triangulation.hash().hex());
  Json json = stats_of("density", counts);
  json["grid"] = grid.shape;
  json["samples"] = options.samples;
  json["mass"] = masses.empty() ? static_cast<double>(counts.points)
                                : std::accumulate(masses.begin(), masses.end(), 0.0);
  add_cost(json, triangulation.statistics(), counts.cells + counts.infinite_cells, cost, options.build.seed);
  json["seconds"]["density"] = seconds;
  print_output(as_text(json));
  return exit_status::ok;
}

int run_density(DensityOptions options) {
  if (options.build.output.empty()) options.build.output = "-";
  if (options.build.output == "-" && options.build.output_format.empty()) options.build.output_format = "csv";
  protect_files({options.particles.input.path, options.particles.weights}, options.build.outputs(),
                options.build.force);
  check_output(options.build.output, options.build.output_format,
               [](const std::string& nowhere, const std::string& format) {
                 write(nowhere, DensityGrid{{0}, {1}, {1}}, std::vector<double>{0}, format);
               });
  const MemoryLimit limit(input_name(options.particles.input.path), options.build.memory);
  const auto start = Clock::now();
  Cost cost;
  std::vector<double> masses;
  PointTable table = options.particles.weights.empty()
                         ? options.particles.input.read(options.build.threads)
                         : options.particles.read(masses, options.build.threads);
  cost.read = seconds_since(start);
  std::vector<std::size_t> shape = chosen_shape(options.grid, static_cast<std::size_t>(table.dimension));
  const std::optional<Box> box = chosen_box(options.box, table.dimension);
  const auto taken = [&] { return std::exchange(table, PointTable{}); };  // freed after the triangulation
  if (options.periodic.is_wanted()) {
    const Lattice lattice = options.periodic.read(table.dimension);
    if (!box && lattice.rank() < lattice.dimension)
      throw UsageError("--grid needs --box, as the set is not periodic along all directions");
    const PeriodicOptions how = options.periodic.options();
    const DensityGrid grid =
        box ? DensityGrid::of(*box, std::move(shape)) : DensityGrid::of(lattice, std::move(shape));
    return run_with(
        [&](const Options& build_options) {
          const PointTable points = taken();
          return PeriodicDelaunay<>(PointsView(points.coordinates, points.dimension), lattice, how,
                                    build_options);
        },
        grid, masses, cost, start, options);
  }
  const DensityGrid grid = DensityGrid::of(box ? *box : box_of(table), std::move(shape));
  about(input_name(options.particles.input.path), [&] { warn_of_memory(table, options.build); });
  return run_with(
      [&](const Options& build_options) {
        const PointTable points = taken();
        Delaunay<> t(points.coordinates, points.dimension, build_options);
        t.sort_cells();  // so the order in which values are added does not depend on threads
        return t;
      },
      grid, masses, cost, start, options);
}

}  // namespace

Run add_density(CLI::App& app) {
  auto options = std::make_shared<DensityOptions>();
  options->particles.add_to(app, false);
  app.add_option("--grid", options->grid,
                 "Into how many equal parts each side is divided: a number, or one for each axis")
      ->required()
      ->type_name("N,...");
  app.add_option(
         "--samples", options->samples,
         "A part gets the mean of the density at the centers of S^d equal parts of it; 1 if not given")
      ->check(CLI::Range(1, 4096))
      ->type_name("S");
  app.add_option(
         "--box", options->box,
         "The box to divide: all lower limits, then all upper ones. By default the smallest box with all "
         "points, or that of the lattice")
      ->delimiter(',')
      ->type_name("LOW,...,HIGH,...");
  options->build.add_output(app,
                            "the densities, an array with an axis for each dimension; csv on standard output",
                            density_formats());
  add_threads(app, options->build.threads);
  options->build.add_construction(app);
  options->periodic.add_to(app);
  app.footer(
      "The density at a particle of mass m, 1 if not given, is (d+1) m over the volume\n"
      "of all cells of the Delaunay triangulation that have it as a vertex. Between\n"
      "particles it is linear in each cell. Outside of the convex hull it is 0.");
  return [options] { return run_density(*options); };
}

}  // namespace delone::cli
