// SPDX-License-Identifier: BSD-3-Clause
// The conflict zone of a query point and its border, the horizon (§2.6 of the report). The zone is connected,
// so it is found by breadth-first search from one of its cells.
#pragma once

#include "base/growable_array.hpp"
#include "base/progress_meter.hpp"
#include "base/stamped_table.hpp"
#include "cells/horizon_facet.hpp"
#include "engine/conflict.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::engine {

using internal::GrowableArray;

/// Memory that is reused from insertion to insertion: the arrays only grow.
struct ConflictZone {
  /// The neighbor of cell number `from` of the zone across its facet `slot`.
  struct Candidate {
    Index cell;
    std::uint32_t from, slot;
  };
  /// A cell that the filter leaves open, and the answer of the other stages.
  struct Undecided {
    Index cell;
    double value;  ///< h̃(q)
    Unperturbed known;
  };
  /// A neighbor that the filter leaves open: an undecided cell, or one that is known not to be in conflict.
  struct Open : Candidate {
    double value;
    std::uint32_t undecided;  ///< its number among the undecided cells, or none
    static constexpr std::uint32_t none = 0xffffffff;
  };
  /// How many cells are searched at a time, and how many cells ahead neighbors are prefetched. A processor
  /// fetches only some dozens of cache lines at once, so there are fewer cells if these are larger.
  static constexpr std::size_t block_size(std::size_t facets_of_cell) { return facets_of_cell <= 4 ? 16 : 4; }
  /// The same where neighbors are claimed, at the cost of a fence for each block.
  static constexpr std::size_t shared_block_size(std::size_t facets_of_cell) {
    return facets_of_cell <= 4 ? 16 : 8;
  }
  static constexpr std::size_t cells_ahead(std::size_t facets_of_cell) {
    return facets_of_cell <= 4 ? 32 : 16;
  }
  /// How many open neighbors are decided together before everything else has been searched: as many as fill
  /// the SIMD lanes when ties on small grids are broken; from 6D on there are more lanes.
  static constexpr std::size_t enough_open(std::size_t facets_of_cell) {
    return facets_of_cell <= 6 ? 16 : 32;
  }

  std::size_t num_cells = 0;
  std::size_t num_facets = 0;
  std::size_t num_marked = 0;
  std::size_t num_infinite = 0;         ///< of the cells; known when they have been replaced
  GrowableArray<Index> cells;           ///< in conflict
  GrowableArray<double> values;         ///< h̃(q) of each
  GrowableArray<HorizonFacet> horizon;  ///< facets to cells that are not
  GrowableArray<Index> marked;  ///< cells of the horizon that are marked: the exact stages decided them
  // For the star that replaces the zone: the slots that its cells get.
  GrowableArray<std::uint8_t> has_facets;  ///< of each cell in conflict
  GrowableArray<Index> without_facets;     ///< cells in conflict that have none
  GrowableArray<std::uint32_t> others;     ///< facets that are not the last of their cell in conflict
  GrowableArray<Index> made;               ///< room for the cells of that star
  // The block that is being searched.
  std::vector<Candidate> candidates;
  std::vector<double> candidate_values;  ///< h̃(q) of each
  // The blocks since open neighbors were last decided.
  std::vector<Undecided> undecided;
  std::vector<Open> open;
  std::vector<Index> asked;          ///< those that are not proved ties
  std::vector<double> thresholds;    ///< of these cells, for q
  std::vector<Index> tied_vertices;  ///< of the cells that decide the ties, where they are copied
  std::vector<const Index*> tied;    ///< those of each
  std::vector<Sign> sides;           ///< of these cells
  std::size_t num_undecided = 0, num_open = 0;

  /// Makes room for `more` cells and as many horizon facets, and for the candidates of a block and what is
  /// open. Throws std::bad_alloc. Cells must have as many facets as at the first call.
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
    marked.reserve(size);  // no more than there are facets
    has_facets.reserve(size);
    without_facets.reserve(size);
    others.reserve(size);
    made.reserve(size);
    const std::size_t neighbors = shared_block_size(facets_of_cell) * facets_of_cell,
                      most_open = neighbors + enough_open(facets_of_cell);
    candidates.resize(neighbors + 1);
    candidate_values.resize(neighbors);
    undecided.resize(most_open);
    open.resize(most_open);
    asked.resize(most_open);
    thresholds.resize(most_open + 1);
    tied_vertices.resize(most_open * facets_of_cell);
    tied.resize(most_open);
    sides.resize(most_open);
    room_ = size;
  }

  std::size_t room_ = 0;  // what all arrays have
};

