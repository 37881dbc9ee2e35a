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

/// The numbers of lattice vectors that --periodic names: letters of x, y and z, or numbers and commas.
std::vector<std::size_t> chosen_axes(const std::string& text, std::size_t count) {
  std::vector<std::size_t> axes;
  const auto add = [&](std::size_t axis) {
    if (axis >= count)
      throw UsageError(fmt::format("--periodic {}: there are {} lattice vectors", text, count));
    if (std::find(axes.begin(), axes.end(), axis) != axes.end())
      throw UsageError(fmt::format("--periodic {}: each direction once", text));
    axes.push_back(axis);
  };
  if (text.empty()) throw UsageError("--periodic '': at least one direction");
  constexpr std::string_view letters = "xyz";
  if (text.find_first_not_of(letters) == std::string::npos) {
    for (const char letter : text) add(letters.find(letter));
    return axes;
  }
  for (const std::string& item : split_list(text)) {
    const auto number = parse_count(item);
    if (!number)
      throw UsageError(
          fmt::format("--periodic {}: letters of xyz, or numbers from 0 separated by commas", text));
    add(*number);
  }
  return axes;
}

/// Lengths or a length, as vectors; none if the text is something else.
std::vector<double> vectors_of_lengths(const std::string& text, std::size_t d) {
  std::vector<double> lengths;
  for (const std::string& item : split_list(text)) {
    const auto length = parse_real(item);
    if (!length) return {};
    lengths.push_back(*length);
  }
  if (std::any_of(lengths.begin(), lengths.end(), [](double length) { return !(length > 0); }))
    throw UsageError(fmt::format("--lattice {}: lengths are above 0", text));
  if (lengths.size() == 1) lengths.resize(d, lengths[0]);
  if (lengths.size() != d)
    throw UsageError(
        fmt::format("--lattice {}: {} lengths for points of dimension {}", text, lengths.size(), d));
  return Lattice::box(lengths).vectors;
}

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
  auto* const given =
      command
          .add_option("--lattice", lattice,
                      "Triangulate the points and all their translates: a length, the lengths of "
                      "a box separated by commas, or a file with a lattice vector per row")
          ->type_name("LENGTHS|FILE");
  command
      .add_option("--periodic", axes,
                  "The directions, among those of the lattice, that are periodic: xyz, xy, ..., or 0,1,... "
                  "(by default all)")
      ->type_name("AXES")
      ->needs(given);
  command
      .add_option(
          "--unit", unit,
          "Coordinates are multiples of this number, such as 0.001, so that ties of decimal numbers are "
          "ties")
      ->type_name("LENGTH")
      ->needs(given);
  command.add_flag("--exact", exact, "Refuse points that are not on the grid of the box")->needs(given);
}

PeriodicOptions PeriodicInput::options() const {
  if (unit && !(*unit > 0 && std::isfinite(*unit)))
    throw UsageError(fmt::format("--unit {}: a finite length above 0", *unit));
  return {.exact = exact, .unit = unit.value_or(0)};
}

Lattice PeriodicInput::read(int dimension) const {
  const auto d = static_cast<std::size_t>(dimension);
  Lattice all{dimension, vectors_of_lengths(lattice, d)};
  if (all.vectors.empty()) {
    if (std::error_code error; lattice != "-" && !std::filesystem::exists(lattice, error))
      throw Error(Errc::cannot_open,
                  fmt::format("--lattice {}: neither lengths nor a file", input_name(lattice)));
    const PointTable rows = about("--lattice", [&] { return read_points(lattice); });
    if (rows.dimension != dimension)
      throw UsageError(fmt::format("--lattice {}: vectors of {} numbers for points of dimension {}",
                                   input_name(lattice), rows.dimension, dimension));
    all.vectors = rows.coordinates;
  }
  if (!axes) return all;
  Lattice chosen{dimension, {}};
  for (const std::size_t axis : chosen_axes(*axes, static_cast<std::size_t>(all.rank()))) {
    const auto first = all.vectors.begin() + static_cast<std::ptrdiff_t>(axis * d);
    chosen.vectors.insert(chosen.vectors.end(), first, first + static_cast<std::ptrdiff_t>(d));
  }
  return chosen;
}

Lattice PeriodicInput::lattice_of_tiles() const {
  if (!is_wanted()) return {};
  const std::vector<std::string> items = split_list(lattice);
  if (std::all_of(items.begin(), items.end(), [](const std::string& item) { return parse_real(item); })) {
    if (items.size() == 1)
      throw UsageError(
          fmt::format("--lattice {}: tiles take a length per axis, separated by commas", lattice));
    return read(static_cast<int>(items.size()));
  }
  if (std::error_code error; !std::filesystem::exists(lattice, error))
    throw Error(Errc::cannot_open,
                fmt::format("--lattice {}: neither lengths nor a file", input_name(lattice)));
  return read(about("--lattice", [&] { return read_points(lattice); }).dimension);
}

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
