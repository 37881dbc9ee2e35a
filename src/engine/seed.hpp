// SPDX-License-Identifier: BSD-3-Clause
// The first sphere: k+1 affinely independent vertices make one finite cell and one infinite cell per facet.
#pragma once

#include "engine/cell_store.hpp"
#include "engine/geometry_concept.hpp"

#include <span>
#include <utility>

namespace delone::engine {

/// Fills an empty store with the boundary of the simplex of the infinite vertex and the given ones.
/// REQUIRES k ≥ 1, and that the vertices in this order are positively oriented.
template <int K, Geometry G>
void seed(CellStore<K>& cells, G& geometry, std::span<const Index> vertices) {
  const int k = cells.dimension();
  cells.reserve(static_cast<std::size_t>(k) + 2);
  const Index finite = cells.allocate();
  for (int i = 0; i <= k; ++i) cells.vertices(finite)[i] = vertices[static_cast<std::size_t>(i)];
  // Infinite cell i has the infinite vertex in place of vertex i, and two slots exchanged: in the same slots, the vertices
  // opposite a common facet would be on one side of it, and the orientation incoherent.
  for (int i = 0; i <= k; ++i) {
    const Index cell = cells.allocate();
    Index* v = cells.vertices(cell);
    Index* n = cells.neighbors(cell);
    for (int j = 0; j <= k; ++j) {
      v[j] = vertices[static_cast<std::size_t>(j)];
      n[j] = finite + 1 + static_cast<Index>(j);
    }
    v[i] = index(infinite_vertex);
    n[i] = finite;
    cells.neighbors(finite)[i] = cell;
    std::swap(v[0], v[1]);
    std::swap(n[0], n[1]);
  }
  for (Index cell = finite; cell <= finite + static_cast<Index>(k) + 1; ++cell) {
    const int infinite_slot = cells.infinite_slot(cell);
    geometry.create(cell, cells.vertices(cell), infinite_slot, infinite_slot == 0 ? 1 : 0);
  }
}

}  // namespace delone::engine
