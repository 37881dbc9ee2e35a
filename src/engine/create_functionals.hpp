// SPDX-License-Identifier: BSD-3-Clause
// What is cached for cells that no insertion has made: those of first spheres, all when the frame of
// coordinates has changed, and those that are put back.
#pragma once

#include "engine/cell_store.hpp"
#include "engine/geometry_concept.hpp"

#include <new>

namespace delone::engine {

/// Where memory is short, nothing is cached, and exact stages decide.
template <int K, Geometry G>
void create_functional(const CellStore<K>& cells, G& geometry, Index cell) noexcept {
  const int infinite_slot = cells.infinite_slot(cell);
  try {
    const auto vertices = cells.vertices(cell);
    geometry.create(cell, vertices, infinite_slot, infinite_slot == 0 ? 1 : 0);
  } catch (const std::bad_alloc&) {
    geometry.give_up(cell, infinite_slot >= 0);
  }
}

template <int K, Geometry G>
void create_functionals(const CellStore<K>& cells, G& geometry) noexcept {
  for (Index cell = 0; cell < cells.num_slots(); ++cell)
    if (!cells.is_vacant(cell)) create_functional(cells, geometry, cell);
}

}  // namespace delone::engine
