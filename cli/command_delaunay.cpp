// SPDX-License-Identifier: BSD-3-Clause
// delone delaunay: points in, triangulation out, and what it cost.
#include "interrupt.hpp"
#include "report.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <utility>

namespace delone::cli {
namespace {

struct DelaunayOptions {
  PointInput input;
  BuildOptions build;
  int threads = 1;
  bool runtime_dimension = false, furthest_site = false;
};

Summary summary(const Triangulation& t, const Counts& counts, const Cost& cost,
                const DelaunayOptions& options) {
  const char* kind = options.furthest_site ? "furthest-site Delaunay" : "Delaunay";
  return Summary(options.input.path, fmt::format("{} triangulation of {} points in dimension {}", kind,
                                                 counts.points, counts.dimension))
      .triangulation(counts)
      .cost(t.statistics(), cost);
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
  const Product triangulation = build<Product>(table, options);
  cost.build = seconds_since(build_start);

  std::string hash;
  if (writes) {
    const auto write_start = Clock::now();
    ComplexData data = triangulation.to_data(false);
    data.points = std::move(table.coordinates);
    write_output(to.output, data, to.output_format);
    cost.write = seconds_since(write_start);
    cost.close(start);
    if (to.stats) hash = canonical_hash(data).hex();
  } else {
    table = {};
    cost.close(start);
    hash = triangulation.hash().hex();
  }
  const Counts counts = counts_of(triangulation, hash);
  print_report(
      to, writes, [&] { return stats_of("delaunay", counts, triangulation.statistics(), cost, to.seed); },
      [&] { return summary(triangulation, counts, cost, options); });
  return exit_status::ok;
}

int run_delaunay(const DelaunayOptions& options) {
  const BuildOptions& to = options.build;
  to.check();
  const auto start = Clock::now();
  Cost cost;
  PointTable table = options.input.read();
  cost.read = seconds_since(start);
  if (!to.output.empty()) check_complex_output(to.output, to.output_format, table.dimension);
  if (options.threads > threads_used && !to.quiet)
    fmt::print(stderr, "delone: note: this version builds with one thread, not {}\n", options.threads);
  return options.furthest_site ? run_with<FurthestSite<>>(std::move(table), options, start, cost)
                               : run_with<Delaunay<>>(std::move(table), options, start, cost);
}

}  // namespace

Run add_delaunay(CLI::App& app) {
  auto options = std::make_shared<DelaunayOptions>();
  options->input.add_to(app, "IN", "Points: a file, or - for standard input");
  options->build.add_output(app, "the triangulation", complex_formats());
  app.add_option("--threads", options->threads, "At most this many threads")->check(CLI::Range(1, 65536));
  app.add_flag("--furthest-site", options->furthest_site,
               "The furthest-site triangulation: spheres that have all points inside, instead of none");
  app.add_flag("--runtime-dimension", options->runtime_dimension,
               "Use the engine that is not compiled for one dimension");
  options->build.add_construction(app);
  return [options] { return run_delaunay(*options); };
}

}  // namespace delone::cli
