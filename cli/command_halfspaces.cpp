// SPDX-License-Identifier: BSD-3-Clause
// delone halfspaces: inequalities in, the polyhedron that they describe out.
#include "interrupt.hpp"
#include "memory_limit.hpp"
#include "numbers.hpp"
#include "report.hpp"

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <optional>
#include <string_view>

namespace delone::cli {
namespace {

struct HalfspacesOptions {
  PointInput input;
  BuildOptions build;
  std::string interior;
};

/// "1,2.5,-3" as numbers; nothing if it is something else, a path say.
std::optional<std::vector<double>> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  for (;;) {
    const std::string_view field = text.substr(0, text.find(','));
    const std::optional<double> value = parse_real(field);
    if (!value) return std::nullopt;
    numbers.push_back(*value);
    if (field.size() == text.size()) return numbers;
    text.remove_prefix(field.size() + 1);
  }
}

/// The point of --interior: d numbers, or a file with one point.
std::vector<double> interior_point(const HalfspacesOptions& options, int dimension) {
  auto numbers = numbers_in(options.interior);
  if (!numbers) {
    const PointTable table = options.input.read_beside(options.interior);
    if (table.num_points() != 1)
      throw Error(Errc::bad_format, fmt::format("{}: expected one interior point, found {}",
                                                input_name(options.interior), table.num_points()));
    numbers = table.coordinates;
  }
  if (numbers->size() != static_cast<std::size_t>(dimension))
    throw UsageError(
        fmt::format("--interior: expected {} coordinates, found {}", dimension, numbers->size()));
  return *numbers;
}

/// Throws what the writing would throw in the end, as far as that is known before the work.
void check_intersection_output(const BuildOptions& options, int dimension) {
  if (!options.qhull.empty()) {
    const auto d = static_cast<std::size_t>(dimension);
    std::vector<double> simplex((d + 1) * (d + 1), 0);
    for (std::size_t i = 0; i < d; ++i) simplex[i * (d + 1) + i] = -1, simplex[d * (d + 1) + i] = 1;
    simplex.back() = -1;
    return check_qhull_output(options.output, HalfspaceIntersection(simplex, dimension), options.qhull);
  }
  check_output(options.output, options.output_format,
               [&](const std::string& nowhere, const std::string& format) {
                 IntersectionData nothing;
                 nothing.dimension = dimension;
                 nothing.bounded = true;
                 write(nowhere, nothing, format);
               });
}

const char* name_of(IntersectionState state) {
  return state == IntersectionState::full ? "full" : state == IntersectionState::flat ? "flat" : "empty";
}

/// In higher dimensions volumes cost more than the intersection.
bool has_volume(const HalfspaceIntersectionBase& found) {
  return found.is_bounded() && found.dimension() <= 3;
}

Json stats(const HalfspaceIntersectionBase& found, const Cost& cost, std::uint64_t seed) {
  const IntersectionData& data = found.data();
  Json json;
  json["command"] = "halfspaces";
  json["dimension"] = found.dimension();
  json["halfspaces"] = found.num_halfspaces();
  json["state"] = name_of(found.state());
  json["witness"] = data.witness;
  json["rank"] = data.rank;
  json["bounded"] = data.bounded;
  json["interior_point"] = data.interior_point;
  json["vertices"] = data.num_vertices();
  json["directions"] = data.num_directions();
  json["edges"] = data.num_edges();
  json["rays"] = data.num_rays();
  json["facets"] = data.num_facets();
  json["touching"] = found.count(HalfspaceKind::touching);
  json["redundant"] = found.count(HalfspaceKind::redundant);
  json["duplicates"] = found.count(HalfspaceKind::duplicate);
  json["trivial"] = found.count(HalfspaceKind::trivial);
  json["cells"] = found.num_cells();
  json["volume"] =
      number(has_volume(found) ? found.volume().value : std::numeric_limits<double>::quiet_NaN());
  add_cost(json, found.statistics(), found.num_cells(), cost, seed);
  return json;
}

Summary summary(const HalfspaceIntersectionBase& found, const Cost& cost, const HalfspacesOptions& options) {
  const IntersectionData& data = found.data();
  Summary summary(options.input.path, fmt::format("intersection of {} halfspaces in dimension {}",
                                                  found.num_halfspaces(), found.dimension()));
  if (found.state() != IntersectionState::full) {
    summary.line("no interior point", fmt::format("{}: halfspaces {} have none in common",
                                                  name_of(found.state()), fmt::join(data.witness, ", ")));
  } else {
    summary.line("rank", fmt::format("{}{}", data.rank,
                                     data.rank < found.dimension()
                                         ? fmt::format(" (the intersection contains {}-dimensional flats)",
                                                       found.dimension() - data.rank)
                                         : ""));
    summary.line("vertices", fmt::format("{}, {} edges", data.num_vertices(), data.num_edges()));
    summary.line("bounded", data.bounded ? "yes"
                                         : fmt::format("no: {} directions, {} rays", data.num_directions(),
                                                       data.num_rays()));
    summary.line("facets", fmt::format("{}", data.num_facets()));
    summary.line("other halfspaces",
                 fmt::format("{} redundant, {} of them touching; {} duplicates, {} trivial",
                             found.count(HalfspaceKind::redundant) + found.count(HalfspaceKind::touching),
                             found.count(HalfspaceKind::touching), found.count(HalfspaceKind::duplicate),
                             found.count(HalfspaceKind::trivial)));
    if (has_volume(found)) summary.line("volume", fmt::format("{}", found.volume().value));
  }
  return summary.cost(found.statistics(), cost);
}

int run_halfspaces(const HalfspacesOptions& options) {
  const BuildOptions& build = options.build;
  protect_files({options.input.path, options.interior}, build.outputs(), build.force);
  const bool writes = !build.output.empty();
  const MemoryLimit limit(input_name(options.input.path), build.memory);
  const auto start = Clock::now();
  Cost cost;
  const PointTable table = options.input.read();
  cost.read = seconds_since(start);
  const std::string name = input_name(options.input.path);
  if (table.dimension < 2)
    throw Error(Errc::bad_dimension,
                name + ": a halfspace takes two numbers at least, a normal and an offset");
  const int dimension = table.dimension - 1;
  std::vector<double> interior;
  if (!options.interior.empty()) interior = interior_point(options, dimension);
  if (writes) check_intersection_output(build, dimension);
  ProgressBar bar(build.quiet);
  const auto build_start = Clock::now();
  const HalfspaceIntersection<> found = [&] {
    const StageGuard guard(Stage::building);
    const Options how = build.to_options(bar);
    return about(name, [&] {
      return interior.empty() ? HalfspaceIntersection(table.coordinates, dimension, how)
                              : HalfspaceIntersection(table.coordinates, dimension, interior, how);
    });
  }();
  about(name, [&] { found.data(); });
  cost.build = seconds_since(build_start);
  bar.clear();
  if (writes) {
    const auto write_start = Clock::now();
    if (build.qhull.empty())
      write_output(build.output, found.to_data(), build.output_format);
    else
      write_qhull_output(build.output, found, build.qhull);
    cost.write = seconds_since(write_start);
  }
  cost.close(start);
  print_report(
      build, writes, [&] { return stats(found, cost, build.seed); },
      [&] { return summary(found, cost, options); });
  return exit_status::ok;
}

}  // namespace

Run add_halfspaces(CLI::App& app) {
  auto options = std::make_shared<HalfspacesOptions>();
  options->input.add_to(
      app, "IN", "Halfspaces: rows of a normal and an offset, n.x + c <= 0; a file, or - for standard input");
  app.add_option(
         "--interior", options->interior,
         "A point strictly inside all halfspaces: numbers, or a file with one point; found if not given")
      ->type_name("X,Y,...|FILE");
  options->build.add_output(app, "the intersection", {"npz", "json", "off", "html"});
  options->build.add_qhull(app, "qhalf", "o p i Fp Fv Fx Fn");
  options->build.add_construction(app, "the intersection");
  add_threads(app, options->build.threads);
  return [options] { return run_halfspaces(*options); };
}

}  // namespace delone::cli
