// SPDX-License-Identifier: BSD-3-Clause
// delone voronoi, delone power: points in, Voronoi or power diagram out, and what it cost.
#include "box_option.hpp"
#include "interrupt.hpp"
#include "memory_limit.hpp"
#include "report.hpp"
#include "weighted_input.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

namespace delone::cli {
namespace {

struct VoronoiOptions {
  WeightedInput weighted;  // the points; of a power diagram with weights
  bool power = false, furthest_site = false;
  BuildOptions build;
  std::string volumes;
  double tolerance = 0;
  std::vector<double> box;  // low by axis, then high
};

const std::vector<std::string>& voronoi_formats() {
  static const std::vector<std::string> formats{"npz", "json", "svg", "vtu", "html"};
  return formats;
}

/// Throws UsageError if there is nothing that --box would cut.
void require_use_of_box(const VoronoiOptions& options) {
  if (options.box.empty() || !options.volumes.empty()) return;
  const BuildOptions& to = options.build;
  std::string format = to.output_format;
  if (format.empty() && !to.output.empty() && to.output != "-")
    format = std::filesystem::path(to.output).extension().string();
  if (to.output.empty() || !to.qhull.empty() || format.ends_with("npz") || format.ends_with("json"))
    throw UsageError(
        "--box cuts pictures and volumes: it is for an output as svg, vtu or html, and for --volumes");
}

/// Throws what the writing would throw in the end, before the work.
void check_outputs(const VoronoiOptions& options, int dimension) {
  if (!options.volumes.empty()) {
    require_extension(options.volumes, {"csv"}, "volumes");
    check_writable(options.volumes);
  }
  if (options.build.output.empty()) return;
  if (!options.build.qhull.empty())
    return check_qhull_output(options.build.output, Voronoi(Delaunay<>(dimension)), options.build.qhull);
  check_output(options.build.output, options.build.output_format,
               [&](const std::string& nowhere, const std::string& format) {
                 write(nowhere, Voronoi(Delaunay<>(dimension)), std::nullopt, format);
               });
}

Json stats(const Triangulation& t, const Diagram& diagram, const Cost& cost, const VoronoiOptions& options) {
  const Counts counts = counts_of(t, t.hash().hex());
  Json json = stats_of(options.power           ? "power"
                       : options.furthest_site ? "furthest_voronoi"
                                               : "voronoi",
                       counts);
  json["voronoi_vertices"] = diagram.num_vertices();
  json["regions"] = diagram.num_regions();
  json["unbounded_regions"] = diagram.num_unbounded_regions();
  json["ridges"] = diagram.num_ridges();
  json["rays"] = diagram.num_rays();
  if (diagram.tolerance() > 0) {
    json["tolerance"] = diagram.tolerance();
    json["max_displacement"] = diagram.max_displacement();
  }
  add_cost(json, t.statistics(), counts.cells + counts.infinite_cells, cost, options.build.seed);
  return json;
}

Summary summary(const Triangulation& t, const Diagram& diagram, const Cost& cost,
                const VoronoiOptions& options) {
  const Counts counts = counts_of(t, {});
  const std::string kind = options.power           ? "power"
                           : options.furthest_site ? "furthest-site Voronoi"
                                                   : "Voronoi";
  const std::string tolerance = diagram.tolerance() > 0
                                    ? fmt::format("; with tolerance {}, none moved further than {}",
                                                  diagram.tolerance(), diagram.max_displacement())
                                    : "";
  return Summary(options.weighted.input.path, fmt::format("{} diagram of {} in dimension {}", kind,
                                                          counted(counts.points, "point"), counts.dimension))
      .affine_dimension(counts.affine_dimension, counts.dimension, "the diagram inside the flat")
      .line("regions",
            fmt::format("{}, {} of them unbounded ({} hidden, {} duplicate points)", diagram.num_regions(),
                        diagram.num_unbounded_regions(), num_hidden(counts), counts.duplicates))
      .line(kind + " vertices",
            fmt::format("{} of {} cells{}", diagram.num_vertices(), counts.cells, tolerance))
      .line("ridges", fmt::format("{}, and {} rays", diagram.num_ridges(), diagram.num_rays()))
      .cost(t.statistics(), cost);
}

/// One line per region: the row of its point, and its volume.
std::string volumes_text(const Diagram& diagram, const std::optional<Box>& box, unsigned threads) {
  const std::vector<double> volumes =
      box ? diagram.region_volumes(*box, {.threads = threads}) : diagram.region_volumes({.threads = threads});
  std::string text = "point,volume\n";
  for (std::size_t r = 0; r < volumes.size(); ++r)
    text += fmt::format("{},{}\n", diagram.region_points()[r], volumes[r]);
  return text;
}

Voronoi<> diagram_of(const Delaunay<>& triangulation, const DiagramOptions& options, const Execution& how) {
  return Voronoi(triangulation, options, how);
}
PowerDiagram<> diagram_of(const Regular<>& triangulation, const DiagramOptions& options,
                          const Execution& how) {
  return PowerDiagram(triangulation, options, how);
}
FurthestVoronoi<> diagram_of(const FurthestSite<>& triangulation, const DiagramOptions& options,
                             const Execution& how) {
  return FurthestVoronoi(triangulation, options, how);
}

/// The triangulation by `build`, its diagram, and what was asked for.
template <class Build>
int run_with(Build build, const std::optional<Box>& box, const std::vector<std::string>& column_names,
             Cost cost, Clock::time_point start, const VoronoiOptions& options) {
  const std::string name = input_name(options.weighted.input.path);
  auto stage_start = Clock::now();
  auto triangulation = about(name, [&] {
    ProgressBar bar(options.build.quiet);
    const StageGuard guard(Stage::building);
    return build(options.build.to_options(bar));
  });
  cost.build = seconds_since(stage_start);

  stage_start = Clock::now();
  triangulation.sort_cells();  // what is written does not depend on the threads
  const auto diagram = about(name, [&] {
    return diagram_of(triangulation, {.tolerance = options.tolerance}, {.threads = options.build.threads});
  });
  const std::string volumes = options.volumes.empty() ? "" : about(output_name(options.volumes), [&] {
    return volumes_text(diagram, box, options.build.threads);
  });
  cost.diagram = seconds_since(stage_start);

  stage_start = Clock::now();
  if (!options.build.qhull.empty())
    write_qhull_output(options.build.output, diagram, options.build.qhull);
  else if (!options.build.output.empty())
    write_output(options.build.output, diagram, box, options.build.output_format, column_names);
  if (!options.volumes.empty()) save_text(options.volumes, volumes);
  cost.write = seconds_since(stage_start);
  cost.close(start);
  print_report(
      options.build, !options.build.output.empty() || !options.volumes.empty(),
      [&] { return stats(triangulation, diagram, cost, options); },
      [&] { return summary(triangulation, diagram, cost, options); });
  return exit_status::ok;
}

int run_voronoi(const VoronoiOptions& options) {
  protect_files({options.weighted.input.path, options.weighted.weights},
                options.build.outputs({{"--volumes", options.volumes}}), options.build.force);
  if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance))
    throw UsageError("--tolerance: a finite distance of at least 0 was expected");
  require_use_of_box(options);
  const MemoryLimit limit(input_name(options.weighted.input.path), options.build.memory);
  const auto start = Clock::now();
  Cost cost;
  std::vector<double> weights;
  PointTable table = options.power ? options.weighted.read(weights, options.build.threads)
                                   : options.weighted.input.read(options.build.threads);
  cost.read = seconds_since(start);
  check_outputs(options, table.dimension);
  const std::optional<Box> box = chosen_box(options.box, table.dimension);
  if (!options.furthest_site)
    about(input_name(options.weighted.input.path), [&] { warn_of_memory(table, options.build); });
  const std::vector<std::string> column_names = table.column_names;
  const auto taken = [&] { return std::exchange(table, PointTable{}); };  // freed after the triangulation
  if (options.power)
    return run_with(
        [&](const Options& build_options) {
          const PointTable points = taken();
          return Regular<>(points.coordinates, weights, points.dimension, build_options);
        },
        box, column_names, cost, start, options);
  if (options.furthest_site)
    return run_with(
        [&](const Options& build_options) {
          const PointTable points = taken();
          return FurthestSite<>(points.coordinates, points.dimension, build_options);
        },
        box, column_names, cost, start, options);
  return run_with(
      [&](const Options& build_options) {
        const PointTable points = taken();
        return Delaunay<>(points.coordinates, points.dimension, build_options);
      },
      box, column_names, cost, start, options);
}

