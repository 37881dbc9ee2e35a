// SPDX-License-Identifier: BSD-3-Clause
// The point of a periodic set that is nearest to a query, among all translates.
//
// The walk of queries/nearest_vertex.cpp over the edges of the whole set: all edges at a point of the box are
// known. Where an image in another box is nearer, the walk goes on at its point in the box, with the query
// translated likewise. Each step goes to a point that is strictly nearer, so the walk ends. It ends at a
// point without nearer neighbors, which is the nearest one.
#pragma once

#include "periodic/query_location.hpp"
#include "queries/powers.hpp"

#include <delone/point_locator.hpp>

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace delone::periodic {

/// One query after the other; each thread has its own.
class NearestImage {
 public:
  NearestImage(const QueryParts& parts, const PointLocator::Edges& edges)
      : parts_(parts), edges_(edges), shift_(parts.rank), x_(parts.dimension) {}

  /// Begins at a vertex.
  void find(const double* q, const std::int32_t* wraps, VertexId start);

  std::uint32_t row = 0;
  std::vector<std::int32_t> offset;  ///< of the point as it was given, in terms of the caller's vectors
  /// From the query to the point.
  double squared_distance = 0;

 private:
  using Site = std::pair<VertexId, Offset>;  // a vertex in the box, and how the query is translated

  std::span<const VertexId> neighbors(VertexId v) const {
    const std::size_t first = edges_.offsets[index(v)];
    return std::span(edges_.vertices).subspan(first, edges_.offsets[index(v) + 1] - first);
  }
  double weight(VertexId v) const { return parts_.set.weighted ? parts_.point(v)[parts_.dimension] : 0.0; }
  queries::Power power_of(VertexId v) const {
    return queries::power(x_.data(), parts_.point(v), parts_.dimension, weight(v));
  }
  Sign compare(VertexId a, VertexId b) const {
    return queries::compare_exactly(x_.data(), parts_.point(a), parts_.point(b), parts_.dimension, weight(a),
                                    weight(b));
  }
  bool go_to_nearest();
  void go_to(VertexId v);
  void choose_first(const std::int32_t* wraps);
  void take(const std::int32_t* wraps);

  const QueryParts& parts_;
  const PointLocator::Edges& edges_;
  VertexId at_ = invalid_vertex;  // a vertex in the box
  Offset shift_;                  // x_ is the query translated by −shift_
  std::vector<double> x_;
  std::vector<std::int32_t> other_;
};

}  // namespace delone::periodic
