// SPDX-License-Identifier: BSD-3-Clause
// Cells that were made otherwise, in the place of those of a boundary.
#pragma once

#include "engine/cell_store.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace delone::engine {

/// `sites`, `neighbors`: k+1 of each cell. The vertex at a site is vertex_of(site), increasing, and cells are
/// numbered from 0 on. `planes`: for each the present cell in the same hyperplane, whose functional it takes
/// over. Throws what a reserve() throws, and then changes nothing.
template <int K, class G, class VertexOf>
void replace_cells(CellStore<K>& cells, G& geometry, std::span<const Index> sites, VertexOf vertex_of,
                   std::span<const Index> neighbors, std::span<const Index> planes) {
  const std::size_t size = static_cast<std::size_t>(cells.dimension()) + 1;
  std::vector<Index> old, ids;
  old.reserve(cells.num_cells());
  ids.reserve(planes.size());
  for (Index cell = 0; cell < cells.num_slots(); ++cell)
    if (!cells.is_vacant(cell)) old.push_back(cell);
  cells.reserve_vacancies(old.size());
  cells.reserve(planes.size());
  cells.admit_vertices(vertex_of(*std::max_element(sites.begin(), sites.end())));
  for (std::size_t c = 0; c < planes.size(); ++c) ids.push_back(cells.allocate());
  for (std::size_t c = 0; c < planes.size(); ++c) {
    for (std::size_t i = 0; i < size; ++i) {
      cells.set_vertex(ids[c], static_cast<int>(i), vertex_of(sites[c * size + i]));
      cells.neighbors(ids[c])[i] = ids[neighbors[c * size + i]];
    }
    geometry.adopt_hyperplane(ids[c], planes[c]);
  }
  for (const Index cell : old) cells.release(cell);
}

}  // namespace delone::engine
