// SPDX-License-Identifier: BSD-3-Clause
// Cells in an order that depends on their vertices alone: by their newest vertex, which is the one of the
// greatest id, and those of one newest vertex by a hash of all. The vertices of each cell are increasing, but
// for the last two where the orientation wants it so.
//
// Where ids are not in the order of insertion, places in it can be given instead of them; they need not be
// without gaps.
//
// The cells of one newest vertex were created by one insertion, and those of the next by an insertion nearby.
// So cells come from few places of memory, each of which is read from its beginning to its end, and nearly
// all neighbors have numbers that are in the cache.
#pragma once

#include "base/atomic_ref.hpp"
#include "base/growable_array.hpp"
#include "base/parallel.hpp"
#include "base/progress_meter.hpp"
#include "base/quick_rounds.hpp"
#include "cells/cell_memory.hpp"
#include "cells/move_cells.hpp"
#include "engine/cell_store.hpp"
#include "engine/vertex_order.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace delone::engine {

using internal::GrowableArray;

/// K is the dimension of the cells; two cells of one newest vertex have the same hash with a probability of
/// 2^−HashBits.
template <int K, int HashBits = 32>
class CellSorter {
  static_assert(K >= 2 && HashBits <= 32);

 public:
  CellSorter(CellMemory<K>& memory, CellStore<K>& cells, const VertexOrder& order, unsigned threads)
      : memory_(memory),
        cells_(cells),
        threads_(threads),
        places_(order.places),
        ranks_(order.has_gaps ? order.size : 0),
        end_(std::size_t{order.size} + 1) {}

  /// Throws std::bad_alloc and Errc::cancelled, and then nothing has changed: there are cancellation points
  /// until the first cell is written.
  void run() {
    if (!ranks_.empty()) find_ranks();
    find_keys();
    distribute();
    number_cells();
    cells::CellMover<K> mover(memory_, {entries_.data(), cells_.num_cells()}, cells_.vacant(), threads_);
    rewrite_links();
    mover.run();
    cells_.close_gaps();
  }

 private:
  static constexpr std::size_t part = 8192, few = 48;
  static std::uint64_t pair(std::uint64_t upper, Index lower) { return upper << 32 | lower; }
  static std::uint64_t upper(std::uint64_t pair) { return pair >> 32; }
  /// Newest vertex, or invalid_index for a vacant slot, and hash.
  Index* key(Index slot) { return of_slots_.data() + 2 * std::size_t{slot}; }

  template <class T>
  static GrowableArray<T> array_of(std::size_t size) {
    GrowableArray<T> array;
    array.reserve(size);
    array.prepare(size);
    return array;
  }

  /// Where a vertex is among all.
  Index rank(Index v) const {
    const Index place = places_.empty() ? v : places_[v];
    return ranks_.empty() ? place : ranks_[place];
  }
  /// The number of vertices before each place.
  void find_ranks() {
    internal::QuickRounds round;
    for (Index cell = 0; cell < cells_.num_slots(); ++cell) {
      round();
      if (cells_.is_vacant(cell)) continue;
      for (int i = 0; i <= K; ++i) {
        const Index v = cells_.vertex(cell, i);
        ranks_[places_.empty() ? v : places_[v]] = 1;
      }
    }
    std::exclusive_scan(ranks_.begin(), ranks_.end(), ranks_.begin(), Index{0});
  }

  /// A key for each slot, and how many cells each vertex is the newest of.
  void find_keys() {
    const Index num_slots = cells_.num_slots();
    of_slots_ = array_of<Index>(2 * std::size_t{num_slots});
    internal::parallel_for(threads_, num_slots, part, [&](std::size_t first, std::size_t last) {
      internal::cancellation_point();
      for (auto cell = static_cast<Index>(first); cell < last; ++cell) {
        if (cells_.is_vacant(cell)) {
          key(cell)[0] = invalid_index;
          continue;
        }
        Index newest = 0;
        std::uint64_t sum = 0;
        for (int i = 0; i <= K; ++i) {
          const Index number = rank(cells_.vertex(cell, i));
          const std::uint64_t product = (std::uint64_t{number} + 1) * 0x9e3779b97f4a7c15u;
          newest = std::max(newest, number);
          sum += product ^ product >> 29;
        }
        key(cell)[0] = newest;
        key(cell)[1] = static_cast<Index>(sum * 0xd6e8feb86659fd93u >> (64 - HashBits));
        add(end_[newest], 1);
      }
    });
  }

  /// An entry for each cell, in its place but for the order of those of one newest vertex: hash and slot.
  void distribute() {
    Index before = 0;
    for (Index& place : end_) place = std::exchange(before, before + place);
    entries_ = array_of<std::uint64_t>(cells_.num_cells());
    internal::parallel_for(threads_, cells_.num_slots(), part, [&](std::size_t first, std::size_t last) {
      internal::cancellation_point();
      for (auto cell = static_cast<Index>(first); cell < last; ++cell)
        if (const Index newest = key(cell)[0]; newest != invalid_index)
          entries_[add(end_[newest], 1)] = pair(key(cell)[1], cell);
    });
  }

