// SPDX-License-Identifier: BSD-3-Clause
// The forecast for given points, from samples of them.
#include <delone/arithmetic.hpp>
#include <delone/forecast.hpp>

#include "base/guarded.hpp"
#include "base/platform.hpp"
#include "base/progress_meter.hpp"
#include "base/require_dimension.hpp"
#include "base/require_finite.hpp"
#include "forecast/lattice_points.hpp"
#include "forecast/model/cell_counts.hpp"
#include "forecast/sample.hpp"
#include "forecast/sampling.hpp"

#include <delone/error.hpp>

#include <vector>

namespace delone {
namespace {

Forecast estimate_rows(std::span<const double> coordinates, int dimension, const ForecastOptions& options) {
  constexpr std::size_t most_sampled = 1 << 18;
  const auto d = static_cast<std::size_t>(dimension);
  const double start = platform::thread_seconds();
  cost_model::SampledSet set;
  set.dimension = dimension;
  set.num_points = coordinates.size() / d;
  const cost_model::Sample sample = cost_model::sample_of(coordinates, dimension, most_sampled);
  set.most = sample.rows.size();
  set.most_is_all = sample.is_all;
  set.num_distinct = sample.num_distinct;
  const cost_model::LatticePoints lattice =
      cost_model::find_lattice(coordinates, dimension, sample.rows, sample.num_distinct);
  if (lattice.has_ties) set.known_cells = cost_model::factorial(dimension) * lattice.hull_volume;
  set.sample = [&](std::size_t m) {
    if (lattice.found && m < sample.rows.size())
      return cost_model::patch_around(coordinates, dimension, sample.rows.front(), m);
    std::vector<double> points;
    for (std::size_t i = 0; i < m; ++i) {
      const double* const point = coordinates.data() + sample.rows[i] * d;
      points.insert(points.end(), point, point + d);
    }
    return points;
  };
  set.spent = lattice.found ? platform::thread_seconds() - start : 0;
  return cost_model::forecast_by_samples(set, options);
}

}  // namespace

Forecast estimate(const AnyPoints<>& points, int dimension, const ForecastOptions& options) {
  const ArithmeticScope arithmetic;
  internal::require_dimension(dimension);
  points.require_dimension(dimension);
  cost_model::require_options(options);
  const std::span<const double> coordinates = points.coordinates();
  if (coordinates.size() % static_cast<std::size_t>(dimension) != 0)
    throw Error(Errc::bad_dimension, "the number of coordinates is not a multiple of the dimension");
  internal::require_finite(coordinates, static_cast<std::size_t>(dimension), "a coordinate");
  const internal::ProgressMeter meter(options.progress);
  return internal::guarded("a sample of the points",
                           [&] { return estimate_rows(coordinates, dimension, options); });
}

}  // namespace delone
