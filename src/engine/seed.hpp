// SPDX-License-Identifier: BSD-3-Clause
// The first sphere: the boundary of a simplex. For Delaunay triangulations one of its vertices is the infinite one: k+1
// affinely independent vertices make one finite cell and one infinite cell per facet.
#pragma once

#include "engine/cell_store.hpp"
#include "engine/geometry_concept.hpp"

#include <span>
#include <utility>

namespace delone::engine {

/// Fills an empty store with the boundary of the simplex of the given k+1 vertices and `last`. Its first cell has the given
/// vertices in their order; the others are oriented alike. REQUIRES k ≥ 1.
template <int K, Geometry G>
void seed(CellStore<K>& cells, G& geometry, std::span<const Index> vertices, Index last = index(infinite_vertex)) {
  const int k = cells.dimension();
  cells.reserve(static_cast<std::size_t>(k) + 2);
  const Index first = cells.allocate();
  for (int i = 0; i <= k; ++i) cells.vertices(first)[i] = vertices[static_cast<std::size_t>(i)];
  // Cell i+1 has the last vertex in place of vertex i, and two slots exchanged: in the same slots, the vertices opposite a
  // common facet would be on one side of it, and the orientation incoherent.
  for (int i = 0; i <= k; ++i) {
    const Index cell = cells.allocate();
    Index* v = cells.vertices(cell);
    Index* n = cells.neighbors(cell);
    for (int j = 0; j <= k; ++j) {
      v[j] = vertices[static_cast<std::size_t>(j)];
      n[j] = first + 1 + static_cast<Index>(j);
    }
    v[i] = last;
    n[i] = first;
    cells.neighbors(first)[i] = cell;
    std::swap(v[0], v[1]);
    std::swap(n[0], n[1]);
  }
  for (Index cell = first; cell <= first + static_cast<Index>(k) + 1; ++cell) {
    const int infinite_slot = cells.infinite_slot(cell);
    geometry.create(cell, cells.vertices(cell), infinite_slot, infinite_slot == 0 ? 1 : 0);
  }
}

}  // namespace delone::engine
