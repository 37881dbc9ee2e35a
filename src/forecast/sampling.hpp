// SPDX-License-Identifier: BSD-3-Clause
// A forecast from samples of points.
#pragma once

#include <delone/forecast.hpp>

#include <cstddef>
#include <functional>
#include <vector>

namespace delone::cost_model {

/// A set of points of which samples can be had.
struct SampledSet {
  int dimension = 0;
  std::size_t num_points = 0;
  std::size_t most = 0;     ///< the size of the largest sample
  bool most_is_all = true;  ///< it has every distinct point
  double num_distinct = 0;
  /// The coordinates of a sample of m ≤ `most` points.
  std::function<std::vector<double>(std::size_t m)> sample;
  double known_cells = 0;  ///< of the whole; 0: unknown
  double spent = 0;        ///< seconds of the thread that have been spent on the set already
};

/// Throws invalid_argument unless sample_seconds is finite and > 0.
void require_options(const ForecastOptions& options);

/// Triangulates samples of growing size until a forecast is worth no more time. Errors: out_of_memory,
/// cancelled.
Forecast forecast_by_samples(const SampledSet& set, const ForecastOptions& options);

}  // namespace delone::cost_model
