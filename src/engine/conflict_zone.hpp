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
#include <utility>
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

/// The searches of a zone, and what they share: how a neighbor becomes part of the zone or of its horizon.
///
/// Whether it is new, in conflict or on the horizon is unpredictable, and a misprediction costs more than an
/// evaluation. So each neighbor is written to the zone and to the horizon, of which at most one advances. The
/// only branch that depends on data is that for tests the filter leaves open: they wait until there are
/// several, and are decided together. Cells are searched in blocks, between which there is room to decide.
template <class Cells, QueryGeometry G, class Marks>
class ZoneSearch {
  using Query = typename G::Query;
  using Evaluator = decltype(std::declval<const G&>().evaluator(std::declval<const Query&>()));
  using Candidate = ConflictZone::Candidate;

 public:
  ZoneSearch(const Cells& cells, const G& geometry, const Query& q, Marks marks, ConflictZone& zone,
             StageCounts& counts)
      : cells_(cells),
        geometry_(geometry),
        q_(q),
        marks_(marks),
        zone_(zone),
        counts_(counts),
        functional_(geometry.evaluator(q)) {}

  /// In two dimensions the zone is a tree, unless vertices lose all their cells: the only neighbor known to
  /// be in conflict is the one from which a cell was found. Evaluating it again is cheaper than collecting
  /// the others, with fewer mispredicted ends of loops.
  [[gnu::always_inline]] void search_tree(Index first) {
    const std::size_t block_size = ConflictZone::block_size(facets());
    start(first);
    for (std::size_t next = 0; next < zone_.num_cells;) {
      Ends ends = begin_block(next, block_size);
      for (const std::size_t end = next + block_size; next < std::min(end, ends.num_cells); ++next) {
        const Index* const neighbors = cells_.neighbors(ends.cells[next]);
        for (std::size_t i = 0; i < facets(); ++i)
          place(ends, candidate(neighbors[i], next, i), functional_.value(neighbors[i]));
      }
      end_block(ends, next);
    }
    counts_.filter += zone_.num_cells - 1 + zone_.num_facets - num_decided_;
  }

  /// Of the cells of a block, first all neighbors not yet known to be in conflict are collected, then all are
  /// evaluated, then all are placed, so that no evaluation waits for the mark of the one before it. Neighbors
  /// are prefetched some blocks ahead.
  [[gnu::always_inline]] void search_blocks(Index first) {
    const std::size_t block_size = ConflictZone::block_size(facets());
    std::size_t prefetched = 0;
    std::uint64_t evaluated = 0;
    start(first);
    for (std::size_t next = 0; next < zone_.num_cells;) {
      Ends ends = begin_block(next, block_size);
      for (const std::size_t end = ahead_of(next, ends); prefetched < end; ++prefetched)
        cells_.prefetch_neighbors(ends.cells[prefetched]);
      Candidate* const candidates = zone_.candidates.data();
      std::size_t count = 0;
      for (const std::size_t end = std::min(next + block_size, ends.num_cells); next < end; ++next) {
        const Index* const neighbors = cells_.neighbors(ends.cells[next]);
        for (std::size_t i = 0; i < facets(); ++i) {
          candidates[count] = candidate(neighbors[i], next, i);
          count += !marks_.is_in_conflict(neighbors[i]);
        }
      }
      evaluate_and_place(ends, count);
      evaluated += count;
      end_block(ends, next);
    }
    counts_.filter += evaluated - num_left_open_;
  }

  /// The same where other threads change cells: the cells of the zone are owned before their neighbors are
  /// known, and all neighbors of a block are claimed before any of them is read.
  [[gnu::always_inline]] void search_claimed(Index first) {
    const std::size_t block_size = ConflictZone::shared_block_size(facets());
    std::size_t prefetched = 0, fenced = 0;  // so many cells were marked before the last fence
    std::uint64_t evaluated = 0;
    start(first);
    for (std::size_t next = 0; next < zone_.num_cells;) {
      Ends ends = begin_block(next, block_size);
      const std::size_t end_ahead = ahead_of(next, ends);
      const bool are_fenced = end_ahead <= fenced;
      cells_.own(ends.cells + prefetched, end_ahead - prefetched, are_fenced);
      if (!are_fenced) fenced = ends.num_cells;
      for (; prefetched < end_ahead; ++prefetched) cells_.prefetch_neighbors(ends.cells[prefetched]);
      Candidate* const candidates = zone_.candidates.data();
      std::size_t count = 0;
      auto claiming = cells_.begin_claims(block_size * facets());
      for (const std::size_t end = std::min(next + block_size, ends.num_cells); next < end; ++next) {
        const Index* const neighbors = cells_.unclaimed_neighbors(ends.cells[next]);
        for (std::size_t i = 0; i < facets(); ++i) {
          candidates[count] = candidate(neighbors[i], next, i);
          count += claiming.add(neighbors[i]);
        }
      }
      if (cells_.end_claims(claiming)) fenced = ends.num_cells;
      evaluate_and_place(ends, count);
      evaluated += count;
      end_block(ends, next);
    }
    counts_.filter += evaluated - num_left_open_;
  }

 private:
  /// Where the zone and its horizon are written, and end, while a block is searched.
  struct Ends {
    Index* cells;
    double* values;
    HorizonFacet* horizon;
    std::size_t num_cells, num_facets;
  };

  static Candidate candidate(Index cell, std::size_t from, std::size_t slot) {
    return {cell, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(slot)};
  }

