// SPDX-License-Identifier: BSD-3-Clause
#include "box_option.hpp"

#include "command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace delone::cli {

std::optional<Box> chosen_box(const std::vector<double>& limits, int dimension) {
  if (limits.empty()) return std::nullopt;
  const auto d = static_cast<std::size_t>(dimension);
  if (limits.size() != 2 * d)
    throw UsageError(fmt::format(
        "--box takes {} numbers for dimension {}: all lower limits, then all upper ones; {} were given",
        2 * d, dimension, limits.size()));
  Box box;
  for (std::size_t j = 0; j < d; ++j) {
    if (!std::isfinite(limits[j]) || !std::isfinite(limits[d + j]) || !(limits[j] < limits[d + j]))
      throw UsageError(fmt::format("--box: the limits along axis {} must be finite, low below high", j));
    box.low.push_back(limits[j]);
    box.high.push_back(limits[d + j]);
  }
  return box;
}

}  // namespace delone::cli
