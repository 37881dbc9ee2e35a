// SPDX-License-Identifier: BSD-3-Clause
// The queries of a triangulation, for all that holds one: an engine, or its compact form. `Held` has cells(),
// geometry(), points(), num_infinite() and first_cell(), where walks start if they are not told.
#pragma once

#include "base/stamped_table.hpp"
#include "compiled/triangulation_engine.hpp"
#include "engine/conflict_zone.hpp"
#include "engine/locate.hpp"

#include <span>
#include <vector>

namespace delone::compiled {

template <class Held>
QueryLocation locate_in(const Held& held, const double* query, Index start) {
  const auto& cells = held.cells();
  const auto& geometry = held.geometry();
  const kernel::Grid grid = held.points().grid_with(query);
  auto q = geometry.make_query(query, grid);
  q.compared = held.points().ambient;
  internal::StageCounts uncounted;
  if (start == invalid_index) start = held.first_cell();
  const Index near = engine::descend(cells, geometry, q, start).second.cell;
  const engine::WalkResult found = engine::walk_exactly(cells, geometry, q, near, false, uncounted);
  QueryLocation location{found.cell, cells.infinite_slot(found.cell) >= 0, {}};
  if (found.vertex != invalid_index) {
    location.face.push_back(VertexId{found.vertex});
  } else if (!location.outside) {
    const auto vertices = cells.vertices(found.cell);
    for (int i = 0; i <= cells.dimension(); ++i)
      if (geometry.side_of_facet(vertices, i, q) == Sign::positive)
        location.face.push_back(VertexId{static_cast<const Index*>(vertices)[i]});
  }
  return location;
}

template <class Held>
std::vector<CellId> conflict_zone_in(const Held& held, const double* query, Index start) {
  const auto& cells = held.cells();
  const auto& geometry = held.geometry();
  const kernel::Grid grid = held.points().grid_with(query);
  const auto q = geometry.make_query(query, grid);
  internal::StageCounts uncounted;
  if (start == invalid_index) start = held.first_cell();
  const engine::WalkResult found = engine::locate(cells, geometry, q, start, uncounted);
  if (found.vertex != invalid_index || found.hidden) return {};
  internal::StampedTable marks;
  engine::ConflictZone zone;
  engine::find_conflict_zone(cells, geometry, q, found.cell, engine::SeparateMarks(marks), zone, uncounted);
  std::vector<CellId> result;
  for (std::size_t i = 0; i < zone.num_cells; ++i) result.push_back(CellId{zone.cells[i]});
  return result;
}

template <class Held>
Sign unperturbed_side_in(const Held& held, Index cell, const double* query) {
  const kernel::Grid grid = held.points().grid_with(query);
  const auto vertices = held.cells().vertices(cell);
  return held.geometry().unperturbed_side(vertices, held.geometry().make_query(query, grid));
}

template <class Held>
Complex complex_in(const Held& held, Index num_vertices, std::span<const CellId> cell_of_vertex) {
  const auto& cells = held.cells();
  return {cells.links_of_complex(), cells.dimension(),
          cells.num_slots(),        cells.num_cells() - held.num_infinite(),
          held.num_infinite(),      num_vertices,
          cell_of_vertex.data(),    static_cast<Index>(cell_of_vertex.size())};
}

}  // namespace delone::compiled
