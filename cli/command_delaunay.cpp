// SPDX-License-Identifier: BSD-3-Clause
// delone delaunay: points in, triangulation out, and what it cost.
#include "interrupt.hpp"
#include "make_tiles.hpp"
#include "memory_limit.hpp"
#include "periodic.hpp"
#include "report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

namespace delone::cli {
namespace {

struct DelaunayOptions {
  PointInput input;
  BuildOptions build;
  bool runtime_dimension = false, furthest_site = false;
  std::optional<double> trim;  // the tolerance
  TilesInput tiles;
  PeriodicInput periodic;
};

Summary summary(const Triangulation& t, const Counts& counts, const Cost& cost,
                const std::optional<TrimResult>& trimmed, const DelaunayOptions& options) {
  const char* kind = options.furthest_site ? "furthest-site Delaunay" : "Delaunay";
  Summary text(options.input.path, fmt::format("{} triangulation of {} in dimension {}", kind,
                                               counted(counts.points, "point"), counts.dimension));
  text.triangulation(counts);
  if (trimmed)
    text.line("trimmed",
              fmt::format("{} cells of volume {}, to a depth of {}, and {} vertices", trimmed->num_removed,
                          trimmed->lost_volume, trimmed->depth, trimmed->orphans.size()));
  return text.cost(t.statistics(), cost);
}

/// Takes the coordinates over, unless they are to be written.
template <class Product>
Product build(PointTable& table, const DelaunayOptions& options) {
  ProgressBar bar(options.build.quiet);
  const StageGuard guard(Stage::building);
  Options build_options = options.build.to_options(bar);
  build_options.force_runtime_dimension = options.runtime_dimension;
  return about(input_name(options.input.path), [&] {
    if (options.build.output.empty())
      return Product(std::move(table.coordinates), table.dimension, build_options);
    return Product(table.coordinates, table.dimension, build_options);
  });
}

template <class Product>
int run_with(PointTable table, const DelaunayOptions& options, Clock::time_point start, Cost cost) {
  const BuildOptions& to = options.build;
  const bool writes = !to.output.empty();
  const auto build_start = Clock::now();
  Product triangulation = build<Product>(table, options);
  cost.build = seconds_since(build_start);

  std::string hash;
  std::optional<TrimResult> trimmed;
  const auto sort_start = Clock::now();
  if (writes) triangulation.sort_cells();  // what is written does not depend on the threads
  const double sort_seconds = seconds_since(sort_start);
  if (options.trim)
    trimmed = about(input_name(options.input.path), [&] { return trim(triangulation, *options.trim); });
  if (writes) {
    const auto write_start = Clock::now();
    if (!to.qhull.empty()) {
      write_qhull_output(to.output, triangulation, to.qhull);
      cost.write = sort_seconds + seconds_since(write_start);
      cost.close(start);
      if (to.stats) hash = triangulation.hash().hex();
    } else {
      ComplexData data = trimmed ? std::move(trimmed->data) : triangulation.to_data(false);
      data.points = std::move(table.coordinates);
      data.column_names = table.column_names;
      write_output(to.output, data, to.output_format);
      cost.write = sort_seconds + seconds_since(write_start);
      cost.close(start);
      if (to.stats) hash = trimmed ? triangulation.hash().hex() : canonical_hash(data).hex();
    }
  } else {
    table = {};
    cost.close(start);
    hash = triangulation.hash().hex();
  }
  const Counts counts = counts_of(triangulation, hash);
  print_report(
      to, writes,
      [&] {
        Json json = stats_of("delaunay", counts, triangulation.statistics(), cost, to.seed);
        if (trimmed) {
          json["removed_cells"] = trimmed->num_removed;
          json["orphans"] = trimmed->orphans.size();
          json["depth"] = trimmed->depth;
          json["lost_volume"] = trimmed->lost_volume;
        }
        return json;
      },
      [&] { return summary(triangulation, counts, cost, trimmed, options); });
  return exit_status::ok;
}

int run_delaunay(const DelaunayOptions& options) {
  const BuildOptions& to = options.build;
  protect_files({options.input.path}, to.outputs(), to.force);
  if (options.trim && (!(*options.trim >= 0) || !std::isfinite(*options.trim)))
    throw UsageError("--trim: a finite distance of at least 0 was expected");
  MemoryLimit limit(input_name(options.input.path), to.memory, true);
  const auto start = Clock::now();
  Cost cost;
  PointTable table = options.input.read(to.threads);
  cost.read = seconds_since(start);
  limit.set_points(table);
  if (options.periodic.is_wanted())
    return run_periodic("delaunay", options.input, table, nullptr, options.periodic, to, start, cost);
  if (!to.qhull.empty())
    check_qhull_output(to.output, Delaunay<>(table.dimension), to.qhull);
  else if (!to.output.empty())
    check_complex_output(to.output, to.output_format, table.dimension);
  if (!options.furthest_site) about(input_name(options.input.path), [&] { warn_of_memory(table, to); });
  return options.furthest_site ? run_with<FurthestSite<>>(std::move(table), options, start, cost)
                               : run_with<Delaunay<>>(std::move(table), options, start, cost);
}

}  // namespace

Run add_delaunay(CLI::App& app) {
  auto options = std::make_shared<DelaunayOptions>();
  options->input.add_to(app, "IN", "Points: a file, or - for standard input");
  options->build.add_output(app, "the triangulation", complex_formats());
  options->build.add_qhull(app, "qdelaunay Qt", "o p i Fv Fx Fn FA FS");
  app.add_option("--trim", options->trim,
                 "Remove cells at the border that are within this distance of the remaining ones")
      ->type_name("DISTANCE")
      ->excludes("--qhull");
  add_threads(app, options->build.threads);
  app.add_flag("--furthest-site", options->furthest_site,
               "The furthest-site triangulation: no point is outside the sphere of a cell");
  app.add_flag("--runtime-dimension", options->runtime_dimension,
               "Use the engine for any dimension instead of a compiled one");
  options->build.add_construction(app, "the triangulation", TilesInput::beyond_memory);
  options->tiles.add_to(app);
  options->periodic.add_to(app);
  for (const char* other : {"--trim", "--qhull", "--furthest-site", "--runtime-dimension"})
    app.get_option("--lattice")->excludes(other);
  return [options, &app] {
    if (options->tiles.wanted(app, options->build.output))
      return run_tiles({"delaunay",
                        options->input,
                        {},
                        options->build,
                        options->tiles,
                        options->periodic.of_tiles(),
                        options->periodic.unit_or_0()});
    return run_delaunay(*options);
  };
}

}  // namespace delone::cli