  std::size_t facets() const { return static_cast<std::size_t>(cells_.dimension()) + 1; }

  void start(Index first) {
    zone_.num_cells = zone_.num_facets = zone_.num_marked = zone_.num_infinite = 0;
    zone_.num_undecided = zone_.num_open = 0;
    zone_.reserve(1, facets());
    zone_.cells[0] = first;
    zone_.values[0] = functional_.value(first);
    if (geometry_.proves_tie(first, zone_.values[0], q_)) zone_.values[0] = -0.0;
    zone_.num_cells = 1;
    marks_.set(first, Mark::in_conflict);
  }

  Ends begin_block(std::size_t next, std::size_t block_size) {
    constexpr std::size_t cells_per_look = 2048;
    if (next >= next_look_) [[unlikely]] {
      internal::cancellation_point();
      next_look_ = next + cells_per_look;
    }
    zone_.reserve(block_size * facets() + ConflictZone::enough_open(facets()), facets());
    return {zone_.cells.data(), zone_.values.data(), zone_.horizon.data(), zone_.num_cells, zone_.num_facets};
  }
  /// `next`: so many cells have been searched. Decides what is open if that is much, or all that is left.
  void end_block(const Ends& ends, std::size_t next) {
    zone_.num_cells = ends.num_cells;
    zone_.num_facets = ends.num_facets;
    if (const std::size_t open = zone_.num_open;
        open >= ConflictZone::enough_open(facets()) || (open > 0 && next == zone_.num_cells))
      num_decided_ += decide_open(cells_, geometry_, q_, Evaluator(functional_), marks_, zone_, counts_);
  }
  /// The end of the cells that neighbors are prefetched of.
  std::size_t ahead_of(std::size_t next, const Ends& ends) const {
    return std::min(ends.num_cells, next + ConflictZone::cells_ahead(facets()));
  }

  void evaluate_and_place(Ends& ends, std::size_t count) {
    const Candidate* const candidates = zone_.candidates.data();
    double* const values = zone_.candidate_values.data();
    for (std::size_t c = 0; c < count; ++c) values[c] = functional_.value(candidates[c].cell);
    for (std::size_t c = 0; c < count; ++c) place(ends, candidates[c], values[c]);
  }
  [[gnu::always_inline]] void place(Ends& ends, Candidate neighbor, double value) {
    const bool unseen = marks_.is_unseen(neighbor.cell);
    const bool conflict = std::signbit(value);
    if (!(std::fabs(value) > functional_.threshold(neighbor.cell))) [[unlikely]] {
      leave_open(neighbor, value);
      return;
    }
    ends.cells[ends.num_cells] = neighbor.cell;
    ends.values[ends.num_cells] = value;
    HorizonFacet& facet = ends.horizon[ends.num_facets];
    facet.survivor_value = value;
    facet.survivor = neighbor.cell;
    facet.dead = static_cast<Index>(neighbor.from);
    facet.slot = static_cast<int>(neighbor.slot);
    ends.num_cells += conflict & unseen;
    ends.num_facets += !conflict;
    marks_.set_if(neighbor.cell, conflict);
  }
  void leave_open(Candidate neighbor, double value) {
    ++num_left_open_;
    const Mark mark = marks_(neighbor.cell);
    if (mark == Mark::in_conflict) return;
    ConflictZone::Open& open = zone_.open[zone_.num_open++];
    open = {neighbor, value, ConflictZone::Open::none};
    if (mark != Mark::unseen) return;
    marks_.set(neighbor.cell, Mark::not_in_conflict);  // until it is decided
    if (geometry_.is_infinite(neighbor.cell)) cells_.prefetch_across_hull(neighbor.cell);  // it decides ties
    open.undecided = static_cast<std::uint32_t>(zone_.num_undecided);
    zone_.undecided[zone_.num_undecided++] = {neighbor.cell, value, {}};
  }

  const Cells& cells_;
  const G& geometry_;
  const Query& q_;
  Marks marks_;
  ConflictZone& zone_;
  StageCounts& counts_;
  const Evaluator functional_;
  std::size_t next_look_ = 2048;
  std::uint64_t num_left_open_ = 0;  // neighbors
  std::uint64_t num_decided_ = 0;    // of these, those that are of the zone or horizon
};

/// Whether cells must be claimed before they are read, because other threads change them
/// (claimed_cells.hpp).
template <class Cells>
constexpr bool are_shared = requires(const Cells& cells) {
  cells.unclaimed_neighbors(Index{});
};

/// Fills `zone` from a cell in conflict. `marks`: marks(cell), is_unseen(cell), is_in_conflict(cell),
/// set(cell, mark) and set_if(cell, conflict), passed by value; all cells must be unseen before, and the
/// cells of the zone and of `zone.marked` stay marked. REQUIRES that no vertex is at q. If memory runs out,
/// unmark() takes back all marks.
template <class Cells, QueryGeometry G, class Marks>
void find_conflict_zone(const Cells& cells, const G& geometry, const typename G::Query& q, Index first,
                        Marks marks, ConflictZone& zone, StageCounts& counts) {
  ZoneSearch<Cells, G, Marks> search(cells, geometry, q, marks, zone, counts);
  if constexpr (are_shared<Cells>)
    search.search_claimed(first);
  else if (cells.dimension() <= 2)
    search.search_tree(first);
  else
    search.search_blocks(first);
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
