// SPDX-License-Identifier: BSD-3-Clause
#include "forecast/quantities.hpp"

#include "engine/batch.hpp"

#include <algorithm>
#include <cmath>

namespace delone::cost_model {
namespace {

/// Cells in very many dimensions are more than there are numbers: such a quantity, and what follows from it,
/// is so large instead.
double finite(double x) {
  constexpr double largest = 1e300;
  return x < largest ? x : largest;  // also of NaN, from ∞ − ∞
}

ForecastQuantity between(double expected, double factor) {
  const double x = finite(expected);
  return {x, x / factor, finite(x * factor)};
}

/// Counts are whole numbers.
ForecastQuantity whole(double expected, double factor) {
  const ForecastQuantity x = between(expected, factor);
  return {std::round(x.expected), std::floor(x.low), std::ceil(x.high)};
}

}  // namespace

Forecast as_forecast(const Cost& cost, int dimension, std::size_t num_points, unsigned threads,
                     const Uncertainty& about) {
  Forecast forecast;
  forecast.dimension = dimension;
  forecast.affine_dimension = cost.affine_dimension;
  forecast.num_points = num_points;
  forecast.threads = engine::threads_for_batch(threads, num_points, cost.affine_dimension);
  forecast.vertices = whole(cost.vertices, 1);
  forecast.cells = whole(cost.cells, about.cells);
  // Memory comes in pages, and in the arrays of threads.
  constexpr double least_bytes = 1e6;
  forecast.bytes = between(cost.bytes, 1.1 * about.cells);
  forecast.bytes.high += least_bytes;
  forecast.seconds = between(cost.seconds / speedup(forecast.threads), about.speed * about.cells);
  forecast.seconds.low *= speedup(forecast.threads) / std::max(forecast.threads, 1u);
  return forecast;
}

}  // namespace delone::cost_model