/// Decides the cells that the filter has left open, all ties together, and adds them to the zone or to its
/// horizon. Returns the number of these neighbors.
template <class Cells, QueryGeometry G, class Evaluator, class Marks>
[[gnu::noinline]] std::size_t decide_open(const Cells& cells, const G& geometry, const typename G::Query& q,
                                          const Evaluator& functional, Marks marks, ConflictZone& zone,
                                          StageCounts& counts) {
  const std::span<ConflictZone::Undecided> undecided{zone.undecided.data(), zone.num_undecided};
  std::size_t num_asked = 0, num_tied = 0;
  for (ConflictZone::Undecided& open : undecided) {
    open.known = {Sign::zero, geometry.proves_tie(open.cell, open.value, q), open.cell};
    zone.asked[num_asked] = open.cell;
    num_asked += !open.known.is_proved_zero;
  }
  geometry.thresholds_at({zone.asked.data(), num_asked}, q, zone.thresholds.data());
  const double* threshold = zone.thresholds.data();
  for (ConflictZone::Undecided& open : undecided) {
    find_unperturbed_side(cells, geometry, open.value, *threshold, q, functional, counts, open.known);
    threshold += !open.known.is_proved_zero;
    if (open.known.side != Sign::zero) continue;
    Index* const room =
        zone.tied_vertices.data() + num_tied * (static_cast<std::size_t>(cells.dimension()) + 1);
    zone.tied[num_tied++] = cells.vertices(open.known.deciding, room);
  }
  perturbed_sides(geometry, {zone.tied.data(), num_tied}, q, zone.sides.data(), counts);
  const std::size_t num_cells = zone.num_cells, num_facets = zone.num_facets;
  std::size_t side = 0;
  for (ConflictZone::Undecided& open : undecided) {
    const bool is_tied = open.known.side == Sign::zero;
    const bool conflict = (is_tied ? zone.sides[side] : open.known.side) == Sign::negative;
    side += is_tied;
    if (open.known.is_proved_zero)
      open.value = std::bit_cast<double>(std::uint64_t{conflict} << 63);  // −0 in conflict
    marks.set(open.cell, conflict ? Mark::in_conflict : Mark::not_in_conflict);
    zone.cells[zone.num_cells] = open.cell;
    zone.values[zone.num_cells] = open.value;
    zone.num_cells += conflict;
    zone.marked[zone.num_marked] = open.cell;
    zone.num_marked += !conflict;
  }
  zone.num_undecided = 0;
  for (const ConflictZone::Open& open : std::span(zone.open.data(), zone.num_open)) {
    HorizonFacet& facet = zone.horizon[zone.num_facets];
    facet.survivor = open.cell;
    facet.dead = static_cast<Index>(open.from);
    facet.slot = static_cast<int>(open.slot);
    facet.survivor_value = open.undecided != ConflictZone::Open::none      ? undecided[open.undecided].value
                           : geometry.proves_tie(open.cell, open.value, q) ? 0.0
                                                                           : open.value;
    zone.num_facets += marks(open.cell) != Mark::in_conflict;
  }
  zone.num_open = 0;
  return zone.num_cells - num_cells + zone.num_facets - num_facets;
}

/// Whether cells must be claimed before they are read, because other threads change them
/// (claimed_cells.hpp).
template <class Cells>
constexpr bool are_shared = requires(const Cells& cells) {
  cells.unclaimed_neighbors(Index{});
};

template <class Cells>
const Index* unclaimed_neighbors(const Cells& cells, Index cell) {
  if constexpr (are_shared<Cells>)
    return cells.unclaimed_neighbors(cell);
  else
    return cells.neighbors(cell);
}
template <class Cells>
auto begin_claims(const Cells& cells, std::size_t most) {
  if constexpr (are_shared<Cells>)
    return cells.begin_claims(most);
  else
    return 0;
}

