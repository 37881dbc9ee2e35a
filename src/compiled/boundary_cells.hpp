// SPDX-License-Identifier: BSD-3-Clause
// What boundaries do with their cells, whatever their vertices stand for: points, or the duals of halfspaces.
// Vertex v is site v − 1.
#pragma once

#include "base/progress_meter.hpp"
#include "compiled/simplicial_hull.hpp"

#include <vector>

namespace delone::internal {

inline std::vector<Index> vertices_of(std::vector<Index> sites) {
  for (Index& site : sites) ++site;
  return sites;
}

/// The cells numbered without gaps, their vertices as sites.
template <class Cells>
SimplicialHull simplicial_hull_of(const Cells& cells) {
  SimplicialHull hull;
  const std::size_t k = static_cast<std::size_t>(cells.dimension()) + 1;
  hull.dimension = static_cast<int>(k);
  std::vector<Index> compact(cells.num_slots(), invalid_index);
  hull.slots.reserve(cells.num_cells());
  for (Index cell = 0; cell < cells.num_slots(); ++cell) {
    if (cells.is_vacant(cell)) continue;
    compact[cell] = static_cast<Index>(hull.slots.size());
    hull.slots.push_back(cell);
  }
  hull.cells.resize(hull.slots.size() * k);
  hull.neighbors.resize(hull.slots.size() * k);
  Index *vertex = hull.cells.data(), *neighbor = hull.neighbors.data();
  for (const Index cell : hull.slots) {
    cancellation_point();
    for (std::size_t i = 0; i < k; ++i) {
      *vertex++ = cells.vertex(cell, static_cast<int>(i)) - 1;
      *neighbor++ = compact[cells.neighbors(cell)[i]];
    }
  }
  return hull;
}

}  // namespace delone::internal