  /// Returns what was there before. No two threads meet often.
  Index add(Index& number, Index more) const {
    if (threads_ > 1) return internal::AtomicRef<Index>(number).fetch_add(more, std::memory_order_relaxed);
    return std::exchange(number, number + more);
  }

  /// Sorts the cells of each newest vertex, and notes the numbers of all in place of keys. Entries are slots
  /// alone from then on.
  void number_cells() {
    internal::parallel_for(threads_, end_.size() - 1, part, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        internal::cancellation_point();
        const std::size_t begin = v > 0 ? end_[v - 1] : 0, end = end_[v];
        sort({entries_.data() + begin, end - begin});
        for (std::size_t n = begin; n < end; ++n) {
          entries_[n] &= cells::CellMover<K>::slot_mask;
          of_slots_[entries_[n]] = static_cast<Index>(n);
        }
      }
    });
  }

  void sort(std::span<std::uint64_t> entries) const {
    if (entries.size() > few) {
      std::sort(entries.begin(), entries.end());
    } else {
      // Each goes where as many are before it as are less: there are no branches that depend on data.
      std::uint64_t unsorted[few];
      std::copy(entries.begin(), entries.end(), unsorted);
      for (std::size_t i = 0; i < entries.size(); ++i) {
        std::size_t num_less = 0;
        for (std::size_t j = 0; j < entries.size(); ++j) num_less += unsorted[j] < unsorted[i];
        entries[num_less] = unsorted[i];
      }
    }
    for (std::size_t i = 1; i < entries.size(); ++i)
      if (upper(entries[i - 1]) == upper(entries[i])) [[unlikely]]
        return sort_by_vertices(entries);
  }
  void sort_by_vertices(std::span<std::uint64_t> entries) const {
    std::sort(entries.begin(), entries.end(), [this](std::uint64_t a, std::uint64_t b) {
      if (upper(a) != upper(b)) return a < b;
      return sorted_vertices(static_cast<Index>(a)) < sorted_vertices(static_cast<Index>(b));
    });
  }
  std::array<Index, K + 1> sorted_vertices(Index cell) const {
    std::array<Index, K + 1> vertices;
    for (int i = 0; i <= K; ++i) vertices[static_cast<std::size_t>(i)] = cells_.vertex(cell, i);
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  }

  /// Vertices in their order, and neighbors, which go with them, by their numbers.
  void rewrite_links() {
    internal::parallel_for(threads_, cells_.num_slots(), part, [&](std::size_t first, std::size_t last) {
      for (auto cell = static_cast<Index>(first); cell < last; ++cell)
        if (!cells_.is_vacant(cell)) rewrite_links(memory_.links(cell));
    });
  }
  /// Without branches that depend on data.
  void rewrite_links(Index* links) const {
    const CellLayout<K> layout = memory_.layout();
    Index* const neighbors = links + layout.ids_before_neighbors();
    std::uint64_t all[K + 1];
    for (int i = 0; i <= K; ++i) all[i] = pair(layout.vertex(links, i), of_slots_[neighbors[i]]);
    std::uint64_t odd = 0;  // all bits are set where the number of exchanges is odd
    const auto exchange_if = [&](std::uint64_t mask, int i, int j) {
      const std::uint64_t difference = (all[i] ^ all[j]) & mask;
      all[i] ^= difference;
      all[j] ^= difference;
      odd ^= mask;
    };
    for (int i = 1; i <= K; ++i)
      for (int j = i; j > 0; --j)
        exchange_if(std::uint64_t{0} - static_cast<std::uint64_t>(all[j] < all[j - 1]), j - 1, j);
    exchange_if(odd, K - 1, K);
    for (int i = 0; i <= K; ++i) {
      layout.set_vertex(links, i, static_cast<Index>(upper(all[i])));
      neighbors[i] = static_cast<Index>(all[i]);
    }
  }

  CellMemory<K>& memory_;
  CellStore<K>& cells_;
  unsigned threads_;
  std::span<const Index> places_;  // by vertex; none if they are the ids
  std::vector<Index> ranks_;       // by place; none if they are the places
  /// By rank of a vertex: how many cells it is the newest of; then where the next of them goes, and at last
  /// where they end.
  std::vector<Index> end_;
  GrowableArray<Index> of_slots_;  // two for each, its key; then one, the number of its cell
  GrowableArray<std::uint64_t> entries_;
};

/// Sorts all cells; there are no vacant slots then. Throws std::bad_alloc and Errc::cancelled, and then
/// changes nothing. Cost O(k²) per cell, and for a moment some 20 bytes for each.
template <int K>
void sort_cells(CellMemory<K>& memory, CellStore<K>& cells, const VertexOrder& order, unsigned threads) {
  CellSorter<K>(memory, cells, order, threads).run();
}

}  // namespace delone::engine
