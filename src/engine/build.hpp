// SPDX-License-Identifier: BSD-3-Clause
// The incremental construction (§2.2 and §2.3 of RR-6743): read this file first.
//
//   for each vertex q, in the order of order/:
//     q outside the affine hull so far?  dimension_jump.hpp   every cell is joined to q            (§2.4)
//     locate.hpp                         walk to a cell in conflict with q                         (§2.5)
//     conflict_zone.hpp                  all cells in conflict: those whose sphere contains q      (§2.6)
//     retriangulate.hpp                  replace the zone by the star of q                         (§2.6)
//
// The cells triangulate a sphere, thanks to the infinite vertex, so none of the steps has special cases at
// the hull.
#pragma once

#include "engine/locate.hpp"
#include "engine/retriangulate.hpp"

#include <limits>

namespace delone::engine {

/// What insertions have cost.
struct Effort {
  std::uint64_t created_cells = 0;
  std::uint64_t visited_cells = 0;
  StageCounts stages;
};

/// Memory that insertions reuse.
struct Workspace {
  ConflictZone zone;
  RidgeTable ridges;
  Index last_cell = 0;            ///< where the last walk ended
  bool tracks_swallowed = false;  ///< whether insertions fill `swallowed`
  std::vector<Index> swallowed;   ///< the vertices that lost all their cells by the last insertion

  /// The facets that the cells of the last insertion were made from.
  std::span<const HorizonFacet> star() const { return {zone.horizon.data(), zone.num_facets}; }
};

/// The cell of a star for a walk to q to start from: one in conflict with q, or else the one with the least
/// value, of some. In a sorted order the star of the last vertex is near q, but where cells are flat a walk
/// from any of them may be long. REQUIRES that the star is not empty.
template <Geometry G>
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

/// Inserts vertex v, whose point is q, into a cell in conflict with q. Strong guarantee: if it throws
/// (memory, ids), nothing has changed. REQUIRES q in the affine hull of the vertices and no vertex at q.
template <int K, Geometry G>
void insert_in_conflict(CellStore<K>& cells, G& geometry, Index v, const typename G::Query& q, Index cell,
                        Workspace& work, Effort& effort) {
  try {
    find_conflict_zone(cells, geometry, q, cell, cells.marks(), work.zone, effort.stages);
    retriangulate(cells, geometry, v, q, work.zone, work.ridges,
                  work.tracks_swallowed ? &work.swallowed : nullptr);
  } catch (...) {
    unmark(cells.marks(), work.zone);
    work.zone.num_cells = work.zone.num_facets = 0;  // there is no star
    throw;
  }
  effort.created_cells += work.zone.num_facets;
}

/// Inserts vertex v, whose point is q, starting the walk at `start`. Returns v; or the vertex that is at q
/// already; or invalid_index: q is in conflict with no cell, and hidden. Guarantee and REQUIRES as above.
template <int K, Geometry G>
Index insert(CellStore<K>& cells, G& geometry, Index v, const typename G::Query& q, Index start,
             Workspace& work, Effort& effort) {
  work.zone.num_cells = work.zone.num_facets = 0;
  work.swallowed.clear();
  const WalkResult found = locate(cells, geometry, q, start, effort.stages);
  effort.visited_cells += found.visited;
  work.last_cell = found.cell;
  if (found.vertex != invalid_index || found.hidden) return found.vertex;
  insert_in_conflict(cells, geometry, v, q, found.cell, work, effort);
  return v;
}

}  // namespace delone::engine
