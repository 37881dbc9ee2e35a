// SPDX-License-Identifier: BSD-3-Clause
// Gift wrapping: creates all cells of a triangulation, each once, next to one that is there already. The cell
// across an open facet is found by moving the sphere of the facet's one cell, through the facet, towards the
// other side: the first vertex that it meets is the apex. If most vertices are neighbors of each other, this
// is cheaper than insertion, which deletes most of the cells that it creates
// (docs/decisions/0007-small-sets-in-high-dimensions-are-wrapped.md).
//
// The search works with rounded numbers, so its result is a proposal; proof.hpp proves or refuses it.
#pragma once

#include "base/compiler.hpp"
#include "cells/open_cell.hpp"
#include "engine/cell_store.hpp"
#include "engine/wrap/facet_table.hpp"
#include "engine/wrap/pipeline.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <unordered_set>
#include <vector>

namespace delone::engine {

/// Finds what is beyond facets, with enough certainty for a proposal.
template <class S>
concept SearchBeyondFacets = requires(S search, Index* vertices, std::span<const cells::OpenCell> cells,
                                      Index* apexes, cells::ComparisonLimit& limit) {
  /// The k+1 vertices of a cell to start from. Returns whether one was found.
  { search.first_cell(vertices) } -> std::same_as<bool>;
  /// For up to S::batch_size cells, k+1 apexes each: across each open facet the vertex of the cell there that
  /// is not on the facet. Returns false to give up, also where the limit is exceeded.
  { search.find_apexes(cells, apexes, limit) } -> std::same_as<bool>;
};

/// One of several searches, where writing to it does not disturb the others.
template <SearchBeyondFacets S>
struct alignas(64) ForThread {
  S search;
};

/// Fills an empty store whose vertices are wide. The vertices of a cell are in ascending order, whatever its
/// orientation. The cells and their order do not depend on the number of threads: in blocks, open facets are
/// searched beyond by all of them, and the calling thread creates the cells (pipeline.hpp).
template <int K, SearchBeyondFacets S>
class Wrapping {
 public:
  /// Vertices are 1 … num_vertices and the infinite one. `searches`: equal ones, for a thread
  /// each.
  Wrapping(CellStore<K>& cells, std::span<ForThread<S>> searches, Index num_vertices)
      : cells_(cells), searches_(searches), keys_(num_vertices + 1) {
    for (Index v = 0; v <= num_vertices; ++v) keys_[v] = mixed(v);
  }

  /// Returns whether every facet has two cells in the end. If not, or if it throws (memory, ids), the cells
  /// are meaningless. `tick` is called often by this thread, with the fraction of facets that have two cells,
  /// and may throw.
  bool run(const std::function<void(double)>& tick) {
    NewCell first;
    if (!searches_[0].search.first_cell(first.vertices.data())) return false;
    std::sort(first.vertices.begin(), first.vertices.end());
    find_keys(first);
    cells_.reserve_links(1);
    create(first);
    link(first);
    Blocks blocks{*this, tick};
    return Pipeline<Blocks>(blocks).run(static_cast<unsigned>(searches_.size())) && facets_.size() == 0;
  }

 private:
  /// Cells whose facets are searched beyond at once, and batches of them in a block: enough of these to keep
  /// threads busy, and so few that their facets have hardly any cells in common.
  static constexpr std::size_t batch_size = S::batch_size, batches_in_block = 64;
  static constexpr std::size_t block_size = batch_size * batches_in_block;
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
  /// New cells that are waiting to be created or linked: a ring.
  static constexpr std::size_t ring_size = std::bit_ceil(ahead + behind + 1);

  /// Where a cell belongs: at a facet of the cell with a number in the block.
  struct Place {
    std::uint32_t beside, slot;
  };

  /// Cells with open facets, with copies of their vertices, as the store may move meanwhile; and what is
  /// beyond these facets.
  struct Block {
    std::size_t num_cells = 0, num_open = 0;
    std::array<Index, block_size> cells;
    std::array<cells::OpenCell, block_size> open;
    std::array<Index, block_size*(K + 1)> vertices, apexes;
    cells::ComparisonLimit comparisons;
  };
  struct Blocks {
    std::uint32_t prepare(unsigned block) { return wrapping.take_cells(wrapping.blocks_[block]); }
    bool do_part(unsigned block, std::uint32_t part, unsigned worker) {
      return wrapping.search(wrapping.blocks_[block], part, wrapping.searches_[worker].search);
    }
    bool finish(unsigned block) { return wrapping.add_neighbors(wrapping.blocks_[block]); }
    void tick() { on_tick(wrapping.fraction_.load(std::memory_order_relaxed)); }

