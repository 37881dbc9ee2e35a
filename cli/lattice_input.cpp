// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_input.hpp"

#include "command.hpp"
#include "numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

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

void require_file(const std::string& lattice) {
  if (std::error_code error; !std::filesystem::exists(lattice, error))
    throw Error(Errc::cannot_open,
                fmt::format("--lattice {}: neither lengths nor a file", input_name(lattice)));
}

}  // namespace

CLI::Option* LatticeInput::add_to(CLI::App& command) {
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
  return given;
}

Lattice LatticeInput::read(int dimension) const {
  const auto d = static_cast<std::size_t>(dimension);
  Lattice all{dimension, vectors_of_lengths(lattice, d)};
  if (all.vectors.empty()) {
    if (lattice != "-") require_file(lattice);
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

Lattice LatticeInput::of_tiles() const {
  if (!is_wanted()) return {};
  const std::vector<std::string> items = split_list(lattice);
  if (std::all_of(items.begin(), items.end(), [](const std::string& item) { return parse_real(item); })) {
    if (items.size() == 1)
      throw UsageError(
          fmt::format("--lattice {}: tiles take a length per axis, separated by commas", lattice));
    return read(static_cast<int>(items.size()));
  }
  require_file(lattice);
  return read(about("--lattice", [&] { return read_points(lattice); }).dimension);
}

double LatticeInput::unit_or_0() const {
  if (unit && !(*unit > 0 && std::isfinite(*unit)))
    throw UsageError(fmt::format("--unit {}: a finite length above 0", *unit));
  return unit.value_or(0);
}

}  // namespace delone::cli
