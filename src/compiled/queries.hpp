// SPDX-License-Identifier: BSD-3-Clause
// The queries of a triangulation that stays as it is, for any store of cells and any geometry.
#pragma once

#include "base/stamped_table.hpp"
#include "compiled/triangulation_engine.hpp"
#include "engine/conflict_zone.hpp"
#include "engine/locate.hpp"

#include <vector>

namespace delone::compiled {

template <class Cells, engine::QueryGeometry G>
QueryLocation locate(const Cells& cells, const G& geometry, const typename G::Query& q, Index start) {
  internal::StageCounts uncounted;
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

template <class Cells, engine::QueryGeometry G>
std::vector<CellId> conflict_zone(const Cells& cells, const G& geometry, const typename G::Query& q,
                                  Index start) {
  internal::StageCounts uncounted;
  const engine::WalkResult found = engine::locate(cells, geometry, q, start, uncounted);
  if (found.vertex != invalid_index || found.hidden) return {};
  internal::StampedTable marks;
  engine::ConflictZone zone;
  engine::find_conflict_zone(cells, geometry, q, found.cell, engine::SeparateMarks(marks), zone, uncounted);
  std::vector<CellId> result;
  for (std::size_t i = 0; i < zone.num_cells; ++i) result.push_back(CellId{zone.cells[i]});
  return result;
}

}  // namespace delone::compiled
