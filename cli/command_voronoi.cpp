// SPDX-License-Identifier: BSD-3-Clause
// delone voronoi, delone power: points in, Voronoi or power diagram out, and what it cost.
#include "command.hpp"
#include "cost.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "progress_bar.hpp"
#include "weighted_input.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

namespace delone::cli {
namespace {

struct VoronoiOptions {
  WeightedInput weighted;  // the points; of a power diagram with weights
  bool power = false;
  std::string output, output_format, volumes;
  std::vector<double> box;  // low by axis, then high
  std::uint64_t seed = 0;
  bool stats = false, quiet = false;
};

const std::vector<std::string>& voronoi_formats() {
  static const std::vector<std::string> formats{"npz", "json", "svg", "vtu"};
  return formats;
}

struct DiagramCost : Cost {
  double diagram = 0;
};

/// The box of --box; none if it was not given. Checked before the work.
std::optional<Box> chosen_box(const VoronoiOptions& options, int dimension) {
  if (options.box.empty()) return std::nullopt;
  const auto d = static_cast<std::size_t>(dimension);
  if (options.box.size() != 2 * d)
    throw UsageError(fmt::format(
        "--box takes {} numbers for dimension {}: all lower limits, then all upper ones; {} were given",
        2 * d, dimension, options.box.size()));
  Box box;
  for (std::size_t j = 0; j < d; ++j) {
    if (!std::isfinite(options.box[j]) || !std::isfinite(options.box[d + j]) ||
        !(options.box[j] < options.box[d + j]))
      throw UsageError(fmt::format("--box: the limits along axis {} must be finite, low below high", j));
    box.low.push_back(options.box[j]);
    box.high.push_back(options.box[d + j]);
  }
  return box;
}

/// Throws what the writing would throw in the end, before the work.
void check_outputs(const VoronoiOptions& options, int dimension) {
  for (const std::string& path : {options.output, options.volumes})
    if (!path.empty()) check_writable(path);
  if (options.output.empty()) return;
  const std::string name = options.output == "-" ? "standard output" : options.output;
  std::string format = options.output_format;
  if (format.empty()) {
    format = std::filesystem::path(options.output).extension().string();
    if (options.output == "-" || format.size() < 2)
      throw Error(Errc::unsupported, name + ": name the format with --output-format");
    format.erase(0, 1);
  }
  try {
    write_voronoi("/dev/null", VoronoiDiagram(Triangulation(dimension)), nullptr, format);
  } catch (const Error& e) {
    std::string message = e.what();
    if (message.rfind("/dev/null", 0) == 0) message.replace(0, 9, name);
    throw Error(e.code(), message);
  }
}

nlohmann::ordered_json stats_json(const Triangulation& t, const VoronoiDiagram& diagram,
                                  const DiagramCost& cost, const VoronoiOptions& options) {
  const Statistics s = t.statistics();
  const std::size_t num_cells = t.complex().num_cells();
  nlohmann::ordered_json json;
  json["command"] = options.power ? "power" : "voronoi";
  json["dimension"] = t.dimension();
  json["affine_dimension"] = t.affine_dimension();
  json["points"] = t.num_points();
  json["vertices"] = t.num_vertices();
  json["duplicates"] = t.num_duplicates();
  json["hidden"] = t.num_points() - t.num_vertices() - t.num_duplicates();
  json["cells"] = t.num_finite_cells();
  json["infinite_cells"] = t.num_infinite_cells();
  json["hash"] = t.hash().hex();
  json["voronoi_vertices"] = diagram.num_vertices();
  json["regions"] = diagram.num_regions();
  json["unbounded_regions"] = diagram.num_unbounded_regions();
  json["ridges"] = diagram.num_ridges();
  json["rays"] = diagram.num_rays();
  add_cost(json, s, num_cells, cost, options.seed);
  json["seconds"]["diagram"] = cost.diagram;
  return json;
}

std::string summary(const Triangulation& t, const VoronoiDiagram& diagram, const DiagramCost& cost,
                    const VoronoiOptions& options) {
  std::string text =
      fmt::format("{}: {} of {} points in dimension {}\n", input_name(options.weighted.input.path),
                  options.power ? "power diagram" : "Voronoi diagram", t.num_points(), t.dimension());
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<18}{}\n", what, value);
  };
  line("affine dimension",
       fmt::format("{}{}", t.affine_dimension(),
                   t.affine_dimension() < 0               ? " (no points)"
                   : t.affine_dimension() < t.dimension() ? " (flat: the diagram inside the flat)"
                                                          : ""));
  line("regions", fmt::format("{}, {} of them unbounded ({}{} duplicate points)", diagram.num_regions(),
                              diagram.num_unbounded_regions(),
                              options.power ? fmt::format("{} hidden, ", t.num_points() - t.num_vertices() -
                                                                             t.num_duplicates())
                                            : std::string(),
                              t.num_duplicates()));
  line(options.power ? "power vertices" : "Voronoi vertices",
       fmt::format("{} of {} cells", diagram.num_vertices(), t.num_finite_cells()));
  line("ridges", fmt::format("{}, and {} rays", diagram.num_ridges(), diagram.num_rays()));
  line("time", fmt::format("{:.3f} s (reading {:.3f}, triangulating {:.3f}, diagram {:.3f})", cost.total,
                           cost.read, cost.build, cost.diagram));
  line("peak memory", fmt::format("{:.1f} MB", static_cast<double>(cost.peak_rss_bytes) / 1e6));
  return text;
}

