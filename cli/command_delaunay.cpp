// SPDX-License-Identifier: BSD-3-Clause
// delone delaunay: points in, triangulation out, and what it cost.
#include "command.hpp"
#include "cost.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "progress_bar.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace delone::cli {
namespace {

struct DelaunayOptions {
  PointInput input;
  std::string output, output_format;
  int threads = 1;
  std::uint64_t seed = 0;
  std::string order = "automatic";
  bool stats = false, quiet = false, runtime_dimension = false, furthest_site = false;
};

/// The rows that are neither vertices nor duplicates of one.
std::size_t num_hidden(const Triangulation& t) {
  return t.num_points() - t.num_vertices() - t.num_duplicates();
}

nlohmann::ordered_json stats_json(const Triangulation& t, const std::string& hash, const Cost& cost,
                                  const DelaunayOptions& options) {
  const Statistics s = t.statistics();
  const std::size_t num_cells = t.complex().num_cells();
  nlohmann::ordered_json json;
  json["command"] = "delaunay";
  json["dimension"] = t.dimension();
  json["affine_dimension"] = t.affine_dimension();
  json["points"] = t.num_points();
  json["vertices"] = t.num_vertices();
  json["duplicates"] = t.num_duplicates();
  json["hidden"] = num_hidden(t);
  json["cells"] = t.num_finite_cells();
  json["infinite_cells"] = t.num_infinite_cells();
  json["hash"] = hash;
  add_cost(json, s, num_cells, cost, options.seed);
  return json;
}

std::string summary(const Triangulation& t, const std::string& hash, const Cost& cost,
                    const DelaunayOptions& options) {
  const Statistics s = t.statistics();
  const char* kind = options.furthest_site ? "furthest-site Delaunay" : "Delaunay";
  std::string text = fmt::format("{}: {} triangulation of {} points in dimension {}\n",
                                 input_name(options.input.path), kind, t.num_points(), t.dimension());
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<18}{}\n", what, value);
  };
  line("affine dimension",
       fmt::format("{}{}", t.affine_dimension(),
                   t.affine_dimension() < 0               ? " (no points)"
                   : t.affine_dimension() < t.dimension() ? " (flat: triangulated inside its flat)"
                                                          : ""));
  line("vertices", options.furthest_site
                       ? fmt::format("{} ({} hidden, {} duplicate points)", t.num_vertices(), num_hidden(t),
                                     t.num_duplicates())
                       : fmt::format("{} ({} duplicate points)", t.num_vertices(), t.num_duplicates()));
  line("cells", fmt::format("{}, and {} hull facets", t.num_finite_cells(), t.num_infinite_cells()));
  line("hash", hash);
  line("conflict tests",
       fmt::format("{} by filter, {} direct, {} exact, {} ties", s.filter, s.direct, s.exact, s.perturbed));
  line("time", fmt::format("{:.3f} s (reading {:.3f}, ordering {:.3f}, building {:.3f})", cost.total,
                           cost.read, s.order_seconds, cost.build - s.order_seconds));
  line("peak memory", fmt::format("{:.1f} MB", static_cast<double>(cost.peak_rss_bytes) / 1e6));
  return text;
}

/// Takes the coordinates over, unless they are to be written.
std::unique_ptr<Triangulation> build(PointTable& table, const DelaunayOptions& options) {
  ProgressBar bar(options.quiet);
  const StageGuard guard(Stage::building);
  Options build_options;
  build_options.seed = options.seed;
  build_options.order = insertion_order(options.order);
  build_options.force_runtime_dimension = options.runtime_dimension;
  build_options.progress = bar.callback();
  return about(input_name(options.input.path), [&]() -> std::unique_ptr<Triangulation> {
    if (options.furthest_site)
      return std::make_unique<FurthestSiteTriangulation>(table.coordinates, table.dimension, build_options);
    if (options.output.empty())
      return std::make_unique<Triangulation>(std::move(table.coordinates), table.dimension, build_options);
    return std::make_unique<Triangulation>(table.coordinates, table.dimension, build_options);
  });
}

int run_delaunay(const DelaunayOptions& options) {
  if (options.stats && options.output == "-")
    throw UsageError("--stats and --output - both want standard output");
  const auto start = Clock::now();
  Cost cost;
  PointTable table = options.input.read();
  cost.read = seconds_since(start);
  if (!options.output.empty()) check_complex_output(options.output, options.output_format, table.dimension);
  if (options.threads > threads_used && !options.quiet)
    fmt::print(stderr, "delone: note: this version builds with one thread, not {}\n", options.threads);

  const auto build_start = Clock::now();
  const std::unique_ptr<const Triangulation> built = build(table, options);
  const Triangulation& triangulation = *built;
  cost.build = seconds_since(build_start);

  std::string hash;
  if (options.output.empty()) {
    table = {};
    cost.close(start);
    hash = triangulation.hash().hex();
  } else {
    const auto write_start = Clock::now();
    ComplexData data = triangulation.to_data(false);
    data.points = std::move(table.coordinates);
    write_complex_output(options.output, data, options.output_format);
    cost.write = seconds_since(write_start);
    cost.close(start);
    if (options.stats) hash = canonical_hash(data).hex();
  }
  if (options.stats) {
    print_output(stats_json(triangulation, hash, cost, options).dump(2) + "\n");
  } else if (options.output.empty()) {
    print_output(summary(triangulation, hash, cost, options));
  }
  return exit_status::ok;
}

}  // namespace

Run add_delaunay(CLI::App& app) {
  auto options = std::make_shared<DelaunayOptions>();
  options->input.add_to(app, "IN", "Points: a file, or - for standard input");
  app.add_option("-o,--output", options->output,
                 "Write the triangulation there; without it a summary is printed")
      ->type_name("OUT");
  app.add_option("--output-format", options->output_format, "Format of OUT, if not told by its extension")
      ->check(CLI::IsMember(complex_formats()));
  app.add_option("--threads", options->threads, "At most this many threads")->check(CLI::Range(1, 65536));
  add_seed(app, options->seed, "Seed of the insertion order; the result does not depend on it");
  app.add_option("--order", options->order, "Insertion order; the result does not depend on it")
      ->check(CLI::IsMember({"automatic", "given", "shuffled"}));
  app.add_flag("--furthest-site", options->furthest_site,
               "The furthest-site triangulation: spheres that have all points inside, instead of none");
  app.add_flag("--runtime-dimension", options->runtime_dimension,
               "Use the engine that is not compiled for one dimension");
  app.add_flag("--stats", options->stats,
               "Print one JSON object about the result and its cost, and nothing else");
  app.add_flag("-q,--quiet", options->quiet, "No progress bar, no notes");
  return [options] { return run_delaunay(*options); };
}

}  // namespace delone::cli