Run add_diagram(CLI::App& app, bool power) {
  auto options = std::make_shared<VoronoiOptions>();
  options->power = power;
  if (power)
    options->weighted.add_to(app);
  else
    options->weighted.input.add_to(app, "IN", "Points: a file, or - for standard input");
  if (!power)
    app.add_flag("--furthest-site", options->furthest_site,
                 "The diagram of furthest sites: regions of the points that are not further from any other");
  options->build.add_output(app, "the diagram", voronoi_formats());
  options->build.add_qhull(app, "qvoronoi", "o p Fv Fx Fn");
  app.add_option("--box", options->box,
                 "Clip pictures and volumes to this box: all lower limits, then all upper ones; pictures are "
                 "clipped to a "
                 "box around the points otherwise")
      ->delimiter(',')
      ->type_name("LOW,...,HIGH,...");
  app.add_option("--volumes", options->volumes, "Write the volume of each region there, as CSV")
      ->type_name("FILE");
  app.add_option(
         "--tolerance", options->tolerance,
         "Merge vertices that are within this distance of one of them, and drop ridges of no larger width")
      ->type_name("DISTANCE");
  add_threads(app, options->build.threads);
  options->build.add_construction(app);
  return [options] { return run_voronoi(*options); };
}

}  // namespace

Run add_voronoi(CLI::App& app) { return add_diagram(app, false); }
Run add_power(CLI::App& app) { return add_diagram(app, true); }

}  // namespace delone::cli
