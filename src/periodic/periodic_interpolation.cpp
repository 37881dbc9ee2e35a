// SPDX-License-Identifier: BSD-3-Clause
// PeriodicLinearInterpolator: weighted sums over the vertices of the cell that contains a query.
#include "base/guarded.hpp"
#include "periodic/periodic_point_locator_impl.hpp"
#include "queries/barycentric.hpp"

#include <algorithm>

namespace delone {

using periodic::PeriodicBatch;
using periodic::Place;
using periodic::PlaceVisit;
using periodic::QueryParts;

PeriodicLinearInterpolator::PeriodicLinearInterpolator(const PeriodicTriangulation& triangulation,
                                                       std::span<const double> values, std::size_t columns,
                                                       const Execution& how)
    : triangulation_(triangulation), locator_(triangulation, how), columns_(columns) {
  periodic::require_values(triangulation, values.size(), columns);
  internal::guarded("the values", [&] { values_.assign(values.begin(), values.end()); });
}

void PeriodicLinearInterpolator::evaluate(std::span<const double> queries, std::span<double> result,
                                          const EvaluateOptions& options, const Execution& how) const {
  const QueryParts& parts = locator_.impl_->parts;
  PeriodicBatch batch(*locator_.impl_, queries, result, columns_, columns_, options);
  const auto make_visit = [&]() -> PlaceVisit {
    return [&, meter = batch.meter()](std::size_t query, const Place& place) mutable {
      meter();
      if (place.cell < 0) return batch.value_outside(query);
      const std::span<double> at = batch.at(query);
      std::ranges::fill(at, 0.0);
      for (std::size_t i = 0; i < parts.corners; ++i) {
        if (place.barycentric[i] == 0) continue;  // a NaN outside the face of the query does not count
        const double* const value =
            values_.data() + parts.row_of(parts.classes.vertex(place.cell, i)) * columns_;
        for (std::size_t c = 0; c < columns_; ++c) at[c] += place.barycentric[i] * value[c];
      }
    };
  };
  batch.run(how, [&] {
    find_places(parts, batch.wrapped(), true, make_visit, how.threads);
    batch.take_nearest(values_, how.threads);
  });
}

void PeriodicLinearInterpolator::gradients(std::span<const double> queries, std::span<double> result,
                                           const EvaluateOptions& options, const Execution& how) const {
  const QueryParts& parts = locator_.impl_->parts;
  PeriodicBatch batch(*locator_.impl_, queries, result, columns_ * parts.dimension, options.fill.size(),
                      options);
  const auto make_visit = [&]() -> PlaceVisit {
    return [&, meter = batch.meter(), last = SignedIndex{-1}, points = std::vector<const double*>(),
            values = std::vector<double>(),
            gradient = std::vector<double>()](std::size_t query, const Place& place) mutable {
      meter();
      if (place.cell < 0) return batch.gradient_outside(query);
      if (place.cell != last) {
        last = place.cell;
        points.clear();
        values.clear();
        for (std::size_t i = 0; i < parts.corners; ++i) {
          const VertexId v = parts.classes.vertex(place.cell, i);
          points.push_back(parts.point(v));
          const double* const value = values_.data() + parts.row_of(v) * columns_;
          values.insert(values.end(), value, value + columns_);
        }
        queries::gradients(points, values, static_cast<int>(columns_), static_cast<int>(parts.dimension),
                           gradient);
        // From per unit of the set to per unit of the caller.
        for (double& one : gradient) one = parts.set.inner(one);
      }
      std::ranges::copy(gradient, batch.at(query).begin());
    };
  };
  batch.run(how, [&] { find_places(parts, batch.wrapped(), false, make_visit, how.threads); });
}

}  // namespace delone
