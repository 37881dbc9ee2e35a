// SPDX-License-Identifier: BSD-3-Clause
// PeriodicLinearInterpolator: weighted sums over the vertices of the cell that contains a query.
#include "base/guarded.hpp"
#include "periodic/periodic_point_locator_impl.hpp"
#include "queries/barycentric.hpp"
#include "queries/evaluation.hpp"

#include <algorithm>
#include <limits>

namespace delone {

using periodic::PeriodicOutside;
using periodic::Place;
using periodic::PlaceVisit;
using periodic::QueryParts;
using periodic::WrappedQueries;
using queries::Meter;
using queries::require_size;

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
  const std::size_t count = queries.size() / parts.dimension;
  require_size(result.size(), count * columns_, "the result");
  const PeriodicOutside outside(options, columns_);
  internal::guarded("the queries", [&] {
    queries::Progress progress(how.progress, count);
    const WrappedQueries wrapped = parts.wrap(queries, how.threads);
    std::vector<unsigned char> is_outside(count, 0);
    const auto make_visit = [&]() -> PlaceVisit {
      return [&, meter = Meter(progress)](std::size_t query, const Place& place) mutable {
        meter();
        const auto at = result.subspan(query * columns_, columns_);
        if (place.cell < 0) {
          outside.refuse(query);
          is_outside[query] = 1;
          outside.fill(at);
          return;
        }
        std::ranges::fill(at, 0.0);
        for (std::size_t i = 0; i < parts.corners; ++i) {
          if (place.barycentric[i] == 0) continue;  // a NaN outside the face of the query does not count
          const double* const value =
              values_.data() + parts.row_of(parts.classes.vertex(place.cell, i)) * columns_;
          for (std::size_t c = 0; c < columns_; ++c) at[c] += place.barycentric[i] * value[c];
        }
      };
    };
    find_places(parts, wrapped, true, make_visit, how.threads);
    outside.finish(*locator_.impl_, wrapped, is_outside, values_, columns_, result, how.threads);
  });
}

void PeriodicLinearInterpolator::gradients(std::span<const double> queries, std::span<double> result,
                                           const EvaluateOptions& options, const Execution& how) const {
  const QueryParts& parts = locator_.impl_->parts;
  const std::size_t count = queries.size() / parts.dimension, width = columns_ * parts.dimension;
  require_size(result.size(), count * width, "the result");
  const PeriodicOutside outside(options, options.fill.size());
  internal::guarded("the queries", [&] {
    queries::Progress progress(how.progress, count);
    const WrappedQueries wrapped = parts.wrap(queries, how.threads);
    const auto make_visit = [&]() -> PlaceVisit {
      return [&, meter = Meter(progress), last = SignedIndex{-1}, points = std::vector<const double*>(),
              values = std::vector<double>(),
              gradient = std::vector<double>()](std::size_t query, const Place& place) mutable {
        meter();
        const auto at = result.subspan(query * width, width);
        if (place.cell < 0) {
          outside.refuse(query);
          std::ranges::fill(
              at, options.outside == Outside::nearest ? 0.0 : std::numeric_limits<double>::quiet_NaN());
          return;
        }
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
        std::ranges::copy(gradient, at.begin());
      };
    };
    find_places(parts, wrapped, false, make_visit, how.threads);
  });
}

}  // namespace delone
