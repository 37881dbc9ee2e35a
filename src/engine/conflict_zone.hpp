// SPDX-License-Identifier: BSD-3-Clause
// The conflict zone of a query point and its border, the horizon (§2.6 of the report). The zone is connected, so it is found
// by breadth-first search from one of its cells.
#pragma once

#include "engine/conflict.hpp"
#include "growable_array.hpp"
#include "horizon_facet.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace delone::engine {

/// Reused from insertion to insertion: the arrays only grow.
struct ConflictZone {
  /// A neighbor of a cell of the zone: the zone's from-th, across its facet `slot`.
  struct Candidate {
    Index cell;
    std::uint32_t from, slot;
  };
  static constexpr std::size_t block_size = 16;

  std::size_t num_cells = 0;
  std::size_t num_facets = 0;
  GrowableArray<Index> cells;           ///< in conflict
  GrowableArray<double> values;         ///< h̃(q) of each
  GrowableArray<HorizonFacet> horizon;  ///< facets to cells that are not
  std::vector<Index> marked;            ///< cells not in conflict that are marked so, as it took the exact stages to know
  std::vector<Candidate> candidates;    ///< of the block that is searched

  /// Makes room for `more` cells and as many horizon facets, and for the candidates of a block. Throws
  /// std::bad_alloc. Cells must have as many facets as at the first call.
  void reserve(std::size_t more, std::size_t facets_of_cell) {
    const std::size_t least = std::max(num_cells, num_facets) + more;
    if (least >= room_) [[unlikely]]
      grow(2 * least, facets_of_cell);
  }

 private:
  [[gnu::noinline]] void grow(std::size_t size, std::size_t facets_of_cell) {
    cells.reserve(size);
    values.reserve(size);
    horizon.reserve(size);
    candidates.resize(block_size * facets_of_cell + 1);
    room_ = size;
  }

  std::size_t room_ = 0;  // what all arrays have
};

