// SPDX-License-Identifier: BSD-3-Clause
#include "base/require_tolerance.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace delone::internal {
namespace {

/// The shortest decimal number that is read as x.
std::string shortest_text(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

}  // namespace

void require_tolerance(double tolerance, const std::string& name) {
  if (!(tolerance >= 0) || std::isinf(tolerance))
    throw Error(Errc::invalid_argument, "the " + name + " is " + shortest_text(tolerance) +
                                            ", which is not a finite number from 0 on");
}

void require_time_limit(double seconds) { require_tolerance(seconds, "limit of time"); }

void require_tolerance_within(double tolerance, double extent, const std::string& what) {
  if (extent > 0 && tolerance > extent)
    throw Error(Errc::invalid_argument, "the tolerance, " + shortest_text(tolerance) + ", is larger than " +
                                            what + " " + shortest_text(extent));
}

void require_tolerance_within(double tolerance, std::span<const double> points, std::size_t d,
                              std::span<const double> more_points, std::span<const double> factors) {
  if (tolerance == 0) return;
  double longest = 0;
  for (std::size_t j = 0; j < d; ++j) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::span<const double> part : {points, more_points})
      for (std::size_t i = j; i < part.size(); i += d) {
        low = std::fmin(low, part[i]);
        high = std::fmax(high, part[i]);
      }
    if (!factors.empty()) {
      low *= factors[j];
      high *= factors[j];
      if (low <= high && !(std::isfinite(low) && std::isfinite(high)))
        throw Error(Errc::invalid_argument,
                    "the tolerances of axes differ too much for coordinates as large "
                    "as those of axis " +
                        std::to_string(j));
    }
    longest = std::max(longest, high - low);
  }
  require_tolerance_within(tolerance, longest, "the set of points, whose longest side is");
}

void refuse_tolerance(double tolerance, std::span<const double> per_axis, const std::string& what) {
  if (tolerance != 0 || !per_axis.empty())
    throw Error(Errc::invalid_argument,
                what + " have no tolerance: Options::tolerance must be 0, and axis_tolerances empty");
}

void refuse_axis_tolerances(std::span<const double> per_axis, const std::string& what) {
  if (!per_axis.empty())
    throw Error(Errc::invalid_argument,
                what + " have one tolerance, along the last axis: Options::axis_tolerances must be empty");
}

}  // namespace delone::internal
