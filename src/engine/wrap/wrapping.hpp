// SPDX-License-Identifier: BSD-3-Clause
// Gift wrapping: creates all cells of a triangulation, each once, next to one that is there already. The cell
// across an open facet is found by moving the sphere of the facet's one cell, through the facet, towards the
// other side: the first vertex that it meets is the apex. If most vertices are neighbors of each other, this
// is cheaper than insertion, which deletes most of the cells that it creates
// (docs/decisions/0007-small-sets-in-high-dimensions-are-wrapped.md).
//
// The search works with rounded numbers, so its result is a proposal; proof.hpp proves or refuses it.
#pragma once

#include "cells/open_cell.hpp"
#include "engine/cell_store.hpp"
#include "engine/wrap/facet_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_set>
#include <vector>

namespace delone::engine {

/// Finds what is beyond facets, with enough certainty for a proposal.
template <class S>
concept SearchBeyondFacets = requires(S search, Index* vertices, std::span<const OpenCell> cells,
                                      Index* apexes) {
  /// The k+1 vertices of a cell to start from. Returns whether one was found.
  { search.first_cell(vertices) } -> std::same_as<bool>;
  /// For up to S::batch_size cells, k+1 apexes each: across each open facet the vertex of the cell there that
  /// is not on the facet. Returns false to give up.
  { search.find_apexes(cells, apexes) } -> std::same_as<bool>;
};

/// Fills an empty store whose vertices are wide. The vertices of a cell are in ascending order, whatever its
/// orientation.
template <int K, SearchBeyondFacets S>
class Wrapping {
 public:
  /// Vertices are 1 … num_vertices and the infinite one.
  Wrapping(CellStore<K>& cells, S& search, Index num_vertices)
      : cells_(cells), search_(search), keys_(num_vertices + 1) {
    for (Index v = 0; v <= num_vertices; ++v) keys_[v] = mixed(v);
  }

  /// Returns whether every facet has two cells in the end. If not, or if it throws (memory, ids), the cells
  /// are meaningless. `tick` is called often with the fraction of facets
  /// that have two cells, and may throw.
  bool run(const std::function<void(double)>& tick) {
    NewCell first;
    if (!search_.first_cell(first.vertices.data())) return false;
    std::sort(first.vertices.begin(), first.vertices.end());
    find_keys(first);
    cells_.reserve_links(1);
    create(first);
    link(first);
    while (true) {
      tick(1 - static_cast<double>(facets_.size()) /
                   static_cast<double>(std::size_t{cells_.num_slots()} * (K + 1)));
      const std::size_t taken = take_cells();
      if (taken == 0) return facets_.size() == 0;
      if (!search_.find_apexes({batch_.data(), taken}, apexes_.data()) || !add_neighbors(taken)) return false;
    }
  }

 private:
  static constexpr std::size_t batch_size = S::batch_size;
  /// How many cells before their creation the lines of the table are prefetched.
  static constexpr std::size_t ahead = 8;
  /// How many cells after their creation they are linked.
  static constexpr std::size_t behind = 2;

  /// A cell to be created.
  struct NewCell {
    std::array<Index, K + 1> vertices;
    std::array<std::uint64_t, K + 1> facet_keys;
    std::uint64_t key;
    Index cell;
    std::array<std::uint32_t, K + 1>
        mirrors;  ///< for each facet, the same facet of another cell, or itself if it is open
  };
  /// Where it belongs.
  struct Place {
    Index beside;
    int slot;  ///< of the facet of `beside`
  };

  /// 64 pseudorandom bits (Steele, Lea, Flood, Fast splittable pseudorandom number generators, 2014,
  /// doi:10.1145/2714064.2660195).
  static std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9;
    x = (x ^ x >> 27) * 0x94d049bb133111eb;
    return x ^ x >> 31;
  }

  /// The key of a cell or facet is the sum of the keys of its vertices; that of a facet is never 0.
  void find_keys(NewCell& cell) const {
    cell.key = 0;
    for (const Index v : cell.vertices) cell.key += keys_[v];
    for (std::size_t i = 0; i <= K; ++i) {
      const std::uint64_t key = cell.key - keys_[cell.vertices[i]];
      cell.facet_keys[i] = key + (key == 0);
      facets_.prefetch(cell.facet_keys[i]);
    }
  }

  /// Describes the cell beyond a facet: the vertices of the facet and the apex, in ascending order.
  void describe(Place place, Index apex, NewCell& cell) const {
    const Index* const old = cells_.wide_vertices(place.beside);
    std::size_t before = 0;
    for (int i = 0; i < K; ++i) {
      const Index v = old[i + (i >= place.slot)];
      cell.vertices[static_cast<std::size_t>(i + (v > apex))] = v;
      before += v < apex;
    }
    cell.vertices[before] = apex;
    find_keys(cell);
  }