/// Fills `zone` from a cell in conflict. `marks`: marks(cell), is_unseen(cell), is_in_conflict(cell), set(cell, mark) and
/// set_if(cell, conflict), passed by value; all cells must be unseen before, and the cells of the zone and of `zone.marked`
/// stay marked. REQUIRES that no vertex is at q. If memory runs out, `zone` holds all that is marked.
///
/// Which neighbor is new, in conflict or on the horizon cannot be predicted, and each wrong guess costs as much as an
/// evaluation. So cells are searched in blocks: first all neighbors not yet known to be in conflict are collected, then each is
/// evaluated and written to the zone and to the horizon, of which at most one advances; no branch depends on the data. The
/// memory of the neighbors of cells ahead in the list is asked for early.
///
/// In two dimensions the zone is a tree, unless vertices lose all their cells: the only neighbor known to be in conflict is
/// that which a cell was found from. To evaluate it again costs less than to collect the others, and mispredicts fewer ends of
/// loops.
template <class Cells, QueryGeometry G, class Marks>
void find_conflict_zone(const Cells& cells, const G& geometry, const typename G::Query& q, Index first, Marks marks,
                        ConflictZone& zone, StageCounts& counts) {
  constexpr std::size_t cells_ahead = 4;
  const auto facets = static_cast<std::size_t>(cells.dimension()) + 1;
  const bool is_tree = facets <= 3;
  zone.num_cells = zone.num_facets = 0;
  zone.marked.clear();
  zone.reserve(1, facets);
  const auto functional = geometry.evaluator(q);
  zone.cells[0] = first;
  zone.values[0] = functional.value(first);
  if (geometry.proves_tie(first, zone.values[0], q)) zone.values[0] = -0.0;
  zone.num_cells = 1;
  marks.set(first, Mark::in_conflict);
  std::uint64_t evaluated = 0, uncertain = 0;
  for (std::size_t next = 0; next < zone.num_cells;) {
    zone.reserve(ConflictZone::block_size * facets, facets);
    Index* const zone_cells = zone.cells.data();
    double* const zone_values = zone.values.data();
    HorizonFacet* const horizon = zone.horizon.data();
    std::size_t num_cells = zone.num_cells, num_facets = zone.num_facets;
    const auto examine = [&](Index neighbor, std::size_t from, std::size_t slot) {
      double value = functional.value(neighbor);
      const bool unseen = marks.is_unseen(neighbor);
      bool conflict = std::signbit(value);
      if (!(std::fabs(value) > functional.threshold(neighbor))) [[unlikely]] {
        const Mark mark = marks(neighbor);
        uncertain += mark != Mark::in_conflict || !is_tree;  // what counts as evaluated below
        if (mark == Mark::in_conflict) return;
        conflict = false;
        if (mark == Mark::unseen) {
          zone.num_cells = num_cells;
          conflict = in_conflict_exactly(cells, geometry, neighbor, q, functional, counts);
          if (!conflict) {
            zone.marked.push_back(neighbor);
            marks.set(neighbor, Mark::not_in_conflict);
          }
        }
        if (geometry.proves_tie(neighbor, value, q)) value = conflict ? -0.0 : 0.0;
      }
      zone_cells[num_cells] = neighbor;
      zone_values[num_cells] = value;
      HorizonFacet& facet = horizon[num_facets];
      facet.survivor_value = value;
      facet.survivor = neighbor;
      facet.dead = static_cast<Index>(from);
      facet.slot = static_cast<int>(slot);
      num_cells += conflict & unseen;
      num_facets += !conflict;
      marks.set_if(neighbor, conflict);
    };

    if (is_tree) {
      const std::size_t end = next + ConflictZone::block_size;
      for (; next < std::min(end, num_cells); ++next) {
        const Index* const neighbors = cells.neighbors(zone_cells[next]);
        for (std::size_t i = 0; i < facets; ++i) examine(neighbors[i], next, i);
      }
    } else {
      ConflictZone::Candidate* const candidates = zone.candidates.data();
      const std::size_t end = std::min(next + ConflictZone::block_size, num_cells);
      std::size_t num_candidates = 0;
      for (; next < end; ++next) {
        if (next + cells_ahead < num_cells) {
          const Index* const ahead = cells.neighbors(zone_cells[next + cells_ahead]);
          for (std::size_t i = 0; i < facets; ++i) cells.prefetch(ahead[i]);
        }
        const Index* const neighbors = cells.neighbors(zone_cells[next]);
        for (std::size_t i = 0; i < facets; ++i) {
          const Index neighbor = neighbors[i];
          candidates[num_candidates] = {neighbor, static_cast<std::uint32_t>(next), static_cast<std::uint32_t>(i)};
          num_candidates += !marks.is_in_conflict(neighbor);
        }
      }
      for (std::size_t c = 0; c < num_candidates; ++c) examine(candidates[c].cell, candidates[c].from, candidates[c].slot);
      evaluated += num_candidates;
    }
    zone.num_cells = num_cells;
    zone.num_facets = num_facets;
  }
  if (is_tree) evaluated = zone.num_cells - 1 + zone.num_facets;
  counts.filter += evaluated - uncertain;
}

/// Takes back the marks that find_conflict_zone() has set.
template <class Marks>
void unmark(Marks marks, const ConflictZone& zone) {
  for (std::size_t i = 0; i < zone.num_cells; ++i) marks.set(zone.cells[i], Mark::unseen);
  for (const Index cell : zone.marked) marks.set(cell, Mark::unseen);
}

/// Marks kept outside the cells, for queries that must not change them.
class SeparateMarks {
 public:
  explicit SeparateMarks(std::unordered_map<Index, Mark>& marks) : marks_(marks) {}
  Mark operator()(Index cell) const {
    const auto found = marks_.find(cell);
    return found == marks_.end() ? Mark::unseen : found->second;
  }
  bool is_unseen(Index cell) const { return (*this)(cell) == Mark::unseen; }
  bool is_in_conflict(Index cell) const { return (*this)(cell) == Mark::in_conflict; }
  void set(Index cell, Mark mark) { marks_[cell] = mark; }
  void set_if(Index cell, bool conflict) {
    if (conflict) set(cell, Mark::in_conflict);
  }

 private:
  std::unordered_map<Index, Mark>& marks_;
};

}  // namespace delone::engine
