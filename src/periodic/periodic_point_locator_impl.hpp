// SPDX-License-Identifier: BSD-3-Clause
// What PeriodicPointLocator shares with interpolators.
#pragma once

#include "periodic/nearest_image.hpp"
#include "periodic/query_location.hpp"

#include <delone/error.hpp>
#include <delone/periodic_queries.hpp>

#include <functional>
#include <limits>
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

/// The answers of queries outside, where the set is not periodic, `width` numbers each.
class PeriodicOutside {
 public:
  PeriodicOutside(const EvaluateOptions& options, std::size_t columns) : options_(options) {
    if (options.tolerance != 0)
      throw Error(Errc::unsupported, "interpolation on a periodic triangulation has no tolerance");
    if (options.outside == Outside::project)
      throw Error(Errc::unsupported, "queries to a periodic triangulation are not projected to its hull");
    if (!options.fill.empty() && options.fill.size() != columns)
      throw Error(Errc::bad_dimension, "the constants outside: " + std::to_string(options.fill.size()) +
                                           " numbers, not " + std::to_string(columns));
  }

  void refuse(std::size_t query) const {
    if (options_.outside == Outside::error)
      throw Error(Errc::invalid_argument,
                  "query " + std::to_string(query) + " is outside the convex hull of the points", {query});
  }
  void fill(std::span<double> at) const {
    for (std::size_t c = 0; c < at.size(); ++c)
      at[c] = options_.fill.empty() ? std::numeric_limits<double>::quiet_NaN() : options_.fill[c];
  }
  /// The values of the nearest points for the queries that are marked.
  void finish(const PeriodicPointLocator::Impl& locator, const WrappedQueries& queries,
              std::span<const unsigned char> is_outside, std::span<const double> values, std::size_t columns,
              std::span<double> result, unsigned threads) const;

 private:
  const EvaluateOptions& options_;
};

}  // namespace delone::periodic