    Wrapping& wrapping;
    const std::function<void(double)>& on_tick;
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
  void describe(const Block& block, Place place, NewCell& cell) const {
    const Index* const old = block.open[place.beside].vertices;
    const Index apex = block.apexes[place.beside * (K + 1) + place.slot];
    cells_.prefetch_links(block.cells[place.beside]);
    std::size_t before = 0;
    for (int i = 0; i < K; ++i) {
      const Index v = old[i + (i >= static_cast<int>(place.slot))];
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
      internal::prefetch_for_writing(cells_.neighbors(made.mirrors[i] / (K + 1)));
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

  /// Fills a block with cells that have open facets. Those that had fewest when they were created go first,
  /// so that dents are filled and few facets are open at a time. Returns the number of batches.
  std::uint32_t take_cells(Block& block) {
    std::size_t taken = 0;
    block.num_open = 0;
    for (auto& waiting : waiting_)
      while (!waiting.empty() && taken < block_size) {
        const Index cell = waiting.back();
        waiting.pop_back();
        if (waiting.size() > batch_size) cells_.prefetch_links(waiting[waiting.size() - batch_size]);
        const std::uint32_t open = open_slots(cell);
        Index* const vertices = block.vertices.data() + taken * (K + 1);
        std::copy_n(cells_.wide_vertices(cell), K + 1, vertices);
        block.cells[taken] = cell;
        block.open[taken] = {vertices, open};
        block.num_open += static_cast<std::size_t>(std::popcount(open));
        taken += open != 0;  // unpredictable, so without a branch
      }
    block.num_cells = taken;
    num_sought_ += block.num_open;
    // Where vertices are close to many spheres, insertion is as fast as wrapping.
    const std::size_t most = 1000 + num_sought_ / 4;
    block.comparisons.reset(most - std::min(num_compared_, most));
    return static_cast<std::uint32_t>((taken + batch_size - 1) / batch_size);
  }

  /// Searches beyond the facets of a batch.
  static bool search(Block& block, std::size_t batch, S& search) {
    const std::size_t first = batch * batch_size, count = std::min(batch_size, block.num_cells - first);
    return search.find_apexes({block.open.data() + first, count}, block.apexes.data() + first * (K + 1),
                              block.comparisons);
  }

  /// Creates the cells beyond the facets of a block.
  bool add_neighbors(const Block& block) {
    const std::size_t count = block.num_open;
    cells_.reserve_links(count);
    if (cells_.num_slots() + count > FacetTable::none / (K + 1)) return false;
    facets_.reserve(count * (K + 1));
    std::array<NewCell, ring_size> ring;
    std::array<Place, ring_size> places;
    const auto made = [&](std::size_t i) -> NewCell& { return ring[i % ring_size]; };
    Place next{0, 0};
    std::uint32_t open = block.open[0].open_slots;
    for (std::size_t i = 0; i < count + ahead + behind; ++i) {
      if (i < count) {
        while (open == 0) open = block.open[++next.beside].open_slots;
        next.slot = static_cast<std::uint32_t>(std::countr_zero(open));
        open &= open - 1;
        places[i % ring_size] = next;
        describe(block, next, made(i));
      }
      if (i + 1 >= ahead && i + 1 - ahead < count)
        for (const std::uint64_t key : made(i + 1 - ahead).facet_keys) facets_.prefetch_overflow(key);
      if (i >= ahead + behind && made(i - ahead - behind).cell != invalid_index)
        link(made(i - ahead - behind));
      if (i >= ahead && i - ahead < count) {
        const std::size_t c = i - ahead;
        const Place place = places[c % ring_size];
        // The neighbor may have been created since the block was filled, or may be about to be linked.
        bool is_there = cells_.neighbors(block.cells[place.beside])[place.slot] != invalid_index;
        for (std::size_t other = c - std::min(c, behind); other < c; ++other)
          is_there |= made(other).key == made(c).key;
        made(c).cell = invalid_index;
        if (!is_there && !create(made(c))) return false;
      }
    }
    num_compared_ += block.comparisons.count();
    fraction_.store(1 - static_cast<double>(facets_.size()) /
                            static_cast<double>(std::size_t{cells_.num_slots()} * (K + 1)),
                    std::memory_order_relaxed);
    return true;
  }

  CellStore<K>& cells_;
  std::span<ForThread<S>> searches_;
  std::vector<std::uint64_t> keys_;                // of the vertices
  FacetTable facets_;                              // those with one cell: cell · (k + 1) + slot
  std::array<std::vector<Index>, K + 2> waiting_;  // finite cells, by how many open facets they had at first
  std::unordered_set<std::uint64_t> sample_;       // of keys of cells
  std::size_t num_sought_ = 0, num_compared_ = 0;  // facets, and vertices that had to be compared exactly
  std::atomic<double> fraction_ = 0;
  std::unique_ptr<Block[]> blocks_ = std::make_unique<Block[]>(2);
};

}  // namespace delone::engine
