// SPDX-License-Identifier: BSD-3-Clause
// The conflict zone of a query point and its border, the horizon (§2.6 of the report). The zone is connected, so it is found
// by breadth-first search from one of its cells.
#pragma once

#include "engine/conflict.hpp"
#include "growable_array.hpp"

#include <algorithm>
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

/// Reused from insertion to insertion: the arrays only grow.
struct ConflictZone {
  std::size_t num_cells = 0;
  std::size_t num_facets = 0;
  GrowableArray<Index> cells;           ///< in conflict
  GrowableArray<double> values;         ///< h̃(q) of each
  GrowableArray<HorizonFacet> horizon;  ///< facets to cells that are not
  std::vector<Index> marked;            ///< cells not in conflict that are marked so, as it took the exact stages to know

  /// Makes room for `more` cells and as many facets.
  void reserve(std::size_t more) {
    if (num_cells + more > std::min(cells.capacity(), values.capacity())) {
      cells.reserve(2 * (num_cells + more));
      values.reserve(2 * (num_cells + more));
    }
    if (num_facets + more > horizon.capacity()) horizon.reserve(2 * (num_facets + more));
  }
};

/// Fills `zone` from a cell in conflict. Marks: mark(cell) and set_mark(cell, mark); all cells must be unseen before, and the
/// cells of the zone and of `zone.marked` stay marked. REQUIRES that no vertex is at q.
///
/// The functional of a neighbor that is not known to be in conflict is evaluated at every visit, and both lists are written but
/// only one of them advances: cheaper than branches that depend on the data. If memory runs out, `zone` holds all that is
/// marked.
template <int K, Geometry G, class Marks>
void find_conflict_zone(const CellStore<K>& cells, const G& geometry, const typename G::Query& q, Index first, Marks& marks,
                        ConflictZone& zone, StageCounts& counts) {
  const int facets = cells.dimension() + 1;
  zone.num_cells = zone.num_facets = 0;
  zone.marked.clear();
  zone.reserve(1);
  zone.cells[0] = first;
  zone.values[0] = geometry.value(first, q);
  zone.num_cells = 1;
  marks.set_mark(first, Mark::in_conflict);
  std::uint64_t filtered = 0;
  for (std::size_t next = 0; next < zone.num_cells; ++next) {
    zone.reserve(static_cast<std::size_t>(facets));
    const Index cell = zone.cells[next];
    const Index* neighbors = cells.neighbors(cell);
    const double value = zone.values[next];
    for (int i = 0; i < facets; ++i) {
      const Index neighbor = neighbors[i];
      const Mark mark = marks.mark(neighbor);
      if (mark == Mark::in_conflict) continue;
      const double neighbor_value = geometry.value(neighbor, q);
      const Sign side = geometry.filter_side(neighbor, neighbor_value, q);
      bool conflict = side == Sign::negative;
      if (side == Sign::zero && mark == Mark::unseen) [[unlikely]] {
        conflict = in_conflict_exactly(cells, geometry, neighbor, q, counts);
        if (!conflict) {
          zone.marked.push_back(neighbor);
          marks.set_mark(neighbor, Mark::not_in_conflict);
        }
      }
      filtered += side != Sign::zero;
      zone.cells[zone.num_cells] = neighbor;
      zone.values[zone.num_cells] = neighbor_value;
      zone.num_cells += conflict;
      zone.horizon[zone.num_facets] = {cell, i, value, neighbor_value};
      zone.num_facets += !conflict;
      if (conflict) marks.set_mark(neighbor, Mark::in_conflict);
    }
  }
  counts.filter += filtered;
}

/// Takes back the marks that find_conflict_zone() has set.
template <class Marks>
void unmark(Marks& marks, const ConflictZone& zone) {
  for (std::size_t i = 0; i < zone.num_cells; ++i) marks.set_mark(zone.cells[i], Mark::unseen);
  for (const Index cell : zone.marked) marks.set_mark(cell, Mark::unseen);
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
