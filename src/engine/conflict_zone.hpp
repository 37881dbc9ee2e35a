// SPDX-License-Identifier: BSD-3-Clause
// The conflict zone of a query point and its border, the horizon (§2.6 of the report). The zone is connected, so it is found
// by breadth-first search from one of its cells.
#pragma once

#include "engine/conflict.hpp"

#include <unordered_map>
#include <vector>

namespace delone::engine {

/// A facet between a cell of the zone and a surviving cell: facet `slot` of `cell`.
struct HorizonFacet {
  Index cell;
  int slot;
  double value;           ///< h̃(q) of the cell of the zone
  double survivor_value;  ///< h̃(q) of the surviving cell
};

struct ConflictZone {
  std::vector<Index> cells;           ///< in conflict
  std::vector<double> values;         ///< h̃(q) of each
  std::vector<HorizonFacet> horizon;  ///< facets to cells that are not
  std::vector<Index> border;          ///< the cells across the horizon, each once

  void clear() {
    cells.clear();
    values.clear();
    horizon.clear();
    border.clear();
  }
};

/// Fills `zone` from a cell in conflict. Marks: mark(cell) and set_mark(cell, mark); all cells must be unseen before, and the
/// cells of `zone.cells` and `zone.border` stay marked. REQUIRES that no vertex is at q.
template <int K, Geometry G, class Marks>
void find_conflict_zone(const CellStore<K>& cells, const G& geometry, const typename G::Query& q, Index first, Marks& marks,
                        ConflictZone& zone, StageCounts& counts) {
  zone.clear();
  zone.cells.push_back(first);
  zone.values.push_back(geometry.value(first, q));
  marks.set_mark(first, Mark::in_conflict);
  for (std::size_t next = 0; next < zone.cells.size(); ++next) {
    const Index cell = zone.cells[next];
    const Index* neighbors = cells.neighbors(cell);
    for (int i = 0; i <= cells.dimension(); ++i) {
      const Index neighbor = neighbors[i];
      const Mark mark = marks.mark(neighbor);
      if (mark == Mark::in_conflict) continue;
      double value;
      if (mark == Mark::unseen) {
        if (in_conflict(cells, geometry, neighbor, q, value, counts)) {
          marks.set_mark(neighbor, Mark::in_conflict);
          zone.cells.push_back(neighbor);
          zone.values.push_back(value);
          continue;
        }
        marks.set_mark(neighbor, Mark::not_in_conflict);
        zone.border.push_back(neighbor);
      } else {
        value = geometry.value(neighbor, q);
      }
      zone.horizon.push_back({cell, i, zone.values[next], value});
    }
  }
}

/// Marks kept outside the cells, for queries that must not change them.
class SeparateMarks {
 public:
  Mark mark(Index cell) const {
    const auto found = marks_.find(cell);
    return found == marks_.end() ? Mark::unseen : found->second;
  }
  void set_mark(Index cell, Mark mark) { marks_[cell] = mark; }

 private:
  std::unordered_map<Index, Mark> marks_;
};

}  // namespace delone::engine
