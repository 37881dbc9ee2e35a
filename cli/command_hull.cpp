// SPDX-License-Identifier: BSD-3-Clause
// delone hull: points in, convex hull out, or its lower or upper part with respect to the last coordinate.
#include "command.hpp"
#include "cost.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "progress_bar.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>

namespace delone::cli {
namespace {

struct HullOptions {
  PointInput input;
  std::string output, output_format, distances;
  std::uint64_t seed = 0;
  std::string order = "automatic";
  bool lower = false, upper = false, stats = false, quiet = false;
};

Options build_options(const HullOptions& options, ProgressBar& bar) {
  Options result;
  result.seed = options.seed;
  result.order = insertion_order(options.order);
  result.progress = bar.callback();
  return result;
}

/// Numbers that JSON has no form for become null.
nlohmann::ordered_json number(double x) {
  return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json stats_json(const Polytope& hull, const Cost& cost, const HullOptions& options) {
  nlohmann::ordered_json json;
  json["command"] = "hull";
  json["dimension"] = hull.dimension();
  json["affine_dimension"] = hull.affine_dimension();
  json["points"] = hull.num_points();
  json["vertices"] = hull.num_vertices();
  json["duplicates"] = hull.num_duplicates();
  json["hidden"] = hull.num_points() - hull.num_vertices() - hull.num_duplicates();
  json["boundary_points"] = hull.count(PointKind::boundary);
  json["interior_points"] = hull.count(PointKind::interior);
  json["cells"] = hull.num_cells();
  json["infinite_cells"] = 0;
  json["facets"] = hull.num_facets();
  json["ridges"] = hull.num_ridges();
  const Measure volume = hull.volume(), area = hull.area();
  json["volume"] = number(volume.value);
  json["volume_error"] = number(volume.error);
  json["area"] = number(area.value);
  json["area_error"] = number(area.error);
  json["hash"] = hull.hash().hex();
  add_cost(json, hull.statistics(), hull.num_cells(), cost, options.seed);
  return json;
}

nlohmann::ordered_json stats_json(const LowerHull& hull, const Cost& cost, const HullOptions& options) {
  nlohmann::ordered_json json;
  json["command"] = "hull";
  json["side"] = hull.side() == HullSide::lower ? "lower" : "upper";
  json["dimension"] = hull.dimension();
  json["composition_dimension"] = hull.composition_dimension();
  json["points"] = hull.num_points();
  json["vertices"] = hull.vertices().size();
  json["cells"] = hull.num_cells();
  json["facets"] = hull.num_facets();
  json["hash"] = canonical_hash(hull.to_data()).hex();
  const Statistics s = hull.num_points() == 0 ? Statistics{} : hull.polytope().statistics();
  add_cost(json, s, hull.num_points() == 0 ? 0 : hull.polytope().num_cells(), cost, options.seed);
  return json;
}

class Summary {
 public:
  explicit Summary(std::string title) : text_(std::move(title) + "\n") {}
  void line(const char* what, const std::string& value) { text_ += fmt::format("  {:<18}{}\n", what, value); }
  void cost(const Statistics& s, const Cost& cost) {
    line("conflict tests",
         fmt::format("{} by filter, {} direct, {} exact, {} ties", s.filter, s.direct, s.exact, s.perturbed));
    line("time",
         fmt::format("{:.3f} s (reading {:.3f}, building {:.3f})", cost.total, cost.read, cost.build));
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string measure_text(const Measure& measure) {
  return fmt::format("{} (error at most {:.1e})", measure.value, measure.error);
}

std::string summary(const Polytope& hull, const Cost& cost, const std::string& name) {
  Summary summary(
      fmt::format("{}: convex hull of {} points in dimension {}", name, hull.num_points(), hull.dimension()));
  const int k = hull.affine_dimension();
  summary.line("affine dimension", fmt::format("{}{}", k,
                                               k < 0                  ? " (no points)"
                                               : k < hull.dimension() ? " (flat: the hull in its flat)"
                                                                      : ""));
  summary.line("vertices", fmt::format("{} extreme points", hull.num_vertices()));
  summary.line("other points", fmt::format("{} on the boundary, {} in the interior, {} duplicates",
                                           hull.count(PointKind::boundary), hull.count(PointKind::interior),
                                           hull.num_duplicates()));
  summary.line("facets", fmt::format("{}, of {} simplices, and {} ridges", hull.num_facets(),
                                     hull.num_cells(), hull.num_ridges()));
  summary.line("volume", measure_text(hull.volume()));
  summary.line("area", measure_text(hull.area()));
  summary.line("hash", hull.hash().hex());
  summary.cost(hull.statistics(), cost);
  return summary.text();
}

std::string summary(const LowerHull& hull, const Cost& cost, const std::string& name) {
  Summary summary(fmt::format("{}: {} hull of {} points in dimension {}", name,
                              hull.side() == HullSide::lower ? "lower" : "upper", hull.num_points(),
                              hull.dimension()));
  summary.line("compositions", fmt::format("of affine dimension {}", hull.composition_dimension()));
  summary.line("vertices", fmt::format("{} extreme points", hull.vertices().size()));
  summary.line("facets", fmt::format("{}, of {} simplices", hull.num_facets(), hull.num_cells()));
  summary.line("hash", canonical_hash(hull.to_data()).hex());
  summary.cost(hull.num_points() == 0 ? Statistics{} : hull.polytope().statistics(), cost);
  return summary.text();
}

void write_hull_output(const std::string& path, const HullData& data, const std::string& format) {
  const StageGuard guard(path == "-" ? Stage::plain : Stage::writing);
  about(path == "-" ? "standard output" : path, [&] { write_hull(path, data, format); });
}

/// Prints what was asked for; `write` writes the output file.
template <class Hull, class Write>
int report(const Hull& hull, const HullOptions& options, Cost cost, Clock::time_point start, Write write) {
  if (!options.output.empty()) {
    const auto write_start = Clock::now();
    write();
    cost.write = seconds_since(write_start);
  }
  cost.close(start);
  if (options.stats)
    print_output(stats_json(hull, cost, options).dump(2) + "\n");
  else if (options.output.empty())
    print_output(summary(hull, cost, input_name(options.input.path)));
  return exit_status::ok;
}

int run_hull(const HullOptions& options) {
  if (options.stats && options.output == "-")
    throw UsageError("--stats and --output - both want standard output");
  const bool one_side = options.lower || options.upper;
  if (!options.distances.empty() && !one_side) throw UsageError("--distances needs --lower or --upper");
  const auto start = Clock::now();
  Cost cost;
  const PointTable table = options.input.read();
  cost.read = seconds_since(start);
  if (!options.output.empty()) check_complex_output(options.output, options.output_format, table.dimension);
  if (!options.distances.empty()) check_writable(options.distances);
  ProgressBar bar(options.quiet);
  const auto build_start = Clock::now();
  const std::string name = input_name(options.input.path);
  if (!one_side) {
    const Polytope hull = [&] {
      const StageGuard guard(Stage::building);
      return about(name,
                   [&] { return Polytope(table.coordinates, table.dimension, build_options(options, bar)); });
    }();
    cost.build = seconds_since(build_start);
    bar.clear();
    return report(hull, options, cost, start,
                  [&] { write_hull_output(options.output, hull.to_data(), options.output_format); });
  }
  const HullSide side = options.lower ? HullSide::lower : HullSide::upper;
  const LowerHull hull = [&] {
    const StageGuard guard(Stage::building);
    return about(name, [&] {
      return LowerHull(table.coordinates, table.dimension, side, build_options(options, bar));
    });
  }();
  cost.build = seconds_since(build_start);
  bar.clear();
  if (!options.distances.empty())
    write_points_output(options.distances, {1, hull.height_above(table.coordinates), {"height_above_hull"}},
                        "");
  return report(hull, options, cost, start,
                [&] { write_complex_output(options.output, hull.to_data(), options.output_format); });
}

}  // namespace

Run add_hull(CLI::App& app) {
  auto options = std::make_shared<HullOptions>();
  options->input.add_to(app, "IN", "Points: a file, or - for standard input");
  app.add_option("-o,--output", options->output, "Write the hull there; without it a summary is printed")
      ->type_name("OUT");
  app.add_option("--output-format", options->output_format, "Format of OUT, if not told by its extension")
      ->check(CLI::IsMember(complex_formats()));
  CLI::Option* lower =
      app.add_flag("--lower", options->lower, "Only the facets that look down along the last coordinate");
  app.add_flag("--upper", options->upper, "Only the facets that look up along the last coordinate")
      ->excludes(lower);
  app.add_option(
         "--distances", options->distances,
         "With --lower or --upper: write how far each point is above the hull, along the last coordinate")
      ->type_name("FILE");
  add_seed(app, options->seed, "Seed of the insertion order; the result does not depend on it");
  app.add_option("--order", options->order, "Insertion order; the result does not depend on it")
      ->check(CLI::IsMember({"automatic", "given", "shuffled"}));
  app.add_flag("--stats", options->stats,
               "Print one JSON object about the result and its cost, and nothing else");
  app.add_flag("-q,--quiet", options->quiet, "No progress bar, no notes");
  return [options] { return run_hull(*options); };
}

}  // namespace delone::cli
