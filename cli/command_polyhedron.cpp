// SPDX-License-Identifier: BSD-3-Clause
// delone polyhedron: inequalities to vertices, rays and lines, and back, exactly.
#include "interrupt.hpp"
#include "memory_limit.hpp"
#include "report.hpp"

#include <delone/polyhedron_io.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace delone::cli {
namespace {

struct PolyhedronOptions {
  std::string path;
  std::uint64_t max_stream = default_max_stream_bytes;
  BuildOptions build;
};

Json stats(const Polyhedron& found, const Cost& cost) {
  Json json;
  json["command"] = "polyhedron";
  json["dimension"] = found.dimension();
  json["affine_dimension"] = found.affine_dimension();
  json["vertices"] = found.num_vertices();
  json["rays"] = found.num_rays();
  json["lines"] = found.num_lines();
  json["inequalities"] = found.num_inequalities();
  json["equations"] = found.num_equations();
  json["redundant_rows"] = found.redundant_rows().size();
  json["hash"] = found.hash().hex();
  json["seconds"] = {
      {"read", cost.read}, {"build", cost.build}, {"write", cost.write}, {"total", cost.total}};
  json["peak_rss_bytes"] = cost.peak_rss_bytes;
  return json;
}

Summary summary(const Polyhedron& found, const Cost& cost, const PolyhedronOptions& options) {
  Summary summary(options.path, fmt::format("polyhedron in dimension {}", found.dimension()));
  if (found.is_empty())
    summary.line("empty", "no point satisfies all conditions");
  else
    summary.affine_dimension(found.affine_dimension(), found.dimension(), "flat: it has equations");
  summary.line("vertices", fmt::format("{}", found.num_vertices()))
      .line("bounded", found.is_bounded()
                           ? "yes"
                           : fmt::format("no: {} rays, {} lines", found.num_rays(), found.num_lines()))
      .line("facets", fmt::format("{}", found.num_inequalities()))
      .line("equations", fmt::format("{}", found.num_equations()))
      .line("redundant rows", fmt::format("{}", found.redundant_rows().size()));
  return summary.line("time", fmt::format("{:.3f} s", cost.total));
}

int run_polyhedron(const PolyhedronOptions& options) {
  const BuildOptions& build = options.build;
  const std::string name = input_name(options.path);
  protect_files({options.path}, build.outputs(), build.force);
  const bool writes = !build.output.empty();
  const MemoryLimit limit(name, build.memory);
  const auto start = Clock::now();
  Cost cost;
  const PolyhedronRows rows = about(name, [&] { return read_polyhedron(options.path, options.max_stream); });
  cost.read = seconds_since(start);
  if (writes)
    check_output(build.output, build.output_format,
                 [](const std::string& nowhere, const std::string& format) {
                   write_polyhedron(nowhere, Polyhedron(), format);
                 });
  ProgressBar bar(build.quiet);
  const auto build_start = Clock::now();
  const Polyhedron found = [&] {
    const StageGuard guard(Stage::building);
    const Options how = build.to_options(bar);
    return about(name, [&] { return to_polyhedron(rows, how); });
  }();
  cost.build = seconds_since(build_start);
  bar.clear();
  if (writes) {
    const auto write_start = Clock::now();
    const StageGuard guard(stage_of_writing(build.output));
    about(output_name(build.output), [&] { write_polyhedron(build.output, found, build.output_format); });
    cost.write = seconds_since(write_start);
  }
  cost.close(start);
  print_report(
      build, writes, [&] { return stats(found, cost); }, [&] { return summary(found, cost, options); });
  return exit_status::ok;
}

}  // namespace

Run add_polyhedron(CLI::App& app) {
  auto options = std::make_shared<PolyhedronOptions>();
  app.add_option("IN", options->path,
                 "Inequalities or generators in the form of cddlib and lrs; a file, or - for standard input")
      ->required();
  add_max_stream(app, options->max_stream);
  options->build.add_output(app, "a description", {"ine", "ext"});
  app.add_flag("--stats", options->build.stats,
               "Print one JSON object about the result and its cost, and nothing else");
  add_threads(app, options->build.threads);
  options->build.add_limits(app, "the polyhedron");
  return [options] { return run_polyhedron(*options); };
}

}  // namespace delone::cli
