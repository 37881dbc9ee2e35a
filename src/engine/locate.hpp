// SPDX-License-Identifier: BSD-3-Clause
// From a start cell to a cell in conflict with a query point (§2.5 of the report), or to the vertex at the
// query point, or to the finding that no cell is in conflict with it: it is hidden, as a point with little
// weight may be, or inside a hull.
//
// 1. Descent: h_A − h_B vanishes on the common facet of two finite cells A and B, so the neighbor with the
//    smaller h(q) is on the side of q, and walking to the least of the neighbors' values is a walk towards q
//    that may stop at the first cell that is certified in conflict. Values are rounded: that may mislead the
//    walk, not the answer.
// 2. Where the descent ends uncertified, a visibility walk with exact orientations. It cannot cycle in a
//    Delaunay triangulation (Edelsbrunner 1990, doi:10.1007/BF02122779) and ends in a cell that contains q,
//    which q is in conflict with unless it is one of its vertices or hidden, or beyond the hull in an infinite
//    cell in conflict.
#pragma once

#include "engine/conflict.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace delone::engine {

struct WalkResult {
  Index cell = invalid_index;    ///< a cell in conflict with q, or one that has the vertex at q
  Index vertex = invalid_index;  ///< the vertex at q, if there is one
  bool hidden = false;  ///< no cell is in conflict with q, which is in the closed simplex (or cone) of `cell`
  bool strictly = false;      ///< hidden, and for certain not on the hyperplane of `cell`
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
      result.hidden = result.strictly = least;
      return {least ? Descent::hidden : Descent::uncertain, result};
    }
    result.cell = best;
  }
}

/// Whether q is in conflict with no cell for certain, by the cells around one whose functional is nearly the
/// least at q: in a convex hull, cells of one facet of the polytope have equal functionals, of which a
/// descent knows no least.
///
/// A set of cells is collected until each neighbor outside of it is certainly greater than the cell of the
/// set it is a neighbor of. The cell of the set that is truly the least then has no lesser neighbor, nor
/// has any cell of its facet, all of which are in the set; so it is the least of all (a local minimum of a
/// linear function on the polar polytope), and positive as all of the set are.
template <class Cells, QueryGeometry G>
bool is_above_plateau(const Cells& cells, const G& geometry, const typename G::Query& q, Index cell) {
  constexpr std::size_t most_cells = 32;
  std::array<Index, most_cells> plateau{cell};
  std::size_t size = 1;
  const auto h = geometry.evaluator(q);
  for (std::size_t next = 0; next < size; ++next) {
    const double value = h.value(plateau[next]), threshold = h.threshold(plateau[next]);
    if (!(value > threshold)) return false;
    const Index* neighbors = cells.neighbors(plateau[next]);
    for (int i = 0; i <= cells.dimension(); ++i) {
      if (h.value(neighbors[i]) - h.threshold(neighbors[i]) > value + threshold) continue;
      const auto end = plateau.begin() + static_cast<std::ptrdiff_t>(size);
      if (std::find(plateau.begin(), end, neighbors[i]) != end) continue;
      if (size == most_cells) return false;
      plateau[size++] = neighbors[i];
    }
  }
  return true;
}

/// As far as a descent gets, and plateaus: what is certain by cached functionals alone.
template <class Cells, QueryGeometry G>
std::pair<Descent, WalkResult> approach(const Cells& cells, const G& geometry, const typename G::Query& q,
                                        Index start) {
  std::pair<Descent, WalkResult> reached = descend(cells, geometry, q, start);
  if constexpr (G::has_plateaus)
    if (reached.first == Descent::uncertain && is_above_plateau(cells, geometry, q, reached.second.cell)) {
      reached.first = Descent::hidden;
      reached.second.hidden = reached.second.strictly = true;
    }
  return reached;
}

/// A cell in conflict with q, or that q is hidden, where nothing is known that a walk could go by: all cells
/// are asked.
template <class Cells, QueryGeometry G>
WalkResult search_all(const Cells& cells, const G& geometry, const typename G::Query& q,
                      StageCounts& counts) {
  const auto functional = geometry.evaluator(q);
  for (Index cell = 0; cell < cells.num_slots(); ++cell)
    if (!cells.is_vacant(cell) && in_conflict_exactly(cells, geometry, cell, q, functional, counts))
      return {cell};
  WalkResult nowhere{0};
  nowhere.hidden = true;
  return nowhere;
}

/// A cell in conflict with q, or the vertex at q, or that q is hidden. REQUIRES can_walk() of cells that
/// other threads change.
template <class Cells, QueryGeometry G>
WalkResult locate(const Cells& cells, const G& geometry, const typename G::Query& q, Index start,
                  StageCounts& counts) {
  if constexpr (requires { cells.num_slots(); })
    if (!geometry.can_walk()) return search_all(cells, geometry, q, counts);
  const auto [outcome, descent] = approach(cells, geometry, q, start);
  if (outcome != Descent::uncertain) return descent;
  WalkResult result = walk_exactly(cells, geometry, q, descent.cell, true, counts);
  result.visited += descent.visited;
  if (result.hidden) {
    const auto functional = geometry.evaluator(q);
    result.strictly = functional.value(result.cell) > functional.threshold(result.cell);
  }
  return result;
}

/// The cell of a star for a walk to q to start from: one in conflict with q, or else the one with the least
/// value, of some. In a sorted order the star of the last vertex is near q, but where cells are flat a walk
/// from any of them may be long. REQUIRES that the star is not empty.
template <QueryGeometry G>
Index start_in_star(const G& geometry, const typename G::Query& q, std::span<const HorizonFacet> star) {
  constexpr std::size_t most = 64;
  const auto functional = geometry.evaluator(q);
  Index best = star.back().created;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0, step = star.size() / most + 1; f < star.size(); f += step) {
    const Index cell = star[f].created;
    const double value = functional.value(cell);
    if (value < -functional.threshold(cell)) return cell;
    if (value < least && !geometry.is_infinite(cell)) {
      least = value;
      best = cell;
    }
  }
  return best;
}

}  // namespace delone::engine
