// SPDX-License-Identifier: BSD-3-Clause
// Is a cell in conflict with a query point? The exact stages, for where the filter is not certain.
#pragma once

#include "engine/cell_store.hpp"
#include "engine/geometry_concept.hpp"

namespace delone::engine {

/// The exact conflict test, without the filter. A query exactly on the hyperplane of an infinite cell conflicts with it iff it
/// conflicts with the finite cell on the other side of the hull facet: the perturbation moves points along that hyperplane.
/// REQUIRES that q is none of the vertices of the cell, nor of the finite neighbor of an infinite cell.
template <int K, Geometry G>
bool in_conflict_exactly(const CellStore<K>& cells, const G& geometry, Index cell, const typename G::Query& q,
                         StageCounts& counts) {
  const int infinite_slot = cells.infinite_slot(cell);
  const Sign side = geometry.exact_side(cells.vertices(cell), infinite_slot, q, counts);
  if (side != Sign::zero) return side == Sign::negative;
  return in_conflict_exactly(cells, geometry, cells.neighbors(cell)[infinite_slot], q, counts);
}

/// The vertex of the cell at q, or invalid_index.
template <int K, Geometry G>
Index vertex_at(const CellStore<K>& cells, const G& geometry, Index cell, const typename G::Query& q) {
  const Index* v = cells.vertices(cell);
  for (int i = 0; i <= cells.dimension(); ++i)
    if (v[i] != index(infinite_vertex) && geometry.is_at(v[i], q)) return v[i];
  return invalid_index;
}

}  // namespace delone::engine
