// SPDX-License-Identifier: BSD-3-Clause
// The forecast for a kind of points, from its curve alone.
#include <delone/forecast.hpp>

#include "base/require_dimension.hpp"
#include "forecast/model/cost.hpp"
#include "forecast/quantities.hpp"
#include "forecast/speed.hpp"

#include <delone/error.hpp>
#include <delone/point_sets.hpp>
#include <delone/printable.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace delone {
namespace {

/// The kinds without curves of their own have those of others.
std::string_view curve_name(std::string_view kind) { return kind == "cube01" ? "grid" : kind; }

void require_kind(std::string_view kind) {
  const auto& kinds = point_set_kinds();
  if (std::none_of(kinds.begin(), kinds.end(), [&](const PointSetKind& k) { return k.name == kind; })) {
    std::string names;
    for (const PointSetKind& k : kinds) names += (names.empty() ? "" : ", ") + std::string(k.name);
    throw Error(Errc::invalid_argument,
                "kind: there are no point sets of the kind " + in_quotes(kind) + "; the kinds are " + names);
  }
}

cost_model::Cost cost_of_kind(std::string_view kind, int d, double n) {
  const double vertices = cost_model::distinct_points(kind, d, n);
  const cost_model::Curve* const curve = cost_model::find_curve(curve_name(kind), d);
  if (curve != nullptr) return cost_model::cost_of(*curve, d, n, vertices);
  const cost_model::Curve spread = cost_model::curve_of_spread(kind == "flat" ? std::max(d - 1, 1) : d);
  return cost_model::cost_of(spread, d, n, vertices);
}

}  // namespace

Forecast forecast(int dimension, std::size_t num_points, std::string_view kind, unsigned threads) {
  internal::require_dimension(dimension);
  require_kind(kind);
  const auto n = static_cast<double>(num_points);
  cost_model::Cost cost = cost_of_kind(kind, dimension, n);
  cost.seconds *= cost_model::machine_nanoseconds() / cost_model::reference_nanoseconds();
  const cost_model::Curve* const curve = cost_model::find_curve(curve_name(kind), dimension);
  const double beyond = curve == nullptr ? 64 : std::max(cost.vertices / curve->last, 1.0);
  cost_model::Uncertainty about{1 + 0.07 * std::log2(2 * beyond), 1.4};
  return cost_model::as_forecast(cost, dimension, num_points, threads, about);
}

}  // namespace delone
