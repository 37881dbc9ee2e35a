// SPDX-License-Identifier: BSD-3-Clause
#include "periodic.hpp"

#include "interrupt.hpp"
#include "numbers.hpp"
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>

namespace delone::cli {

namespace {

std::shared_ptr<const PeriodicTriangulation> triangulate(const PointTable& table,
                                                         const std::vector<double>* weights,
                                                         const Lattice& lattice, const PeriodicOptions& how,
                                                         const Options& options) {
  const PointsView points(table.coordinates, table.dimension);
  if (weights != nullptr) return std::make_shared<PeriodicRegular<>>(points, *weights, lattice, how, options);
  return std::make_shared<PeriodicDelaunay<>>(points, lattice, how, options);
}

}  // namespace

void PeriodicInput::add_to(CLI::App& command) {
  auto* const given = LatticeInput::add_to(command);
  command.add_flag("--exact", exact, "Refuse points that are not on the grid of the box")->needs(given);
}

PeriodicOptions PeriodicInput::options() const { return {.exact = exact, .unit = unit_or_0()}; }

Counts counts_of(const PeriodicTriangulation& t, std::string hash) {
  return {t.dimension(),
          t.affine_dimension(),
          t.num_points(),
          t.num_vertices(),
          t.num_duplicates(),
          t.num_cells(),
          0,
          std::move(hash)};
}

void add_periodic(Json& json, const PeriodicTriangulation& t) {
  json["periodic_directions"] = t.rank();
  json["displacement"] = t.displacement();
  json["ghosts"] = t.num_ghosts();
}

Summary& add_periodic(Summary& summary, const PeriodicTriangulation& t) {
  return summary.line("periodic", counted(static_cast<std::size_t>(t.rank()), "direction"))
      .line("displacement", fmt::format("{}", t.displacement()));
}

int run_periodic(const char* command, const PointInput& input, const PointTable& table,
                 const std::vector<double>* weights, const PeriodicInput& periodic, const BuildOptions& build,
                 Clock::time_point start, Cost cost) {
  const bool writes = !build.output.empty();
  if (writes) {
    const std::string format = chosen_format(build.output, build.output_format);
    if (format != "npz" && format != "json")
      throw Error(Errc::unsupported,
                  fmt::format("{}: a periodic triangulation is written as npz or json, not as {}",
                              output_name(build.output), format));
    check_complex_output(build.output, build.output_format, table.dimension);
  }
  const Lattice lattice = periodic.read(table.dimension);
  auto stage_start = Clock::now();
  const auto triangulation = about(input_name(input.path), [&] {
    ProgressBar bar(build.quiet);
    const StageGuard guard(Stage::building);
    return triangulate(table, weights, lattice, periodic.options(), build.to_options(bar));
  });
  cost.build = seconds_since(stage_start);
  stage_start = Clock::now();
  if (writes) {
    ComplexData data = triangulation->to_data();
    data.column_names = table.column_names;
    write_output(build.output, data, build.output_format);
  }
  cost.write = seconds_since(stage_start);
  cost.close(start);
  print_report(
      build, writes,
      [&] {
        Json json = stats_of(command, counts_of(*triangulation, triangulation->hash().hex()),
                             triangulation->statistics(), cost, build.seed);
        add_periodic(json, *triangulation);
        json["is_simplicial"] = triangulation->is_simplicial();
        return json;
      },
      [&] {
        const Counts counts = counts_of(*triangulation, triangulation->hash().hex());
        Summary summary(input.path, fmt::format("periodic {} triangulation of {} in dimension {}",
                                                weights != nullptr ? "regular" : "Delaunay",
                                                counted(counts.points, "point"), counts.dimension));
        summary.affine_dimension(counts.affine_dimension, counts.dimension, "triangulated inside its flat");
        return add_periodic(summary, *triangulation)
            .line("vertices", fmt::format("{} ({} hidden, {} duplicate points)", counts.vertices,
                                          num_hidden(counts), counts.duplicates))
            .line("cells",
                  fmt::format("{}{}", counts.cells,
                              triangulation->is_simplicial() ? "" : " (not told by their points alone)"))
            .line("hash", counts.hash)
            .cost(triangulation->statistics(), cost);
      });
  return exit_status::ok;
}

}  // namespace delone::cli
