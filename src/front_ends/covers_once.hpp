// SPDX-License-Identifier: BSD-3-Clause
// The last step of proving what was wrapped: cells that are right across every facet may still go around a vertex twice. Then
// they cover all of space more than once, so one point tells (docs/predicates.md, "Wrapping").
#pragma once

#include "engine/cell_store.hpp"
#include "front_ends/hull.hpp"
#include "geometry/delaunay_geometry.hpp"
#include "stage_counts.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace delone {

/// Whether a point is inside exactly one of the given finite cells and on the boundary of none, and on the inner side of all
/// infinite cells. Exact.
template <int K>
bool is_in_one_of(std::span<const Index> finite_cells, const engine::CellStore<K>& cells,
                  const geometry::DelaunayGeometry<K>& geometry, const VertexPoints& points, const double* point) {
  const kernel::Grid grid = points.grid_with(point);
  const auto q = geometry.make_query(point, grid);
  int containing = 0;
  for (const Index cell : finite_cells) {
    Sign least = Sign::positive;
    for (int i = 0; i <= cells.dimension() && least != Sign::negative; ++i)
      least = std::min(least, geometry.side_of_facet(cells.vertices(cell), i, q));
    if (least == Sign::zero) return false;
    containing += least == Sign::positive ? 1 : 0;
  }
  const auto functional = geometry.evaluator(q);
  StageCounts uncounted;
  for (Index cell = 0; cell < cells.num_slots(); ++cell)
    if (geometry.is_infinite(cell) && !(functional.value(cell) > functional.threshold(cell)) &&
        geometry.exact_side(cells.vertices(cell), cells.infinite_slot(cell), q, uncounted) != Sign::positive)
      return false;
  return containing == 1;
}

/// Proves that cells which are locally right do not cover space more than once, by one point that is in one finite cell and on
/// the inner side of all infinite ones. It lies between a vertex with the least of all coordinates along an axis and all other
/// vertices, so that only cells of that vertex can contain it. Returns false also where no such point is found. REQUIRES that
/// all slots are cells, and that each vertex has a finite one. Cost O(k·(cells + vertices)) and few exact predicates.
template <int K>
bool covers_once(const engine::CellStore<K>& cells, const geometry::DelaunayGeometry<K>& geometry, const VertexPoints& points) {
  const int k = cells.dimension();
  for (int axis = 0; axis < points.ambient; ++axis) {
    const auto coordinate = [&](Index v) { return points.point(v)[axis]; };
    Index first = 1;
    for (Index v = 2; v <= points.last_vertex(); ++v)
      if (coordinate(v) < coordinate(first)) first = v;
    double second = std::numeric_limits<double>::infinity();
    for (Index v = 1; v <= points.last_vertex(); ++v)
      if (v != first) second = std::min(second, coordinate(v));
    std::vector<Index> around;
    for (Index cell = 0; cell < cells.num_slots(); ++cell) {
      const Index* v = cells.vertices(cell);
      if (!geometry.is_infinite(cell) && std::find(v, v + k + 1, first) != v + k + 1) around.push_back(cell);
    }
    const Index* v = cells.vertices(around.front());
    std::vector<double> inside(static_cast<std::size_t>(points.ambient));
    for (std::size_t j = 0; j < inside.size(); ++j)
      for (int i = 0; i <= k; ++i) inside[j] += points.point(v[i])[j] / (k + 1);
    const double step = (second - coordinate(first)) / 2 / (inside[static_cast<std::size_t>(axis)] - coordinate(first));
    for (std::size_t j = 0; j < inside.size(); ++j)
      inside[j] = points.point(first)[j] + step * (inside[j] - points.point(first)[j]);
    const double at = inside[static_cast<std::size_t>(axis)];
    if (!(coordinate(first) < at && at < second)) continue;
    return is_in_one_of<K>(around, cells, geometry, points, inside.data());
  }
  return false;
}

}  // namespace delone
