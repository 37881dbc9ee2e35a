// SPDX-License-Identifier: BSD-3-Clause
// The first sphere: the boundary of a simplex. For Delaunay triangulations one of its vertices is the
// infinite one: k+1 affinely independent vertices make one finite cell and one infinite cell per facet.
#pragma once

#include "engine/cell_store.hpp"
#include "engine/create_functionals.hpp"
#include "engine/geometry_concept.hpp"

#include <algorithm>
#include <span>

namespace delone::engine {

/// Fills an empty store with the boundary of the simplex of the given k+1 vertices and `last`. Its first cell
/// has the given vertices in their order; the others are oriented alike. REQUIRES k ≥ 1.
template <int K, Geometry G>
void seed(CellStore<K>& cells, G& geometry, std::span<const Index> vertices,
          Index last = index(infinite_vertex)) {
  const int k = cells.dimension();
  cells.reserve(static_cast<std::size_t>(k) + 2);
  cells.admit_vertices(std::max(last, *std::max_element(vertices.begin(), vertices.end())));
  const Index first = cells.allocate();
  for (int i = 0; i <= k; ++i) cells.set_vertex(first, i, vertices[static_cast<std::size_t>(i)]);
  // Cell i+1 has the last vertex in place of vertex i, and two slots exchanged: in the same slots, the
  // vertices opposite a common facet would be on one side of it, and the orientation incoherent.
  for (int i = 0; i <= k; ++i) {
    const Index cell = cells.allocate();
    for (int j = 0; j <= k; ++j) {
      const int slot = j < 2 ? 1 - j : j;
      cells.set_vertex(cell, slot, j == i ? last : vertices[static_cast<std::size_t>(j)]);
      cells.neighbors(cell)[slot] = j == i ? first : first + 1 + static_cast<Index>(j);
    }
    cells.neighbors(first)[i] = cell;
  }
  create_functionals(cells, geometry);
}

}  // namespace delone::engine
