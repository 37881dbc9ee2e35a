// SPDX-License-Identifier: BSD-3-Clause
// The forecast for a kind of points: a closed form, or samples that are generated.
#include <delone/arithmetic.hpp>
#include <delone/forecast.hpp>

#include "base/guarded.hpp"
#include "base/progress_meter.hpp"
#include "base/require_dimension.hpp"
#include "forecast/model/cell_counts.hpp"
#include "forecast/model/cost.hpp"
#include "forecast/quantities.hpp"
#include "forecast/sampling.hpp"
#include "forecast/speed.hpp"
#include "messages/in_quotes.hpp"

#include <delone/error.hpp>
#include <delone/point_sets.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace delone {
namespace {

void require_kind(std::string_view kind) {
  const auto& kinds = point_set_kinds();
  if (std::none_of(kinds.begin(), kinds.end(), [&](const PointSetKind& k) { return k.name == kind; })) {
    std::string names;
    for (const PointSetKind& k : kinds) names += (names.empty() ? "" : ", ") + std::string(k.name);
    throw Error(Errc::invalid_argument,
                "kind: unknown kind of point sets " + messages::in_quotes(kind) + "; the kinds are " + names);
  }
}

/// The number of distinct points among n of a kind.
double distinct_points(std::string_view kind, int d, double n) {
  const auto drawn_from = [&](double different) { return -different * std::expm1(-n / different); };
  if (kind == "equal") return std::min(n, 1.0);
  if (kind == "duplicates") return drawn_from(std::floor(n / 4) + 1);
  if (kind == "sphere" && d == 1) return std::min(n, 2.0);
  if (kind == "cube01") return std::min(n, std::pow(2.0, d));
  if (kind == "offset" && d == 1) return drawn_from(1e6);
  return n;
}

/// The number of cells of n points of a kind, if there is a formula; otherwise 0.
double known_cells(std::string_view kind, int d, double n) {
  if (kind == "moment" && n > d) return cost_model::moment_curve_cells(d, n);
  if (kind != "grid" && kind != "cube01" && kind != "tilted_grid") return 0;
  const cost_model::LatticeHull hull = cost_model::lattice_hull(d, n, cost_model::grid_side(d, n));
  return cost_model::factorial(hull.affine_dimension) * hull.volume;
}

Forecast spread_evenly(int dimension, std::size_t num_points, std::string_view kind, unsigned threads) {
  const auto n = static_cast<double>(num_points);
  const int k = kind == "flat" ? std::max(dimension - 1, 1) : dimension;
  cost_model::Cost cost =
      cost_model::cost_of_spread(k, dimension, n, distinct_points(kind, dimension, n), k == dimension);
  cost.seconds *= cost_model::machine_nanoseconds() / cost_model::reference_nanoseconds;
  return cost_model::as_forecast(
      cost, dimension, num_points, threads,
      {cost.factor, dimension > cost_model::largest_measured_dimension ? 2.5 : 1.4});
}

}  // namespace

Forecast forecast(int dimension, std::size_t num_points, std::string_view kind,
                  const ForecastOptions& options) {
  const ArithmeticScope arithmetic;
  internal::require_dimension(dimension);
  require_kind(kind);
  cost_model::require_options(options);
  const internal::ProgressMeter meter(options.progress);
  if (kind == "uniform" || dimension > cost_model::largest_measured_dimension)
    return spread_evenly(dimension, num_points, kind, options.threads);
  constexpr std::size_t most_sampled = 1 << 18;
  const auto n = static_cast<double>(num_points);
  cost_model::SampledSet set;
  set.dimension = dimension;
  set.num_points = num_points;
  set.most = std::min(num_points, most_sampled);
  set.most_is_all = set.most == num_points;
  set.num_distinct = distinct_points(kind, dimension, n);
  set.known_cells = known_cells(kind, dimension, set.num_distinct);
  set.sample = [&](std::size_t m) { return make_point_set(kind, dimension, m); };
  return internal::guarded("a sample of the points",
                           [&] { return cost_model::forecast_by_samples(set, options); });
}

}  // namespace delone
