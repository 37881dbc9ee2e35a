// SPDX-License-Identifier: BSD-3-Clause
// PeriodicPointLocator: answers as arrays.
#include "base/guarded.hpp"
#include "base/progress_meter.hpp"
#include "periodic/periodic_point_locator_impl.hpp"
#include "queries/require_room.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace delone {

using periodic::NearestImage;
using periodic::Place;
using periodic::PlaceVisit;
using periodic::WrappedQueries;
using queries::require_room;

PeriodicPointLocator::PeriodicPointLocator(const PeriodicTriangulation& triangulation, const Execution& how) {
  internal::guarded("the cells", [&] {
    const internal::ProgressMeter meter(how.progress);
    impl_ = std::make_unique<const Impl>(triangulation);
  });
}
PeriodicPointLocator::PeriodicPointLocator(PeriodicPointLocator&&) noexcept = default;
PeriodicPointLocator& PeriodicPointLocator::operator=(PeriodicPointLocator&&) noexcept = default;
PeriodicPointLocator::~PeriodicPointLocator() = default;

void PeriodicPointLocator::locate(std::span<const double> queries, const PeriodicLocatedArrays& to,
                                  const Execution& how) const {
  const periodic::QueryParts& parts = impl_->parts;
  const std::size_t count = queries.size() / parts.dimension, r = parts.rank, corners = parts.corners;
  require_room(to.kinds, count, "kinds");
  require_room(to.cells, count, "cells");
  require_room(to.offsets, count * r, "offsets");
  require_room(to.barycentric, count * corners, "barycentric coordinates");
  internal::guarded("the queries", [&] {
    const internal::ProgressMeter meter(how.progress);
    const WrappedQueries wrapped = parts.wrap(queries, how.threads);
    const auto put = [&](std::size_t query, const Place& place) {
      if (!to.kinds.empty()) to.kinds[query] = place.kind;
      if (!to.cells.empty()) to.cells[query] = place.cell;
      if (!to.offsets.empty()) {
        const auto out = to.offsets.subspan(query * r, r);
        if (place.cell < 0)
          std::ranges::fill(out, 0);
        else
          parts.given_offset_of_cell(place.cell, place.offset, wrapped.wraps.data() + query * r, out.data());
      }
      if (to.barycentric.empty()) return;
      const auto out = to.barycentric.subspan(query * corners, corners);
      if (place.cell < 0)
        std::ranges::fill(out, std::numeric_limits<double>::quiet_NaN());
      else
        std::ranges::copy(place.barycentric, out.begin());
    };
    find_places(
        parts, wrapped, !to.barycentric.empty(), [&] { return PlaceVisit(put); }, how.threads);
  });
}

PeriodicLocatedPoints PeriodicPointLocator::locate(std::span<const double> queries,
                                                   const Execution& how) const {
  const periodic::QueryParts& parts = impl_->parts;
  const std::size_t count = queries.size() / parts.dimension, r = parts.rank, corners = parts.corners;
  return internal::guarded("the places of the queries", [&] {
    const internal::ProgressMeter meter(how.progress);
    const WrappedQueries wrapped = parts.wrap(queries, how.threads);
    PeriodicLocatedPoints result;
    result.kinds.resize(count);
    result.cells.resize(count);
    result.offsets.assign(count * r, 0);
    result.face_offsets.assign(count + 1, 0);
    // One row and its translation after the other, in the place of a whole cell for each query.
    std::vector<std::int64_t> faces(count * corners * (r + 1));
    const auto put = [&](std::size_t query, const Place& place) {
      result.kinds[query] = place.kind;
      result.cells[query] = place.cell;
      if (place.cell < 0) return;
      const std::int32_t* const wraps = wrapped.wraps.data() + query * r;
      parts.given_offset_of_cell(place.cell, place.offset, wraps, result.offsets.data() + query * r);
      std::vector<std::vector<std::int64_t>> face;
      std::vector<std::int32_t> offset(r);
      for (std::size_t i = 0; i < corners; ++i) {
        if (!(place.barycentric[i] > 0)) continue;
        const VertexId v = parts.classes.vertex(place.cell, i);
        parts.given_offset(v, place.offset, wraps, offset.data());
        face.push_back({static_cast<std::int64_t>(parts.row_of(v))});
        face.back().insert(face.back().end(), offset.begin(), offset.end());
      }
      std::ranges::sort(face);
      auto out = faces.begin() + static_cast<std::ptrdiff_t>(query * corners * (r + 1));
      for (const auto& one : face) out = std::ranges::copy(one, out).out;
      result.face_offsets[query + 1] = static_cast<std::int64_t>(face.size());
    };
    find_places(
        parts, wrapped, false, [&] { return PlaceVisit(put); }, how.threads);
    for (std::size_t query = 0; query < count; ++query) {
      auto from = faces.begin() + static_cast<std::ptrdiff_t>(query * corners * (r + 1));
      for (std::int64_t i = 0; i < result.face_offsets[query + 1]; ++i) {
        result.face_rows.push_back(static_cast<SignedIndex>(*from++));
        for (std::size_t l = 0; l < r; ++l) result.face_lattice.push_back(static_cast<std::int32_t>(*from++));
      }
    }
    std::partial_sum(result.face_offsets.begin(), result.face_offsets.end(), result.face_offsets.begin());
    return result;
  });
}

