// SPDX-License-Identifier: BSD-3-Clause
#include "base/require_finite.hpp"

#include <delone/error.hpp>

#include <cmath>

namespace delone::internal {

std::vector<std::size_t> find_not_finite(std::span<const double> numbers, std::size_t width) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (const std::size_t row = i / width; !std::isfinite(numbers[i]) && (rows.empty() || rows.back() != row))
      rows.push_back(row);
  return rows;
}

std::string and_of_more(std::span<const std::size_t> rows) {
  return rows.size() < 2 ? "" : " (and of " + std::to_string(rows.size() - 1) + " more)";
}

void require_finite(std::span<const double> numbers, std::size_t width, std::string_view what,
                    std::string_view item) {
  const std::vector<std::size_t> rows = find_not_finite(numbers, width);
  if (rows.empty()) return;
  throw Error(Errc::not_finite,
              std::string(what) + " of " + std::string(item) + " " + std::to_string(rows.front()) +
                  " is not finite" + and_of_more(rows),
              rows);
}

}  // namespace delone::internal
