// SPDX-License-Identifier: BSD-3-Clause
#include "base/axis_scale.hpp"

#include "base/require_tolerance.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace delone::internal {

AxisScale::AxisScale(double tolerance, std::span<const double> wanted, int dimension)
    : tolerance_(tolerance) {
  if (wanted.empty()) {
    require_tolerance(tolerance);
    return;
  }
  if (wanted.size() != static_cast<std::size_t>(dimension))
    throw Error(Errc::invalid_argument, "there are " + std::to_string(wanted.size()) + " tolerances for " +
                                            std::to_string(dimension) + " axes");
  for (const double each : wanted) require_tolerance(each);
  const auto [least, most] = std::minmax_element(wanted.begin(), wanted.end());
  tolerance_ = *least;
  if (*least == *most) return;
  if (*least == 0)
    throw Error(Errc::invalid_argument, "the tolerance of one axis is 0, and that of another is not");
  constexpr int most_apart = 1000;
  const int exponent = std::ilogb(*most);
  if (exponent - std::ilogb(*least) > most_apart)
    throw Error(Errc::invalid_argument, "the tolerances of two axes differ by more than a factor of 2^1000");
  factors_.reserve(wanted.size());
  tolerance_ = *most;
  for (const double each : wanted) {
    factors_.push_back(std::ldexp(1.0, exponent - std::ilogb(each)));
    tolerance_ = std::min(tolerance_, each * factors_.back());
  }
  if (std::all_of(factors_.begin(), factors_.end(), [](double factor) { return factor == 1; }))
    factors_.clear();
}

std::vector<double> AxisScale::tolerances() const {
  std::vector<double> result;
  result.reserve(factors_.size());
  for (const double factor : factors_) result.push_back(tolerance_ / factor);
  return result;
}

std::vector<double> AxisScale::scaled(std::span<const double> rows) const {
  std::vector<double> result(rows.begin(), rows.end());
  for (std::size_t i = 0; i < result.size(); i += factors_.size())
    for (std::size_t j = 0; j < factors_.size(); ++j) result[i + j] *= factors_[j];
  return result;
}

}  // namespace delone::internal
