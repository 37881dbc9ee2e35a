// SPDX-License-Identifier: BSD-3-Clause
#include "weighted_input.hpp"

#include "messages/in_quotes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

namespace delone::cli {
namespace {

std::optional<std::size_t> as_number(const std::string& text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Removes a column from a table and returns it.
std::vector<double> take_column(PointTable& table, std::size_t column) {
  const auto width = static_cast<std::size_t>(table.dimension);
  std::vector<double> taken, rest;
  for (std::size_t i = 0; i < table.coordinates.size(); ++i)
    (i % width == column ? taken : rest).push_back(table.coordinates[i]);
  table.coordinates = std::move(rest);
  --table.dimension;
  if (column < table.column_names.size())
    table.column_names.erase(table.column_names.begin() + static_cast<std::ptrdiff_t>(column));
  return taken;
}

/// Reads the weights of points from a file with one column.
std::vector<double> read_weights(const WeightedInput& from, PointTable& points) {
  PointTable table = from.input.read_beside(from.weights);
  if (table.num_points() > 0 && table.dimension != 1)
    throw Error(Errc::bad_format, fmt::format("{}: expected one {} per row, found {} columns",
                                              input_name(from.weights), from.singular, table.dimension));
  if (num_rows(table) != num_rows(points))
    throw Error(Errc::bad_format,
                fmt::format("{}: expected {} {}, one per point, found {}", input_name(from.weights),
                            num_rows(points), from.plural, num_rows(table)));
  keep_common_rows(points, table);
  return std::move(table.coordinates);
}

}  // namespace

void WeightedInput::add_to(CLI::App& command, bool required) {
  input.add_to(command, "IN", "Points: a file, or - for standard input");
  command
      .add_option(
          option, weights,
          fmt::format("The {}: a column of IN by its name or number from 0, or a file with one per row",
                      plural))
      ->required(required)
      ->type_name("COLUMN|FILE");
}

std::string WeightedInput::column() const {
  if (names_a_file(weights))
    throw UsageError(
        fmt::format("--weights {}: the weights of tiles are a column of the points", input_name(weights)));
  return weights;
}

PointTable WeightedInput::read(std::vector<double>& weights_read, unsigned threads) const {
  const std::optional<std::size_t> number = as_number(weights);
  const std::string name = input_name(input.path);
  const bool is_file = names_a_file(weights);
  if (is_file && weights == "-" && input.path == "-")
    throw UsageError(fmt::format("points and {} cannot both come from standard input", plural));
  PointInput all = input;
  // The chosen columns are the coordinates, so the weight is read after them.
  const bool appended = !is_file && !input.options.columns.empty();
  if (appended) all.options.columns.push_back(weights);
  PointTable table = all.read(threads);
  if (is_file) {
    weights_read = read_weights(*this, table);
    return table;
  }
  std::size_t column = static_cast<std::size_t>(table.dimension) - 1;
  if (!appended && number) {
    column = *number;
  } else if (!appended) {
    const auto found = std::find(table.column_names.begin(), table.column_names.end(), weights);
    if (found == table.column_names.end())
      throw Error(Errc::cannot_open, fmt::format("{}: {} {} is neither a column nor a file", name, option,
                                                 messages::in_quotes(weights)));
    column = static_cast<std::size_t>(found - table.column_names.begin());
  }
  if (column >= static_cast<std::size_t>(table.dimension))
    throw Error(Errc::bad_format, fmt::format("{}: {}: there is no column {}; the columns are 0 to {}", name,
                                              option, column, table.dimension - 1));
  if (table.dimension < 2)
    throw Error(Errc::bad_dimension,
                fmt::format("{}: beside the {} there is no column of coordinates", name, plural));
  weights_read = take_column(table, column);
  return table;
}

}  // namespace delone::cli
