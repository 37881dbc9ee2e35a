// SPDX-License-Identifier: BSD-3-Clause
#include "base/require_finite.hpp"

#include <delone/error.hpp>

#include <cmath>
#include <vector>

namespace delone::internal {

void require_finite(std::span<const double> numbers, std::size_t width, const std::string& what,
                    const std::string& item) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (const std::size_t row = i / width; !std::isfinite(numbers[i]) && (rows.empty() || rows.back() != row))
      rows.push_back(row);
  if (rows.empty()) return;
  std::string more;
  if (rows.size() > 1) more = " (and of " + std::to_string(rows.size() - 1) + " more)";
  throw Error(Errc::not_finite,
              what + " of " + item + " " + std::to_string(rows.front()) + " is not finite" + more, rows);
}

}  // namespace delone::internal