/// Fills `zone` from a cell in conflict. `marks`: marks(cell), is_unseen(cell), is_in_conflict(cell),
/// set(cell, mark) and set_if(cell, conflict), passed by value; all cells must be unseen before, and the
/// cells of the zone and of `zone.marked` stay marked. REQUIRES that no vertex is at q. If memory runs out,
/// unmark() takes back all marks.
///
/// Whether a neighbor is new, in conflict or on the horizon is unpredictable, and a misprediction costs more
/// than an evaluation. So cells are searched in blocks: first all neighbors not yet known to be in conflict
/// are collected, then all are evaluated, then each is written to the zone and to the horizon, of which at
/// most one advances. The only branch that depends on data is that for tests the filter leaves open, and no
/// evaluation waits for the mark of the one before it. Neighbors are prefetched some blocks ahead. Open tests
/// wait until there are several, and are decided together.
///
/// In two dimensions the zone is a tree, unless vertices lose all their cells: the only neighbor known to be
/// in conflict is the one from which a cell was found. Evaluating it again is cheaper than collecting the
/// others, with fewer mispredicted ends of loops.
template <class Cells, QueryGeometry G, class Marks>
void find_conflict_zone(const Cells& cells, const G& geometry, const typename G::Query& q, Index first,
                        Marks marks, ConflictZone& zone, StageCounts& counts) {
  const auto facets = static_cast<std::size_t>(cells.dimension()) + 1;
  const std::size_t block_size = are_shared<Cells> ? ConflictZone::shared_block_size(facets)
                                                   : ConflictZone::block_size(facets),
                    cells_ahead = ConflictZone::cells_ahead(facets);
  const std::size_t enough_open = ConflictZone::enough_open(facets);
  const bool is_tree = facets <= 3 && !are_shared<Cells>;
  zone.num_cells = zone.num_facets = zone.num_marked = zone.num_infinite = 0;
  zone.reserve(1, facets);
  const auto functional = geometry.evaluator(q);
  zone.cells[0] = first;
  zone.values[0] = functional.value(first);
  if (geometry.proves_tie(first, zone.values[0], q)) zone.values[0] = -0.0;
  zone.num_cells = 1;
  marks.set(first, Mark::in_conflict);
  constexpr std::size_t cells_per_look = 2048;
  std::size_t prefetched = 0, next_look = cells_per_look;
  std::uint64_t evaluated = 0, uncertain = 0;
  [[maybe_unused]] std::size_t fenced = 0;  // so many cells of the zone were marked before the last fence
  zone.num_undecided = zone.num_open = 0;
  const auto leave_open = [&](Index cell, double value, std::size_t from, std::size_t slot) {
    const Mark mark = marks(cell);
    if (mark == Mark::in_conflict) {
      uncertain += !is_tree;
      return;
    }
    ConflictZone::Open& open = zone.open[zone.num_open++];
    open = {{cell, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(slot)},
            value,
            ConflictZone::Open::none};
    if (mark != Mark::unseen) return;
    marks.set(cell, Mark::not_in_conflict);                            // until it is decided
    if (geometry.is_infinite(cell)) cells.prefetch_across_hull(cell);  // that cell decides ties
    open.undecided = static_cast<std::uint32_t>(zone.num_undecided);
    zone.undecided[zone.num_undecided++] = {cell, value, {}};
  };
  for (std::size_t next = 0; next < zone.num_cells;) {
    if (next >= next_look) [[unlikely]] {
      internal::cancellation_point();
      next_look = next + cells_per_look;
    }
    zone.reserve(block_size * facets + enough_open, facets);
    Index* const zone_cells = zone.cells.data();
    double* const zone_values = zone.values.data();
    HorizonFacet* const horizon = zone.horizon.data();
    std::size_t num_cells = zone.num_cells, num_facets = zone.num_facets;
    const auto place = [&](Index neighbor, double value, std::size_t from, std::size_t slot) {
      const bool unseen = marks.is_unseen(neighbor);
      const bool conflict = std::signbit(value);
      if (!(std::fabs(value) > functional.threshold(neighbor))) [[unlikely]] {
        leave_open(neighbor, value, from, slot);
        return;
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
      const std::size_t end = next + block_size;
      for (; next < std::min(end, num_cells); ++next) {
        const Index* const neighbors = cells.neighbors(zone_cells[next]);
        for (std::size_t i = 0; i < facets; ++i) place(neighbors[i], functional.value(neighbors[i]), next, i);
      }
    } else {
      const std::size_t last_prefetched = std::min(num_cells, next + cells_ahead);
      if constexpr (are_shared<Cells>) {  // the zone is owned before its neighbors are known
        const bool are_fenced = last_prefetched <= fenced;
        cells.own(zone_cells + prefetched, last_prefetched - prefetched, are_fenced);
        if (!are_fenced) fenced = num_cells;
      }
      for (; prefetched < last_prefetched; ++prefetched) cells.prefetch_neighbors(zone_cells[prefetched]);
      ConflictZone::Candidate* const candidates = zone.candidates.data();
      double* const values = zone.candidate_values.data();
      const std::size_t end = std::min(next + block_size, num_cells);
      std::size_t num_candidates = 0;
      // Where others change cells, all neighbors are claimed before any of them is read.
      [[maybe_unused]] auto claiming = begin_claims(cells, block_size * facets);
      for (; next < end; ++next) {
        const Index* const neighbors = unclaimed_neighbors(cells, zone_cells[next]);
        for (std::size_t i = 0; i < facets; ++i) {
          const Index neighbor = neighbors[i];
          candidates[num_candidates] = {neighbor, static_cast<std::uint32_t>(next),
                                        static_cast<std::uint32_t>(i)};
          if constexpr (are_shared<Cells>)
            num_candidates += claiming.add(neighbor);
          else
            num_candidates += !marks.is_in_conflict(neighbor);
        }
      }
      if constexpr (are_shared<Cells>)
        if (cells.end_claims(claiming)) fenced = num_cells;
      for (std::size_t c = 0; c < num_candidates; ++c) values[c] = functional.value(candidates[c].cell);
      for (std::size_t c = 0; c < num_candidates; ++c)
        place(candidates[c].cell, values[c], candidates[c].from, candidates[c].slot);
      evaluated += num_candidates;
    }
    zone.num_cells = num_cells;
    zone.num_facets = num_facets;
    if (const std::size_t open = zone.num_open; open >= enough_open || (open > 0 && next == zone.num_cells)) {
      const std::size_t added = decide_open(cells, geometry, q, functional, marks, zone, counts);
      uncertain += is_tree ? added : open;  // what counts as evaluated
    }
  }
  if (is_tree) evaluated = zone.num_cells - 1 + zone.num_facets;
  counts.filter += evaluated - uncertain;
}

/// Takes back the marks that find_conflict_zone() has set.
template <class Marks>
void unmark(Marks marks, const ConflictZone& zone) {
  for (std::size_t i = 0; i < zone.num_cells; ++i) marks.set(zone.cells[i], Mark::unseen);
  for (std::size_t i = 0; i < zone.num_marked; ++i) marks.set(zone.marked[i], Mark::unseen);
  for (std::size_t i = 0; i < zone.num_undecided; ++i) marks.set(zone.undecided[i].cell, Mark::unseen);
}

/// Marks kept outside the cells, for queries that must not change them.
class SeparateMarks {
 public:
  explicit SeparateMarks(internal::StampedTable& marks) : marks_(marks) {}
  Mark operator()(Index cell) const {
    const std::uint32_t* const found = marks_.find_value(cell);
    return found == nullptr ? Mark::unseen : static_cast<Mark>(*found);
  }
  bool is_unseen(Index cell) const { return (*this)(cell) == Mark::unseen; }
  bool is_in_conflict(Index cell) const { return (*this)(cell) == Mark::in_conflict; }
  void set(Index cell, Mark mark) { marks_.set(cell, static_cast<std::uint32_t>(mark)); }
  void set_if(Index cell, bool conflict) {
    if (conflict) set(cell, Mark::in_conflict);
  }

 private:
  internal::StampedTable& marks_;
};

}  // namespace delone::engine
