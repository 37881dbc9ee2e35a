// SPDX-License-Identifier: BSD-3-Clause
// LinearInterpolator: values at the vertices, weighted sums over the vertices of the cell that contains a
// query.
#include <delone/arithmetic.hpp>
#include <delone/interpolation.hpp>

#include "queries/barycentric.hpp"
#include "queries/evaluation.hpp"
#include "queries/point_locator_impl.hpp"

#include <algorithm>
#include <vector>

namespace delone {

using queries::require_size;

LinearInterpolator::LinearInterpolator(const Triangulation& triangulation, std::span<const double> values,
                                       std::size_t columns)
    : triangulation_(triangulation), locator_(triangulation), columns_(columns) {
  const ArithmeticScope arithmetic;
  require_size(values.size(), triangulation.num_rows() * columns, "values");
  values_ = queries::by_vertex(triangulation, values, columns);
}

void LinearInterpolator::evaluate(std::span<const double> queries, std::span<double> result,
                                  const EvaluateOptions& options, const Execution& how) const {
  const ArithmeticScope arithmetic;
  const auto d = static_cast<std::size_t>(triangulation_.dimension());
  queries::Answers answers(queries, d, result, columns_, options, how);
  if (!options.fill.empty()) require_size(options.fill.size(), columns_, "the constants outside");
  const Complex complex = triangulation_.complex();
  const auto answer = [&](std::size_t query, const LocatedPoint& where) {
    double* const at = answers.at(query);
    if (where.barycentric.empty()) {
      answers.put_value_outside(query);
      return;
    }
    std::fill_n(at, columns_, 0.0);
    for (std::size_t i = 0; i < where.barycentric.size(); ++i) {
      const double weight = where.barycentric[i];
      if (weight == 0) continue;  // a NaN at a vertex outside the face of the query does not count
      const double* const value =
          values_.data() + index(complex.vertex(where.cell, static_cast<int>(i))) * columns_;
      for (std::size_t c = 0; c < columns_; ++c) at[c] += weight * value[c];
    }
  };
  const auto make_visit = [&]() -> PointLocator::Visit {
    return [&, meter = answers.meter()](std::size_t query, const LocatedPoint& where) mutable {
      meter();
      answer(query, where);
    };
  };
  locator_.impl_->locate(queries, queries::locate_options(options), {.threads = how.threads},
                         {.make = make_visit});
  answers.finish(locator_, values_, how.threads);
}

void LinearInterpolator::gradients(std::span<const double> queries, std::span<double> result,
                                   const EvaluateOptions& options, const Execution& how) const {
  const ArithmeticScope arithmetic;
  const auto d = static_cast<std::size_t>(triangulation_.dimension());
  const std::size_t width = columns_ * d;
  queries::Answers answers(queries, d, result, width, options, how);
  const Complex complex = triangulation_.complex();
  const auto make_visit = [&]() -> PointLocator::Visit {
    return [&, meter = answers.meter(), last = CellId{invalid_cell}, points = std::vector<const double*>(),
            values = std::vector<double>(),
            gradient = std::vector<double>()](std::size_t query, const LocatedPoint& where) mutable {
      meter();
      double* const at = answers.at(query);
      if (where.barycentric.empty()) {
        answers.put_gradient_outside(query);
        return;
      }
      if (where.cell != last) {
        last = where.cell;
        points.clear();
        values.clear();
        for (const VertexId v : complex.vertices(last)) {
          points.push_back(triangulation_.point(v).data());
          const double* const value = values_.data() + index(v) * columns_;
          values.insert(values.end(), value, value + columns_);
        }
        queries::gradients(points, values, static_cast<int>(columns_), static_cast<int>(d), gradient);
      }
      std::copy(gradient.begin(), gradient.end(), at);
    };
  };
  locator_.impl_->locate(queries, queries::locate_options(options), {.threads = how.threads},
                         {.make = make_visit});
}

}  // namespace delone