/// One line per region: the row of its point, and its volume.
std::string volumes_text(const VoronoiDiagram& diagram, const std::optional<Box>& box) {
  const std::vector<double> volumes = box ? diagram.region_volumes(*box) : diagram.region_volumes();
  std::string text = "point,volume\n";
  for (std::size_t r = 0; r < volumes.size(); ++r)
    text += fmt::format("{},{}\n", diagram.region_points()[r], volumes[r]);
  return text;
}

/// The triangulation by `build`, its diagram, and what was asked for.
template <class Build>
int run_with(Build build, const std::optional<Box>& box, DiagramCost cost, Clock::time_point start,
             const VoronoiOptions& options) {
  const std::string name = input_name(options.weighted.input.path);
  auto stage_start = Clock::now();
  const auto triangulation = about(name, [&] {
    ProgressBar bar(options.quiet);
    const StageGuard guard(Stage::building);
    Options build_options;
    build_options.seed = options.seed;
    build_options.progress = bar.callback();
    return build(build_options);
  });
  cost.build = seconds_since(stage_start);

  stage_start = Clock::now();
  using Diagram = std::conditional_t<WeightedTriangulation<std::decay_t<decltype(triangulation)>>,
                                     PowerDiagram, VoronoiDiagram>;
  const auto diagram = about(name, [&] { return Diagram(triangulation); });
  const std::string volumes =
      options.volumes.empty() ? "" : about(options.volumes, [&] { return volumes_text(diagram, box); });
  cost.diagram = seconds_since(stage_start);

  stage_start = Clock::now();
  if (!options.output.empty())
    write_voronoi_output(options.output, diagram, box ? &*box : nullptr, options.output_format);
  if (!options.volumes.empty()) write_text(options.volumes, volumes);
  cost.write = seconds_since(stage_start);
  cost.close(start);
  if (options.stats)
    print_output(stats_json(triangulation, diagram, cost, options).dump(2) + "\n");
  else if (options.output.empty() && options.volumes.empty())
    print_output(summary(triangulation, diagram, cost, options));
  return exit_status::ok;
}

int run_voronoi(const VoronoiOptions& options) {
  if (options.stats && (options.output == "-" || options.volumes == "-"))
    throw UsageError("--stats wants standard output for itself");
  if (options.output == "-" && options.volumes == "-")
    throw UsageError("--output - and --volumes - both want standard output");
  const auto start = Clock::now();
  DiagramCost cost;
  std::vector<double> weights;
  PointTable table = options.power ? options.weighted.read(weights) : options.weighted.input.read();
  cost.read = seconds_since(start);
  check_outputs(options, table.dimension);
  const std::optional<Box> box = chosen_box(options, table.dimension);
  const auto taken = [&] { return std::exchange(table, PointTable{}); };  // freed after the triangulation
  if (options.power)
    return run_with(
        [&](const Options& build_options) {
          const PointTable points = taken();
          return RegularTriangulation(points.coordinates, weights, points.dimension, build_options);
        },
        box, cost, start, options);
  return run_with(
      [&](const Options& build_options) {
        const PointTable points = taken();
        return Triangulation(points.coordinates, points.dimension, build_options);
      },
      box, cost, start, options);
}

Run add_diagram(CLI::App& app, bool power) {
  auto options = std::make_shared<VoronoiOptions>();
  options->power = power;
  if (power)
    options->weighted.add_to(app);
  else
    options->weighted.input.add_to(app, "IN", "Points: a file, or - for standard input");
  app.add_option("-o,--output", options->output, "Write the diagram there; without it a summary is printed")
      ->type_name("OUT");
  app.add_option("--output-format", options->output_format, "Format of OUT, if not told by its extension")
      ->check(CLI::IsMember(voronoi_formats()));
  app.add_option("--box", options->box,
                 "Clip pictures and volumes to this box: all lower limits, then all upper ones; pictures are "
                 "clipped to a "
                 "box around the points otherwise")
      ->delimiter(',')
      ->type_name("LOW,...,HIGH,...");
  app.add_option("--volumes", options->volumes, "Write the volume of each region there, as CSV")
      ->type_name("FILE");
  add_seed(app, options->seed, "Seed of the insertion order; the result does not depend on it");
  app.add_flag("--stats", options->stats,
               "Print one JSON object about the result and its cost, and nothing else");
  app.add_flag("-q,--quiet", options->quiet, "No progress bar, no notes");
  return [options] { return run_voronoi(*options); };
}

}  // namespace

Run add_voronoi(CLI::App& app) { return add_diagram(app, false); }
Run add_power(CLI::App& app) { return add_diagram(app, true); }

}  // namespace delone::cli