void PeriodicPointLocator::Impl::find_nearest(const WrappedQueries& queries, const NearestVisit& visit,
                                              unsigned threads) const {
  const PointLocator::Edges& edges = locator.edges();
  const auto vertices = parts.complex.finite_vertices();
  const VertexId first = *std::ranges::find_if(vertices, [&](VertexId v) { return parts.ghosts.is_own(v); });
  const auto make = [&]() -> PointLocator::Visit {
    const auto search = std::make_shared<NearestImage>(parts, edges);
    return [&, search, start = first](std::size_t query, const LocatedPoint& located) mutable {
      const double* const q = queries.points.data() + query * parts.dimension;
      if (located.cell != invalid_cell) {
        double least = std::numeric_limits<double>::infinity();
        for (const VertexId v : parts.complex.vertices(located.cell)) {
          if (v == infinite_vertex || parts.classes.own_vertex(v) == invalid_vertex) continue;
          const double power = queries::power(q, parts.point(v), parts.dimension,
                                              parts.set.weighted ? parts.point(v)[parts.dimension] : 0.0)
                                   .value;
          if (!(power < least)) continue;
          start = v;
          least = power;
        }
      }
      search->find(q, queries.wraps.data() + query * parts.rank, start);
      visit(query, *search);
    };
  };
  parts.where.locate(queries.points, {.coordinates = false}, {.threads = threads, .least_part = 1024},
                     {.make = make});
}

void PeriodicPointLocator::nearest(std::span<const double> queries, const PeriodicNearestArrays& to,
                                   const Execution& how) const {
  const periodic::QueryParts& parts = impl_->parts;
  const std::size_t count = queries.size() / parts.dimension, r = parts.rank;
  require_room(to.rows, count, "rows");
  require_room(to.offsets, count * r, "offsets");
  require_room(to.distances, count, "distances");
  internal::guarded("the queries", [&] {
    const internal::ProgressMeter meter(how.progress);
    const WrappedQueries wrapped = parts.wrap(queries, how.threads);
    if (parts.triangulation.num_vertices() == 0) {
      std::ranges::fill(to.rows, SignedIndex{-1});
      std::ranges::fill(to.offsets, 0);
      std::ranges::fill(to.distances, std::numeric_limits<double>::quiet_NaN());
      return;
    }
    const auto put = [&](std::size_t query, const NearestImage& found) {
      if (!to.rows.empty()) to.rows[query] = static_cast<SignedIndex>(found.row);
      if (!to.offsets.empty())
        std::ranges::copy(found.offset, to.offsets.begin() + static_cast<std::ptrdiff_t>(query * r));
      if (to.distances.empty()) return;
      const double distance = parts.set.outer(std::sqrt(found.squared_distance));
      to.distances[query] =
          parts.set.weighted ? distance * distance - parts.triangulation.weights()[found.row] : distance;
    };
    impl_->find_nearest(wrapped, put, how.threads);
  });
}

namespace periodic {

PeriodicBatch::PeriodicBatch(const PeriodicPointLocator::Impl& locator, std::span<const double> queries,
                             std::span<double> result, std::size_t width, std::size_t columns,
                             const EvaluateOptions& options)
    : locator_(locator), queries_(queries), result_(result), width_(width), options_(options) {
  queries::require_size(result.size(), queries.size() / locator.parts.dimension * width, "the result");
  if (options.tolerance != 0)
    throw Error(Errc::unsupported, "interpolation on a periodic triangulation has no tolerance");
  if (options.outside == Outside::project)
    throw Error(Errc::unsupported, "queries to a periodic triangulation are not projected to its hull");
  if (!options.fill.empty()) queries::require_size(options.fill.size(), columns, "the constants outside");
}

void PeriodicBatch::run(const Execution& how, const std::function<void()>& work) {
  internal::guarded("the queries", [&] {
    const std::size_t count = queries_.size() / locator_.parts.dimension;
    progress_.emplace(how.progress, count);
    wrapped_ = locator_.parts.wrap(queries_, how.threads);
    is_outside_.assign(count, 0);
    work();
    progress_.reset();
  });
}

void PeriodicBatch::value_outside(std::size_t query) {
  queries::refuse_outside(options_, query);
  is_outside_[query] = 1;
  const std::span<double> to = at(query);
  for (std::size_t c = 0; c < to.size(); ++c)
    to[c] = options_.fill.empty() ? std::numeric_limits<double>::quiet_NaN() : options_.fill[c];
}

void PeriodicBatch::gradient_outside(std::size_t query) const {
  queries::refuse_outside(options_, query);
  std::ranges::fill(at(query),
                    options_.outside == Outside::nearest ? 0.0 : std::numeric_limits<double>::quiet_NaN());
}

void PeriodicBatch::take_nearest(std::span<const double> values, unsigned threads) const {
  const QueryParts& parts = locator_.parts;
  if (options_.outside != Outside::nearest || parts.triangulation.num_vertices() == 0) return;
  WrappedQueries some;
  std::vector<std::size_t> numbers;
  for (std::size_t query = 0; query < is_outside_.size(); ++query) {
    if (is_outside_[query] == 0) continue;
    numbers.push_back(query);
    const double* const x = wrapped_.points.data() + query * parts.dimension;
    some.points.insert(some.points.end(), x, x + parts.dimension);
  }
  some.wraps.assign(numbers.size() * parts.rank, 0);
  locator_.find_nearest(
      some,
      [&](std::size_t i, const NearestImage& found) {
        std::ranges::copy(values.subspan(found.row * width_, width_), at(numbers[i]).begin());
      },
      threads);
}

}  // namespace periodic

}  // namespace delone
