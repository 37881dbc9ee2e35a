// SPDX-License-Identifier: BSD-3-Clause
#include "forecast/memory_warning.hpp"

#include "base/platform.hpp"
#include "base/require_dimension.hpp"
#include "forecast/model/cost.hpp"
#include "forecast/model/tiles_share.hpp"
#include "messages/readable.hpp"

#include <delone/arithmetic.hpp>

namespace delone {
namespace cost_model {
namespace {

double available_bytes() { return static_cast<double>(platform::available_memory()); }

}  // namespace

bool may_exceed(int dimension, std::size_t num_points, double (*available)()) {
  constexpr double of_spread = 4, never = 64e6;
  const double bytes = of_spread * cost_of_spread(dimension, static_cast<double>(num_points)).bytes;
  if (bytes < never) return false;
  const double most = available();
  return most > 0 && bytes > most;
}

std::string memory_warning(const Forecast& forecast, double available) {
  const ForecastQuantity& bytes = forecast.bytes;
  if (!(available > 0) || !(bytes.expected > available)) return {};
  std::string text = "the triangulation is expected to take about " +
                     messages::readable_bytes(bytes.expected) + " of memory (" +
                     messages::readable_bytes(bytes.low) + " to " + messages::readable_bytes(bytes.high) +
                     "), but only " + messages::readable_bytes(available) + " is available";
  const auto n = static_cast<double>(forecast.num_points);
  if (tiles_pay(forecast.affine_dimension, n, bytes.expected, available)) text += "; tiles would fit";
  return text;
}

}  // namespace cost_model

std::string memory_warning(const Forecast& forecast) {
  const ArithmeticScope arithmetic;
  return cost_model::memory_warning(forecast, cost_model::available_bytes());
}

std::string memory_warning(const AnyPoints<>& points, int dimension, const ForecastOptions& options) {
  const ArithmeticScope arithmetic;
  internal::require_dimension(dimension);
  points.require_dimension(dimension);
  const std::size_t n = points.coordinates().size() / static_cast<std::size_t>(dimension);
  if (!cost_model::may_exceed(dimension, n, cost_model::available_bytes)) return {};
  return memory_warning(estimate(points, dimension, options));
}

bool tiles_pay(int dimension, std::size_t num_points, std::size_t memory) {
  const ArithmeticScope arithmetic;
  internal::require_dimension(dimension);
  const auto n = static_cast<double>(num_points);
  return cost_model::tiles_pay(dimension, n, cost_model::cost_of_spread(dimension, n).bytes,
                               static_cast<double>(memory));
}

}  // namespace delone
