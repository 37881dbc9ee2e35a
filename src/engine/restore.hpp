// SPDX-License-Identifier: BSD-3-Clause
// Cells from a complex that has the same vertices.
#pragma once

#include "engine/cell_store.hpp"
#include "engine/create_functionals.hpp"
#include "engine/geometry_concept.hpp"

#include <delone/complex.hpp>

#include <vector>

namespace delone::engine {

/// Fills an empty store. Cells keep their ids if the complex has no vacant slots.
template <int K, Geometry G>
void restore(const Complex& old, CellStore<K>& cells, G& geometry) {
  cells.reserve(old.num_cells());
  cells.admit_vertices(old.num_vertex_slots() - 1);
  std::vector<Index> id(old.num_cell_slots(), invalid_index);
  for (const CellId c : old.cells()) id[index(c)] = cells.allocate();
  for (const CellId c : old.cells())
    for (int i = 0; i <= old.dimension(); ++i) {
      cells.set_vertex(id[index(c)], i, index(old.vertex(c, i)));
      cells.neighbors(id[index(c)])[i] = id[index(old.neighbor(c, i))];
    }
  create_functionals(cells, geometry);
}

}  // namespace delone::engine
