// SPDX-License-Identifier: BSD-3-Clause
#include "base/require_tolerance.hpp"

#include <delone/error.hpp>

#include <cmath>

namespace delone::internal {

void require_tolerance(double tolerance, const std::string& what) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance))
    throw Error(Errc::invalid_argument, "the tolerance of " + what +
                                            " must be a finite distance of at least 0, not " +
                                            std::to_string(tolerance));
}

void require_tolerance_within(double tolerance, std::span<const double> points, std::size_t d,
                              const std::string& what) {
  if (points.size() < 2 * d) return;
  for (std::size_t j = 0; j < d; ++j) {
    double low = std::nan(""), high = low;
    for (std::size_t i = j; i < points.size(); i += d) {
      low = std::fmin(low, points[i]);
      high = std::fmax(high, points[i]);
    }
    if (tolerance <= high - low) return;
  }
  throw Error(Errc::invalid_argument, "the tolerance of " + what +
                                          " must not be larger than the longest side of the bounding box of "
                                          "the points");
}

}  // namespace delone::internal
