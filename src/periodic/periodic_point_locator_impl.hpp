// SPDX-License-Identifier: BSD-3-Clause
// What PeriodicPointLocator shares with interpolators.
#pragma once

#include "periodic/nearest_image.hpp"
#include "periodic/query_location.hpp"
#include "queries/evaluation.hpp"

#include <delone/error.hpp>
#include <delone/periodic_queries.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

struct delone::PeriodicPointLocator::Impl {
  explicit Impl(const PeriodicTriangulation& t) : parts(t), locator(parts.ghosts.triangulation()) {}

  periodic::QueryParts parts;
  PointLocator locator;  // has the edges

  /// Calls visit(query, found) for all queries, if there are points, with a NearestImage of each thread.
  using NearestVisit = std::function<void(std::size_t query, const periodic::NearestImage& found)>;
  void find_nearest(const periodic::WrappedQueries& queries, const NearestVisit& visit,
                    unsigned threads) const;
};

namespace delone::periodic {

/// Values by row, those of vertices at all points.
inline void require_values(const PeriodicTriangulation& t, std::size_t numbers, std::size_t columns) {
  if (numbers != t.num_points() * columns)
    throw Error(Errc::bad_dimension, "values: " + std::to_string(numbers) + " numbers, not " +
                                         std::to_string(t.num_points() * columns));
}

/// What interpolators share: queries in the box, where their answers go, `width` numbers each, and the
/// answers of queries outside, where the set is not periodic.
class PeriodicBatch {
 public:
  /// `columns`: the constants that the options may have for queries outside.
  PeriodicBatch(const PeriodicPointLocator::Impl& locator, std::span<const double> queries,
                std::span<double> result, std::size_t width, std::size_t columns,
                const EvaluateOptions& options);

  /// Calls work() with the queries wrapped.
  void run(const Execution& how, const std::function<void()>& work);
  const WrappedQueries& wrapped() const { return wrapped_; }
  queries::Meter meter() { return queries::Meter(*progress_); }
  std::span<double> at(std::size_t query) const { return result_.subspan(query * width_, width_); }

  /// The answer of a query outside; throws Errc::invalid_argument for Outside::error.
  void value_outside(std::size_t query);
  void gradient_outside(std::size_t query) const;
  /// For Outside::nearest the values of the nearest points, by row.
  void take_nearest(std::span<const double> values, unsigned threads) const;

 private:
  const PeriodicPointLocator::Impl& locator_;
  std::span<const double> queries_;
  std::span<double> result_;
  std::size_t width_;
  const EvaluateOptions& options_;
  WrappedQueries wrapped_;
  std::optional<queries::Progress> progress_;
  std::vector<unsigned char> is_outside_;
};

}  // namespace delone::periodic
