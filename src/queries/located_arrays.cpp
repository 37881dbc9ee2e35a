// SPDX-License-Identifier: BSD-3-Clause
// The answers of PointLocator::locate() as arrays.
#include "queries/point_locator_impl.hpp"
#include "queries/require_room.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace delone {
namespace {

using queries::require_room;

SignedIndex row_of(const LocatedPoint& where, const CellNumbers& numbers) {
  return where.barycentric.empty() ? SignedIndex{-1} : numbers.row(where.cell);
}

}  // namespace

void PointLocator::locate(std::span<const double> queries, const LocateOptions& options,
                          const CellNumbers& numbers, const LocatedArrays& to, const Execution& how) const {
  const std::size_t count = queries.size() / static_cast<std::size_t>(impl_->dimension),
                    width = static_cast<std::size_t>(impl_->affine_dimension + 1);
  require_room(to.kinds, count, "kinds");
  require_room(to.cells, count, "cells");
  require_room(to.barycentric, count * width, "barycentric coordinates");
  require_room(to.distances, count, "distances");
  LocateOptions wanted = options;
  wanted.coordinates = !to.barycentric.empty();
  const auto put = [&](std::size_t query, const LocatedPoint& where) {
    if (!to.kinds.empty()) to.kinds[query] = where.kind;
    if (!to.cells.empty()) to.cells[query] = row_of(where, numbers);
    if (!to.distances.empty()) to.distances[query] = where.distance;
    if (to.barycentric.empty()) return;
    const auto out = to.barycentric.subspan(query * width, width);
    if (where.barycentric.size() == width)
      std::ranges::copy(where.barycentric, out.begin());
    else
      std::ranges::fill(out, std::numeric_limits<double>::quiet_NaN());
  };
  locate(queries, wanted, put, how);
}

LocatedPoints PointLocator::locate(std::span<const double> queries, const LocateOptions& options,
                                   const CellNumbers& numbers, const Execution& how) const {
  const std::size_t count = queries.size() / static_cast<std::size_t>(impl_->dimension),
                    width = static_cast<std::size_t>(impl_->affine_dimension + 1);
  LocatedPoints result;
  try {
    result.kinds.resize(count);
    result.cells.resize(count);
    result.face_offsets.assign(count + 1, 0);
    result.face_rows.resize(count * width);
  } catch (const std::bad_alloc&) {
    throw Error(Errc::out_of_memory, "not enough memory for the places of the queries");
  }
  LocateOptions wanted = options;
  wanted.coordinates = false;
  const auto put = [&](std::size_t query, const LocatedPoint& where) {
    result.kinds[query] = where.kind;
    result.cells[query] = row_of(where, numbers);
    const auto begin = result.face_rows.begin() + static_cast<std::ptrdiff_t>(query * width);
    auto end = begin;
    for (std::size_t i = 0; i < where.barycentric.size(); ++i)
      if (where.barycentric[i] > 0)
        *end++ = static_cast<SignedIndex>(
            impl_->triangulation.row_of(impl_->complex.vertex(where.cell, static_cast<int>(i))));
    std::sort(begin, end);
    result.face_offsets[query + 1] = end - begin;
  };
  locate(queries, wanted, put, how);
  // Faces are as long as lists at most, so they can move forward in place.
  auto end = result.face_rows.begin();
  for (std::size_t query = 0; query < count; ++query) {
    const auto begin = result.face_rows.begin() + static_cast<std::ptrdiff_t>(query * width);
    end = std::copy(begin, begin + static_cast<std::ptrdiff_t>(result.face_offsets[query + 1]), end);
    result.face_offsets[query + 1] += result.face_offsets[query];
  }
  result.face_rows.erase(end, result.face_rows.end());
  return result;
}

}  // namespace delone
