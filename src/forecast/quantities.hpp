// SPDX-License-Identifier: BSD-3-Clause
// From a cost to a forecast: threads, ranges.
#pragma once

#include "forecast/model/cost.hpp"

#include <delone/forecast.hpp>

namespace delone::cost_model {

/// Factors by which expected values may be wrong.
struct Uncertainty {
  double cells = 1.1;
  double speed = 1.4;  ///< in addition, of seconds
};

/// `cost`: with seconds of one thread on this machine. `threads`: as Options::threads.
Forecast as_forecast(const Cost& cost, int dimension, std::size_t num_points, unsigned threads,
                     const Uncertainty& about);

}  // namespace delone::cost_model
