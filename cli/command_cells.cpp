// SPDX-License-Identifier: BSD-3-Clause
// delone cells: points in, the measures of their cells out, and what they cost.
#include "box_option.hpp"
#include "interrupt.hpp"
#include "memory_limit.hpp"
#include "periodic.hpp"
#include "report.hpp"
#include "weighted_input.hpp"

#include <delone/site_cells.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <type_traits>
#include <utility>

namespace delone::cli {
namespace {

struct CellsOptions {
  WeightedInput weighted;  // the points, perhaps with weights
  BuildOptions build;
  std::vector<double> box;  // low by axis, then high
  std::string halfspaces;   // a file, if not empty
  PeriodicInput periodic;
  bool neighbors = false, vertices = false, proper = false;
};

template <class T>
constexpr bool is_periodic = std::is_base_of_v<PeriodicTriangulation, T>;

const std::vector<std::string>& cells_formats() {
  static const std::vector<std::string> formats{"npz", "csv"};
  return formats;
}

std::size_t num_unbounded(const SiteCells& cells) {
  return static_cast<std::size_t>(
      std::count_if(cells.volumes.begin(), cells.volumes.end(), [](double v) { return std::isinf(v); }));
}

double volume_of_bounded(const SiteCells& cells) {
  return std::accumulate(cells.volumes.begin(), cells.volumes.end(), 0.0,
                         [](double sum, double v) { return std::isinf(v) ? sum : sum + v; });
}

template <class T>
Json stats(const T& t, const SiteCells& cells, const Cost& cost, const CellsOptions& options) {
  const Counts counts = counts_of(t, t.hash().hex());
  Json json = stats_of("cells", counts);
  json["unbounded_cells"] = num_unbounded(cells);
  json["volume"] = volume_of_bounded(cells);
  if constexpr (is_periodic<T>) add_periodic(json, t);
  add_cost(json, t.statistics(), counts.cells + counts.infinite_cells, cost, options.build.seed);
  return json;
}

template <class T>
Summary summary(const T& t, const SiteCells& cells, const Cost& cost, const CellsOptions& options) {
  const Counts counts = counts_of(t, {});
  Summary summary(options.weighted.input.path,
                  fmt::format("{}ells of {} in dimension {}", is_periodic<T> ? "Periodic c" : "C",
                              counted(counts.points, "point"), counts.dimension));
  summary.affine_dimension(counts.affine_dimension, counts.dimension, "the cells inside the flat");
  if constexpr (is_periodic<T>) add_periodic(summary, t);
  return summary
      .line("cells",
            fmt::format("{}, {} of them unbounded ({} hidden, {} duplicate points)", t.num_vertices(),
                        num_unbounded(cells), num_hidden(counts), counts.duplicates))
      .line("volume", fmt::format("{:.10g}, of bounded cells", volume_of_bounded(cells)))
      .cost(t.statistics(), cost);
}

/// Throws what the writing would throw in the end, before the work.
void check_outputs(const CellsOptions& options) {
  if (options.build.output.empty()) return;
  const bool has_lists = options.neighbors || options.vertices;
  if (has_lists && chosen_format(options.build.output, options.build.output_format) == "csv")
    throw UsageError(fmt::format("--{}: csv has a row for each cell and no lists; write npz",
                                 options.neighbors ? "neighbors" : "vertices"));
  check_output(
      options.build.output, options.build.output_format,
      [](const std::string& nowhere, const std::string& format) { write(nowhere, SiteCells{}, format); });
}

/// Of --box and --halfspaces.
struct Container {
  std::optional<Box> box;
  std::vector<double> halfspaces;
};

Container chosen_container(const CellsOptions& options, int dimension) {
  Container chosen{chosen_box(options.box, dimension), {}};
  if (options.halfspaces.empty()) return chosen;
  PointTable table = options.weighted.input.read_beside(options.halfspaces);
  if (table.dimension != dimension + 1)
    throw Error(Errc::bad_format,
                fmt::format("{}: expected {} columns for the halfspaces of {} dimensions, found {}",
                            input_name(options.halfspaces), dimension + 1, dimension, table.dimension));
  chosen.halfspaces = std::move(table.coordinates);
  return chosen;
}

template <class Build>
int run_with(Build build, const Container& container, Cost cost, Clock::time_point start,
             const CellsOptions& options) {
  const std::string name = input_name(options.weighted.input.path);
  auto stage_start = Clock::now();
  const auto triangulation = about(name, [&] {
    ProgressBar bar(options.build.quiet);
    const StageGuard guard(Stage::building);
    return build(options.build.to_options(bar));
  });
  cost.build = seconds_since(stage_start);

  stage_start = Clock::now();
  const SiteCells cells = about(name, [&] {
    return site_cells(triangulation,
                      {.faces = options.proper ? CellFaces::proper : CellFaces::triangulated,
                       .neighbors = options.neighbors,
                       .vertices = options.vertices,
                       .box = container.box,
                       .halfspaces = container.halfspaces},
                      {.threads = options.build.threads});
  });
  cost.diagram = seconds_since(stage_start);

  stage_start = Clock::now();
  if (!options.build.output.empty()) write_output(options.build.output, cells, options.build.output_format);
  cost.write = seconds_since(stage_start);
  cost.close(start);
  print_report(
      options.build, !options.build.output.empty(),
      [&] { return stats(triangulation, cells, cost, options); },
      [&] { return summary(triangulation, cells, cost, options); });
  return exit_status::ok;
}

int run_cells(const CellsOptions& options) {
  protect_files({options.weighted.input.path, options.weighted.weights, options.halfspaces},
                options.build.outputs(), options.build.force);
  const MemoryLimit limit(input_name(options.weighted.input.path), options.build.memory);
  const auto start = Clock::now();
  Cost cost;
  std::vector<double> weights;
  const bool weighted = !options.weighted.weights.empty();
  PointTable table = weighted ? options.weighted.read(weights, options.build.threads)
                              : options.weighted.input.read(options.build.threads);
  cost.read = seconds_since(start);
  check_outputs(options);
  const Container container = chosen_container(options, table.dimension);
  const auto taken = [&] { return std::exchange(table, PointTable{}); };  // freed after the triangulation
  if (options.periodic.is_wanted()) {
    const Lattice lattice = options.periodic.read(table.dimension);
    const PeriodicOptions how = options.periodic.options();
    if (weighted)
      return run_with(
          [&](const Options& build_options) {
            const PointTable points = taken();
            return PeriodicRegular<>(PointsView(points.coordinates, points.dimension), weights, lattice, how,
                                     build_options);
          },
          container, cost, start, options);
    return run_with(
        [&](const Options& build_options) {
          const PointTable points = taken();
          return PeriodicDelaunay<>(PointsView(points.coordinates, points.dimension), lattice, how,
                                    build_options);
        },
        container, cost, start, options);
  }
  about(input_name(options.weighted.input.path), [&] { warn_of_memory(table, options.build); });
  if (weighted)
    return run_with(
        [&](const Options& build_options) {
          const PointTable points = taken();
          return Regular<>(points.coordinates, weights, points.dimension, build_options);
        },
        container, cost, start, options);
  return run_with(
      [&](const Options& build_options) {
        const PointTable points = taken();
        return Delaunay<>(points.coordinates, points.dimension, build_options);
      },
      container, cost, start, options);
}

}  // namespace

Run add_cells(CLI::App& app) {
  auto options = std::make_shared<CellsOptions>();
  options->weighted.add_to(app, false);
  options->build.add_output(app, "the cells, a row for each point", cells_formats());
  app.add_option("--box", options->box, "Clip cells to this box: all lower limits, then all upper ones")
      ->delimiter(',')
      ->type_name("LOW,...,HIGH,...");
  app.add_option(
         "--halfspaces", options->halfspaces,
         "In the box, clip cells to these halfspaces, too: a file with a row a, c of each a x + c <= 0")
      ->needs("--box")
      ->type_name("FILE");
  app.add_flag("--neighbors", options->neighbors,
               "Also list neighbors, areas of faces and distances, in an output as npz");
  app.add_flag("--vertices", options->vertices,
               "Also list neighbors, the vertices of cells and, in order, of faces, in an output as npz");
  app.add_flag("--proper-faces", options->proper,
               "Count only faces with an area, decided exactly, where many points have one empty sphere");
  add_threads(app, options->build.threads);
  options->build.add_construction(app);
  options->periodic.add_to(app);
  app.get_option("--lattice")->excludes("--box");
  return [options] { return run_cells(*options); };
}

}  // namespace delone::cli
