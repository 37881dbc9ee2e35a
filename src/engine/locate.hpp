// SPDX-License-Identifier: BSD-3-Clause
// From a start cell to a cell in conflict with a query point (§2.5 of the report), or to the vertex at the
// query point, or to the finding that no cell is in conflict with it: it is hidden, as a point with little
// weight may be, or inside a hull.
//
// 1. Descent: h_A − h_B vanishes on the common facet of two finite cells A and B, so the neighbor with the
// smaller h(q) is on
//    the side of q, and walking to the least of the neighbors' values is a walk towards q that may stop at the first cell that
//    is certified in conflict. Values are rounded: that may mislead the walk, not the answer.
// 2. Where the descent ends uncertified, a visibility walk with exact orientations. It cannot cycle in a
// Delaunay triangulation
//    (Edelsbrunner 1990, doi:10.1007/BF02122779) and ends in a cell that contains q, which q is in conflict with
//    unless it is one of its vertices or hidden, or beyond the hull in an infinite cell in conflict.
#pragma once

#include "engine/conflict.hpp"

#include <cstdint>

namespace delone::engine {

struct WalkResult {
  Index cell = invalid_index;    ///< a cell in conflict with q, or one that has the vertex at q
  Index vertex = invalid_index;  ///< the vertex at q, if there is one
  bool hidden = false;  ///< no cell is in conflict with q, which is in the closed simplex (or cone) of `cell`
  std::uint64_t visited = 0;  ///< cells walked through
};

/// The exact part. `stop_at_conflict` false: goes on to the finite cell that contains q (on its boundary,
/// perhaps), or to an infinite cell whose hull facet has q strictly beyond it.
template <class Cells, QueryGeometry G>
WalkResult walk_exactly(const Cells& cells, const G& geometry, const typename G::Query& q, Index start,
                        bool stop_at_conflict, StageCounts& counts) {
  WalkResult result{start};
  if (const int slot = cells.infinite_slot(start); slot >= 0 && !stop_at_conflict)
    result.cell = cells.neighbors(start)[slot];
  for (;;) {
    ++result.visited;
    const Index cell = result.cell;
    result.vertex = vertex_at(cells, geometry, cell, q);
    if (result.vertex != invalid_index) return result;
    const int infinite_slot = cells.infinite_slot(cell);
    if (infinite_slot >= 0) {
      // Reached across its hull facet, strictly; or the start, where q may be at the vertex opposite the
      // facet.
      const Index finite = cells.neighbors(cell)[infinite_slot];
      if (!stop_at_conflict) return result;
      if (vertex_at(cells, geometry, finite, q) == invalid_index &&
          in_conflict_exactly(cells, geometry, cell, q, geometry.evaluator(q), counts))
        return result;
      result.cell = finite;
      continue;
    }
    if (stop_at_conflict && in_conflict_exactly(cells, geometry, cell, q, geometry.evaluator(q), counts))
      return result;
    const auto vertices = cells.vertices(cell);
    int slot = 0;
    while (slot <= cells.dimension() && geometry.side_of_facet(vertices, slot, q) != Sign::negative) ++slot;
    if (slot > cells.dimension()) {
      result.hidden = stop_at_conflict;
      return result;
    }
    result.cell = cells.neighbors(cell)[slot];
  }
}

enum class Descent { uncertain, conflict, hidden };

/// The descent: the cell where it ends, certified in conflict or hidden or neither. q is certified hidden
/// where the functional of a finite cell is positive at q and certainly less than those of all neighbors,
/// because it is the least of all then.
template <class Cells, QueryGeometry G>
std::pair<Descent, WalkResult> descend(const Cells& cells, const G& geometry, const typename G::Query& q,
                                       Index start) {
  WalkResult result{start};
  const auto functional = geometry.evaluator(q);
  double value = functional.value(start);
  if (value < -functional.threshold(start)) return {Descent::conflict, result};
  if (geometry.is_infinite(start)) {
    result.cell = cells.neighbors(start)[cells.infinite_slot(start)];
    value = functional.value(result.cell);
    if (value < -functional.threshold(result.cell)) return {Descent::conflict, result};
  }
  for (;;) {
    ++result.visited;
    const Index* neighbors = cells.neighbors(result.cell);
    const double here = value + functional.error(result.cell, value);
    bool least = value > functional.threshold(result.cell);
    Index best = invalid_index;
    cells.prefetch_neighbors(result.cell);
    for (int i = 0; i <= cells.dimension(); ++i) {
      const Index neighbor = neighbors[i];
      const double h = functional.value(neighbor), threshold = functional.threshold(neighbor);
      if (h < -threshold) {
        result.cell = neighbor;
        return {Descent::conflict, result};
      }
      const bool infinite = geometry.is_infinite(neighbor);
      least = least && (infinite ? h > threshold : h - functional.error(neighbor, h) > here);
      if (h < value && !infinite) {
        value = h;
        best = neighbor;
      }
    }
    if (best == invalid_index) {
      result.hidden = least;
      return {least ? Descent::hidden : Descent::uncertain, result};
    }
    result.cell = best;
  }
}

/// A cell in conflict with q, or the vertex at q, or that q is hidden.
template <class Cells, QueryGeometry G>
WalkResult locate(const Cells& cells, const G& geometry, const typename G::Query& q, Index start,
                  StageCounts& counts) {
  const auto [outcome, descent] = descend(cells, geometry, q, start);
  if (outcome != Descent::uncertain) return descent;
  WalkResult result = walk_exactly(cells, geometry, q, descent.cell, true, counts);
  result.visited += descent.visited;
  return result;
}

}  // namespace delone::engine
