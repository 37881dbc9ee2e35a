// SPDX-License-Identifier: BSD-3-Clause
// From a start cell to a cell in conflict with a query point (§2.5 of the report), or to the vertex at the query point.
//
// 1. Descent: h_A − h_B vanishes on the common facet of two finite cells A and B, so the neighbor with the smaller h(q) is on
//    the side of q, and walking to the least of the neighbors' values is a walk towards q that may stop at the first cell that
//    is certified in conflict. Values are rounded: that may mislead the walk, not the answer.
// 2. Where the descent ends uncertified, a visibility walk with exact orientations. It cannot cycle in a Delaunay triangulation
//    (Edelsbrunner 1990, doi:10.1007/BF02122779) and ends in a cell that contains q, which q is in conflict with
//    unless it is one of its vertices, or beyond the hull in an infinite cell in conflict.
#pragma once

#include "engine/conflict.hpp"

#include <cstdint>

namespace delone::engine {

struct WalkResult {
  Index cell = invalid_index;    ///< a cell in conflict with q, or one that has the vertex at q
  Index vertex = invalid_index;  ///< the vertex at q, if there is one
  std::uint64_t visited = 0;     ///< cells walked through
};

/// The exact part. `stop_at_conflict` false: goes on to the finite cell that contains q (on its boundary, perhaps), or to an
/// infinite cell whose hull facet has q strictly beyond it.
template <int K, Geometry G>
WalkResult walk_exactly(const CellStore<K>& cells, const G& geometry, const typename G::Query& q, Index start,
                        bool stop_at_conflict, StageCounts& counts) {
  WalkResult result{start};
  if (const int slot = cells.infinite_slot(start); slot >= 0 && !stop_at_conflict) result.cell = cells.neighbors(start)[slot];
  for (;;) {
    ++result.visited;
    const Index cell = result.cell;
    result.vertex = vertex_at(cells, geometry, cell, q);
    if (result.vertex != invalid_index) return result;
    const int infinite_slot = cells.infinite_slot(cell);
    if (infinite_slot >= 0) {
      // Reached across its hull facet, strictly; or the start, where q may be at the vertex opposite the facet.
      const Index finite = cells.neighbors(cell)[infinite_slot];
      if (!stop_at_conflict) return result;
      if (vertex_at(cells, geometry, finite, q) == invalid_index && in_conflict_exactly(cells, geometry, cell, q, counts))
        return result;
      result.cell = finite;
      continue;
    }
    if (stop_at_conflict && in_conflict_exactly(cells, geometry, cell, q, counts)) return result;
    int slot = 0;
    while (slot <= cells.dimension() && geometry.side_of_facet(cells.vertices(cell), slot, q) != Sign::negative) ++slot;
    if (slot > cells.dimension()) return result;
    result.cell = cells.neighbors(cell)[slot];
  }
}

/// The descent: the cell where it ends, certified in conflict (first) or not.
template <int K, Geometry G>
std::pair<bool, WalkResult> descend(const CellStore<K>& cells, const G& geometry, const typename G::Query& q, Index start) {
  WalkResult result{start};
  double value = geometry.value(start, q);
  if (geometry.filter_side(start, value) == Sign::negative) return {true, result};
  if (geometry.is_infinite(start)) {
    result.cell = cells.neighbors(start)[cells.infinite_slot(start)];
    value = geometry.value(result.cell, q);
    if (geometry.filter_side(result.cell, value) == Sign::negative) return {true, result};
  }
  for (;;) {
    ++result.visited;
    const Index* neighbors = cells.neighbors(result.cell);
    Index best = invalid_index;
    for (int i = 0; i <= cells.dimension(); ++i) {
      const Index neighbor = neighbors[i];
      const double h = geometry.value(neighbor, q);
      if (geometry.filter_side(neighbor, h) == Sign::negative) {
        result.cell = neighbor;
        return {true, result};
      }
      if (h < value && !geometry.is_infinite(neighbor)) {
        value = h;
        best = neighbor;
      }
    }
    if (best == invalid_index) return {false, result};
    result.cell = best;
  }
}

/// A cell in conflict with q, or the vertex at q.
template <int K, Geometry G>
WalkResult locate(const CellStore<K>& cells, const G& geometry, const typename G::Query& q, Index start, StageCounts& counts) {
  const auto [certified, descent] = descend(cells, geometry, q, start);
  if (certified) return descent;
  WalkResult result = walk_exactly(cells, geometry, q, descent.cell, true, counts);
  result.visited += descent.visited;
  return result;
}

}  // namespace delone::engine