  /// Creates a cell, and finds the cells that have its facets already. Returns false if a sample of all cells
  /// shows that it is not new: after a wrong proposal wrapping may never end, finding the same cells again
  /// and again. REQUIRES reserved memory.
  bool create(NewCell& made) {
    made.cell = cells_.append();
    std::copy(made.vertices.begin(), made.vertices.end(), cells_.wide_vertices(made.cell));
    facets_.match(made.facet_keys, facet(made.cell, 0), made.mirrors.data());
    for (std::uint32_t i = 0; i <= K; ++i) {
      // Without a branch, as open facets are unpredictable: an open facet is linked with itself.
      const std::uint32_t open = 0u - static_cast<std::uint32_t>(made.mirrors[i] == FacetTable::none);
      made.mirrors[i] = (facet(made.cell, i) & open) | (made.mirrors[i] & ~open);
      __builtin_prefetch(cells_.neighbors(made.mirrors[i] / (K + 1)), 1);
    }
    return made.key % 256 != 0 || sample_.insert(made.key).second;
  }

  /// Links a created cell with the cells that have its facets.
  void link(const NewCell& made) {
    std::uint32_t num_open = 0;
    for (std::uint32_t i = 0; i <= K; ++i) {
      const Index neighbor = made.mirrors[i] / (K + 1);
      const bool is_open = neighbor == made.cell;
      const Index mask = Index{0} - static_cast<Index>(is_open);
      static_assert(invalid_index == ~Index{0});
      cells_.neighbors(made.cell)[i] = neighbor | mask;
      cells_.neighbors(neighbor)[made.mirrors[i] % (K + 1)] = made.cell | mask;
      num_open += is_open;
    }
    if (num_open != 0 && made.vertices[0] != index(infinite_vertex)) waiting_[num_open].push_back(made.cell);
  }

  static std::uint32_t facet(Index cell, std::uint32_t slot) {
    return static_cast<std::uint32_t>(cell) * (K + 1) + slot;
  }

  std::uint32_t open_slots(Index cell) const {
    std::uint32_t open = 0;
    for (int i = 0; i <= K; ++i) open |= std::uint32_t{cells_.neighbors(cell)[i] == invalid_index} << i;
    return open;
  }

  /// Fills the batch with cells that have open facets. Those that had fewest when they were created go first,
  /// so that dents are filled and few facets are open at a time.
  std::size_t take_cells() {
    std::size_t taken = 0;
    for (auto& waiting : waiting_)
      while (!waiting.empty() && taken < batch_size) {
        const Index cell = waiting.back();
        waiting.pop_back();
        if (waiting.size() > batch_size) cells_.prefetch_links(waiting[waiting.size() - batch_size]);
        const std::uint32_t open = open_slots(cell);
        taken_[taken] = cell;
        batch_[taken] = {cells_.wide_vertices(cell), open};
        taken += open != 0;  // unpredictable, so without a branch
      }
    return taken;
  }

  bool add_neighbors(std::size_t taken) {
    std::size_t count = 0;
    for (std::size_t b = 0; b < taken; ++b)
      for (std::uint32_t open = batch_[b].open_slots; open != 0; open &= open - 1) {
        const int slot = std::countr_zero(open);
        places_[count] = {taken_[b], slot};
        found_[count++] = apexes_[b * (K + 1) + static_cast<std::size_t>(slot)];
      }
    cells_.reserve_links(count);
    if (cells_.num_slots() + count > FacetTable::none / (K + 1)) return false;
    facets_.reserve(count * (K + 1));
    for (std::size_t i = 0; i < count + ahead + behind; ++i) {
      if (i < count) describe(places_[i], found_[i], new_cells_[i]);
      if (i + 1 >= ahead && i + 1 - ahead < count)
        for (const std::uint64_t key : new_cells_[i + 1 - ahead].facet_keys) facets_.prefetch_overflow(key);
      if (i >= ahead + behind) {
        if (const NewCell& made = new_cells_[i - ahead - behind]; made.cell != invalid_index) link(made);
      }
      if (i >= ahead && i - ahead < count) {
        const std::size_t c = i - ahead;
        // The neighbor may have been created in the same batch, or may be about to be.
        bool is_there = cells_.neighbors(places_[c].beside)[places_[c].slot] != invalid_index;
        for (std::size_t other = c - std::min(c, behind); other < c; ++other)
          is_there |= new_cells_[other].key == new_cells_[c].key;
        new_cells_[c].cell = invalid_index;
        if (!is_there && !create(new_cells_[c])) return false;
      }
    }
    return true;
  }

  CellStore<K>& cells_;
  S& search_;
  std::vector<std::uint64_t> keys_;                // of the vertices
  FacetTable facets_;                              // those with one cell: cell · (k + 1) + slot
  std::array<std::vector<Index>, K + 2> waiting_;  // finite cells, by how many open facets they had at first
  std::unordered_set<std::uint64_t> sample_;       // of keys of cells
  std::array<Index, batch_size> taken_;
  std::array<OpenCell, batch_size> batch_;
  std::array<Index, batch_size*(K + 1)> apexes_, found_;
  std::array<Place, batch_size*(K + 1)> places_;
  std::array<NewCell, batch_size*(K + 1)> new_cells_;
};

}  // namespace delone::engine
