// SPDX-License-Identifier: BSD-3-Clause
// delone hull: points in, convex hull out, or its lower or upper part with respect to the last coordinate.
#include "interrupt.hpp"
#include "memory_limit.hpp"
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace delone::cli {
namespace {

struct HullOptions {
  PointInput input;
  BuildOptions build;
  std::string distances;
  bool lower = false, upper = false;
  double tolerance = 0;
};

Json stats(const ConvexHullBase& hull, const Cost& cost, const HullOptions& options) {
  Json json = stats_of("hull", counts_of(hull));
  json["boundary_points"] = hull.count(PointKind::boundary);
  json["interior_points"] = hull.count(PointKind::interior);
  json["facets"] = hull.num_facets();
  json["ridges"] = hull.num_ridges();
  json["tolerance"] = hull.tolerance();
  json["max_distance"] = hull.max_distance();
  const Measure volume = hull.volume(), area = hull.area();
  json["volume"] = number(volume.value);
  json["volume_error"] = number(volume.error);
  json["area"] = number(area.value);
  json["area_error"] = number(area.error);
  add_cost(json, hull.statistics(), hull.num_cells(), cost, options.build.seed);
  return json;
}

Statistics statistics_of(const LowerHullBase& hull) {
  return hull.num_points() == 0 ? Statistics{} : hull.polytope().statistics();
}

Json stats(const LowerHullBase& hull, const Cost& cost, const HullOptions& options) {
  Json json;
  json["command"] = "hull";
  json["side"] = hull.side() == HullSide::lower ? "lower" : "upper";
  json["dimension"] = hull.dimension();
  json["composition_dimension"] = hull.composition_dimension();
  json["points"] = hull.num_points();
  json["vertices"] = hull.vertices().size();
  json["cells"] = hull.num_cells();
  json["hash"] = canonical_hash(hull.to_data()).hex();
  json["facets"] = hull.num_facets();
  json["tolerance"] = hull.tolerance();
  json["max_distance"] = hull.max_distance();
  add_cost(json, statistics_of(hull), hull.num_points() == 0 ? 0 : hull.polytope().num_cells(), cost,
           options.build.seed);
  return json;
}

std::string measure_text(const Measure& measure) {
  return fmt::format("{} (error at most {:.1e})", measure.value, measure.error);
}

std::string title(const ConvexHullBase& hull) {
  const std::string title =
      fmt::format("convex hull of {} in dimension {}", counted(hull.num_points(), "point"), hull.dimension());
  if (hull.tolerance() == 0) return title;
  return fmt::format("{}; none is farther outside than {} (tolerance {})", title, hull.max_distance(),
                     hull.tolerance());
}

Summary summary(const ConvexHullBase& hull, const Cost& cost, const HullOptions& options) {
  return Summary(options.input.path, title(hull))
      .affine_dimension(hull.affine_dimension(), hull.dimension(), "the hull in its flat")
      .line("vertices", fmt::format("{} extreme points", hull.num_vertices()))
      .line("other points", fmt::format("{} on the boundary, {} in the interior, {} duplicates",
                                        hull.count(PointKind::boundary), hull.count(PointKind::interior),
                                        hull.num_duplicates()))
      .line("facets", fmt::format("{}, of {} simplices, and {} ridges", hull.num_facets(), hull.num_cells(),
                                  hull.num_ridges()))
      .line("volume", measure_text(hull.volume()))
      .line("area", measure_text(hull.area()))
      .line("hash", hull.hash().hex())
      .cost(hull.statistics(), cost);
}

Summary summary(const LowerHullBase& hull, const Cost& cost, const HullOptions& options) {
  return Summary(options.input.path, fmt::format("{} hull of {} in dimension {}",
                                                 hull.side() == HullSide::lower ? "lower" : "upper",
                                                 counted(hull.num_points(), "point"), hull.dimension()))
      .line("compositions", fmt::format("of affine dimension {}", hull.composition_dimension()))
      .line("vertices", fmt::format("{} extreme points", hull.vertices().size()))
      .line("facets", fmt::format("{}, of {} simplices", hull.num_facets(), hull.num_cells()))
      .line("hash", canonical_hash(hull.to_data()).hex())
      .cost(statistics_of(hull), cost);
}

/// Writes the output file by `write`, if there is to be one, and reports.
template <class Hull, class Write>
int finish(const Hull& hull, const HullOptions& options, Cost cost, Clock::time_point start, Write write) {
  if (!options.build.output.empty()) {
    const auto write_start = Clock::now();
    write();
    cost.write = seconds_since(write_start);
  }
  cost.close(start);
  print_report(
      options.build, !options.build.output.empty() || !options.distances.empty(),
      [&] { return stats(hull, cost, options); }, [&] { return summary(hull, cost, options); });
  return exit_status::ok;
}

/// What to say of compositions of which every row has about the same sum, as fractions have that were
/// rounded: they are not flat, and so too many points are extreme. Empty where there is nothing to say.
std::string note_on_sums(const PointTable& table, const LowerHullBase& hull) {
  const auto d = static_cast<std::size_t>(table.dimension), c = d - 1;
  if (c < 2 || table.coordinates.empty() || hull.composition_dimension() < static_cast<int>(c)) return {};
  constexpr double rounding = 5e-3;  // fractions may have three decimals only
  const double infinity = std::numeric_limits<double>::infinity();
  double low = infinity, high = -infinity;
  std::vector<double> least(c, infinity), most(c, -infinity);
  for (std::size_t i = 0; i < table.num_points(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < c; ++j) {
      const double x = table.coordinates[i * d + j];
      sum += x;
      least[j] = std::min(least[j], x);
      most[j] = std::max(most[j], x);
    }
    low = std::min(low, sum);
    high = std::max(high, sum);
  }
  double range = infinity;
  for (std::size_t j = 0; j < c; ++j) range = std::min(range, most[j] - least[j]);
  if (!(high - low <= rounding * range)) return {};
  std::string which = fmt::format("first {} coordinates", c);
  if (table.column_names.size() == d) {
    which = "columns ";
    for (std::size_t j = 0; j < c; ++j) which += (j == 0 ? "" : ", ") + printable(table.column_names[j]);
  }
  return fmt::format(
      "delone: note: the {} sum to {:.4g} but for rounding, so that too many points are on the hull: leave "
      "one of them out (--columns)\n",
      which, (low + high) / 2);
}

int run_hull(const HullOptions& options) {
  const BuildOptions& build = options.build;
  protect_files({options.input.path}, build.outputs({{"--distances", options.distances}}), build.force);
  const bool one_side = options.lower || options.upper;
  if (!options.distances.empty() && !one_side) throw UsageError("--distances needs --lower or --upper");
  const MemoryLimit limit(input_name(options.input.path), build.memory);
  const auto start = Clock::now();
  Cost cost;
  const PointTable table = options.input.read();
  cost.read = seconds_since(start);
  if (!build.qhull.empty())
    check_qhull_output(build.output, ConvexHull<>(table.dimension), build.qhull);
  else if (!build.output.empty())
    check_complex_output(build.output, build.output_format, table.dimension);
  if (!options.distances.empty()) check_writable(options.distances);
  const auto write_data = [&](auto data) {
    data.column_names = table.column_names;
    write_output(build.output, data, build.output_format);
  };
  ProgressBar bar(build.quiet);
  const auto build_start = Clock::now();
  const auto built = [&](auto make) {
    const StageGuard guard(Stage::building);
    return about(input_name(options.input.path), [&] {
      Options how = build.to_options(bar);
      how.tolerance = options.tolerance;
      return make(how);
    });
  };
  if (!one_side) {
    const ConvexHull<> hull =
        built([&](const Options& how) { return ConvexHull(table.coordinates, table.dimension, how); });
    cost.build = seconds_since(build_start);
    bar.clear();
    return finish(hull, options, cost, start, [&] {
      if (build.qhull.empty())
        write_data(hull.to_data());
      else
        write_qhull_output(build.output, hull, build.qhull);
    });
  }
  const HullSide side = options.lower ? HullSide::lower : HullSide::upper;
  const LowerHull<> hull =
      built([&](const Options& how) { return LowerHull(table.coordinates, table.dimension, side, how); });
  cost.build = seconds_since(build_start);
  bar.clear();
  if (!build.quiet) print_note(note_on_sums(table, hull));
  if (!options.distances.empty())
    write_output(
        options.distances,
        PointTable{1, hull.height_above(table.coordinates, options.tolerance), {"height_above_hull"}}, "");
  return finish(hull, options, cost, start, [&] { write_data(hull.to_data()); });
}

}  // namespace

Run add_hull(CLI::App& app) {
  auto options = std::make_shared<HullOptions>();
  options->input.add_to(app, "IN", "Points: a file, or - for standard input");
  options->build.add_output(app, "the hull", complex_formats());
  options->build.add_qhull(app, "qconvex", "o n p i Fv Fx Fn FA FS");
  CLI::Option* lower =
      app.add_flag("--lower", options->lower,
                   "Only the facets that face down along the last coordinate, which may be the energy of a "
                   "composition; if fractions sum to 1, leave one out")
          ->excludes("--qhull");
  app.add_flag("--upper", options->upper, "Only the facets that face up along the last coordinate")
      ->excludes(lower)
      ->excludes("--qhull");
  app.add_option("--distances", options->distances,
                 "With --lower or --upper: write the height of each point above the hull, along the last "
                 "coordinate; up to "
                 "--tolerance it is 0")
      ->type_name("FILE");
  app.add_option(
      "--tolerance", options->tolerance,
      "Keep only points such that no other is farther outside their hull than this (with --lower or "
      "--upper: along the last coordinate)");
  options->build.add_construction(app, "the hull");
  add_threads(app, options->build.threads);
  return [options] { return run_hull(*options); };
}

}  // namespace delone::cli
