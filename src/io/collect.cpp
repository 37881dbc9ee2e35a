// SPDX-License-Identifier: BSD-3-Clause
// Collecting points; values that are not finite. See collect.hpp.
#include "io/collect.hpp"

#include "io/file.hpp"
#include "messages/in_quotes.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace delone::io {

bool is_missing(std::string_view field) {
  static constexpr std::string_view words[] = {"",         "#n/a", "#n/a n/a", "#na",     "-",    "-1.#ind",
                                               "-1.#qnan", "-nan", "1.#ind",   "1.#qnan", "<na>", "n/a",
                                               "na",       "nan",  "none",     "null"};
  if (field.size() > std::string_view("#n/a n/a").size()) return false;
  std::string lower(field);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return std::find(std::begin(words), std::end(words), lower) != std::end(words);
}

std::string describe_not_finite(std::string_view text) {
  const bool decimal = text.find_first_of("0123456789") != std::string_view::npos;
  return messages::in_quotes(text) +
         (decimal ? " is beyond the range of double precision" : " is not finite");
}

void require_finite(std::span<const double> coordinates, int dimension, const std::string& name,
                    const std::string& first, std::size_t first_row, Missing missing) {
  std::vector<std::size_t> rows;
  bool only_missing = true;
  std::string message = first;
  const auto width = static_cast<std::size_t>(dimension);
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (!is_refused(coordinates[i], missing)) continue;
    only_missing = only_missing && std::isnan(coordinates[i]);
    const std::size_t row = first_row + i / width;
    if (message.empty())
      message = fmt::format("{}: row {}: column {}: {} is not finite", name, row, i % width, coordinates[i]);
    if (rows.empty() || rows.back() != row) rows.push_back(row);
  }
  if (rows.empty()) return;
  if (rows.size() > 1)
    message += fmt::format(" (and {} more row{})", rows.size() - 1, rows.size() == 2 ? "" : "s");
  if (only_missing) throw MissingValue(Errc::not_finite, message, std::move(rows));
  throw Error(Errc::not_finite, message, std::move(rows));
}

void leave_out_missing(PointTable& table) {
  const auto width = static_cast<std::ptrdiff_t>(table.dimension);
  const auto is_nan = [](double value) { return std::isnan(value); };
  auto end = table.coordinates.begin();
  const std::size_t n = table.num_points();
  for (std::size_t row = 0; row < n; ++row) {
    const auto from = table.coordinates.begin() + static_cast<std::ptrdiff_t>(row) * width;
    if (std::any_of(from, from + width, is_nan))
      table.skipped_rows.push_back(row);
    else
      end = end == from ? from + width : std::copy(from, from + width, end);
  }
  table.coordinates.erase(end, table.coordinates.end());
}

double read_coordinate(TextCursor& at, const PointCollector& points) {
  double value = 0;
  if (at.try_number(value)) return value;
  const char* const start = at.position();
  const bool missing = is_missing(at.token());
  if (missing && points.missing() == Missing::left_out) return std::numeric_limits<double>::quiet_NaN();
  at.move_to(start);
  try {
    return at.number("a coordinate");
  } catch (const Error& e) {
    if (missing) throw MissingValue(e.code(), e.what());
    throw;
  }
}

/// Moves what parts have written up to `end`, where it belongs: lines without a point have left gaps.
void PointCollector::close_gaps(std::span<const PointCollector> parts, std::size_t end) {
  for (const PointCollector& part : parts) {
    double* const to = table.coordinates.data() + end;
    if (to != part.room_) std::copy(part.room_, part.end_, to);
    end += static_cast<std::size_t>(part.end_ - part.room_);
    if (first_.empty()) first_ = part.first_;
  }
  table.coordinates.resize(end);
}

PointTable PointCollector::finish(std::size_t first_row) {
  if (!first_.empty()) require_finite(table.coordinates, table.dimension, {}, first_, first_row, missing_);
  return std::move(table);
}

}  // namespace delone::io
