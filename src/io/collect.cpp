// SPDX-License-Identifier: BSD-3-Clause
// Collecting points; values that are not finite. See collect.hpp.
#include "io/collect.hpp"

#include "io/file.hpp"
#include "messages/in_quotes.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace delone::io {

std::string describe_not_finite(std::string_view text) {
  const bool decimal = text.find_first_of("0123456789") != std::string_view::npos;
  return messages::in_quotes(text) +
         (decimal ? " is beyond the range of double precision" : " is not finite");
}

void require_finite(std::span<const double> coordinates, int dimension, const std::string& name,
                    const std::string& first, std::size_t first_row) {
  std::vector<std::size_t> rows;
  std::string message = first;
  const auto width = static_cast<std::size_t>(dimension);
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (std::isfinite(coordinates[i])) continue;
    const std::size_t row = first_row + i / width;
    if (message.empty())
      message = fmt::format("{}: row {}: column {}: {} is not finite", name, row, i % width, coordinates[i]);
    if (rows.empty() || rows.back() != row) rows.push_back(row);
  }
  if (rows.empty()) return;
  if (rows.size() > 1)
    message += fmt::format(" (and {} more row{})", rows.size() - 1, rows.size() == 2 ? "" : "s");
  throw Error(Errc::not_finite, message, std::move(rows));
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
  if (!first_.empty()) require_finite(table.coordinates, table.dimension, {}, first_, first_row);
  return std::move(table);
}

}  // namespace delone::io
