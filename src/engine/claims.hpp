// SPDX-License-Identifier: BSD-3-Clause
// Which cells are whose, while several workers insert vertices at once. What a worker does not get at once it
// leaves alone: it gives up all that it holds and comes back later (parallel_insertion.hpp). So nobody ever
// waits, and there are no races.
//
// A worker reads the vertices and the functional of a cell only while it holds it. It reads its neighbors,
// and replaces it, only while nobody else holds it: then it *owns* the cell. In low dimensions all that is
// held is owned, which takes fewer steps. In high dimensions the survivors around a zone are many, and the
// zones of two workers may have survivors in common: each worker then writes the link across its own facet.
//
// Every worker has a byte of its own for each slot of a cell. To claim cells it sets its bytes, passes a
// fence, and reads the bytes of the others. Of two workers that claim one cell at least one sees the byte of
// the other, as both fences are in one order; then neither or one of them gets the cell. Stores and one fence
// for many cells are cheaper than a locked instruction for each.
//
// All stores to the bytes release, and the reads of others' bytes acquire: who holds a cell, or owns it,
// knows all that was written to it, or to its links, by those who held it before.
#pragma once

#include "base/atomic_ref.hpp"
#include "base/compiler.hpp"
#include "base/growable_array.hpp"
#include "cells/cell_memory.hpp"

#include <delone/types.hpp>

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace delone::engine {

using cells::Mark;

/// Thrown where another worker holds a cell that is needed.
struct Clash {};

/// What a worker has of a slot: nothing; the cell, until its insertion ends, with its mark; or the slot,
/// which is vacant, or has a cell of the star that the worker has made last. Cells in conflict are owned, or
/// will be before their neighbors are read.
namespace claim_bits {
inline constexpr std::uint8_t none = 0, held = 1, in_conflict = 2, not_in_conflict = 4, kept = 8, owned = 16;
}

/// The bytes of all workers: in the records of the cells if there is room for them, as their lines are in the
/// cache then when they are needed, or else in an array of their own.
class ClaimTable {
 public:
  static constexpr unsigned most_workers = 64;

  explicit ClaimTable(unsigned workers) : num_workers_(workers) {}

  unsigned num_workers() const { return num_workers_; }
  /// Makes room for all slots that the memory has room for. Throws std::bad_alloc. To be called when cells
  /// have moved. No worker may be at work.
  template <int K>
  void cover(cells::CellMemory<K>& memory) {
    const cells::CellLayout<K>& layout = memory.layout();
    // Triangles are so small that an array of bytes alone is in the cache.
    if (layout.dimension() > 2 && num_workers_ <= layout.num_spare_bytes()) {
      view_ = {reinterpret_cast<std::uint8_t*>(memory.links(0) + layout.num_link_ids()),
               layout.functional_stride() * sizeof(double), false};
    } else {
      const std::size_t stride = std::bit_ceil(num_workers_);
      bytes_.reserve(memory.capacity() * stride);
      view_ = {bytes_.data(), stride, true};
    }
  }
  /// Makes the slots first … last − 1, of which nobody else knows, those of a worker that keeps them.
  void keep(std::size_t first, std::size_t last, unsigned worker) {
    const View bytes = view_;
    for (std::size_t slot = first; slot < last; ++slot)
      for (unsigned w = 0; w < num_workers_; ++w)
        bytes.of(static_cast<Index>(slot), w)
            .store(w == worker ? claim_bits::kept : claim_bits::none, std::memory_order_relaxed);
  }
  /// The same for slots that nobody holds.
  void clear(std::size_t first, std::size_t last) { keep(first, last, num_workers_); }

  /// Access to the bytes, until cells move. By value, as the compiler must assume that writing a byte changes
  /// what a reference refers to.
  struct View {
    std::uint8_t* first;
    std::size_t stride;
    bool are_apart;  ///< from the records of cells
    internal::AtomicRef<std::uint8_t> of(Index cell, unsigned worker) const {
      return internal::AtomicRef<std::uint8_t>(first[cell * stride + worker]);
    }
  };
  View view() const { return view_; }

 private:
  unsigned num_workers_;
  View view_{nullptr, 0, true};
  internal::GrowableArray<std::uint8_t> bytes_{internal::Pages::large};
};

/// The claims of one worker, and its marks of cells that it holds.
class Claims {
 public:
  /// shares_survivors: whether cells are held that are not owned.
  Claims(ClaimTable& table, unsigned worker, bool shares_survivors)
      : table_(table),
        worker_(worker),
        hindrance_(shares_survivors ? claim_bits::in_conflict | claim_bits::kept | claim_bits::owned
                                    : 0xffu) {}
  bool shares_survivors() const { return hindrance_ != 0xffu; }

  /// What claims several cells in two steps.
  class Claiming {
   public:
    /// Notes a cell. Returns whether it is not marked as being in conflict.
    bool add(Index cell) {
      const auto own = bytes_.of(cell, worker_);
      const std::uint8_t present = own.load(std::memory_order_relaxed);
      *end_ = cell;
      end_ += present == claim_bits::none;
      own.store(present | claim_bits::held, std::memory_order_release);
      return (present & claim_bits::in_conflict) == 0;
    }

   private:
    friend Claims;
    ClaimTable::View bytes_;
    unsigned worker_;
    Index *begin_, *end_;
  };
  /// Begins to claim at most `most` cells, some of which may be held already. Throws std::bad_alloc.
  Claiming begin(std::size_t most) {
    if (num_held_ + most >= held_.capacity()) [[unlikely]]
      held_.reserve(2 * (num_held_ + most) + 64);
    Claiming claiming;
    claiming.bytes_ = table_.view();
    claiming.worker_ = worker_;
    claiming.begin_ = claiming.end_ = held_.data() + num_held_;
    return claiming;
  }
  /// Claims them. Throws Clash if another worker has one of them; they stay claimed until give_up() all the
  /// same. Returns whether there was a fence.
  bool end(const Claiming& claiming) {
    num_held_ = static_cast<std::size_t>(claiming.end_ - held_.data());
    if (claiming.end_ == claiming.begin_) return false;
    std::atomic_thread_fence(std::memory_order_seq_cst);
    unsigned others = 0;
    if (const unsigned workers = table_.num_workers(); workers == 2)
      for (const Index* cell = claiming.begin_; cell != claiming.end_; ++cell)
        others |= claiming.bytes_.of(*cell, 1 - claiming.worker_).load(std::memory_order_acquire);
    else
      for (const Index* cell = claiming.begin_; cell != claiming.end_; ++cell)
        others |= of_others(claiming.bytes_, *cell);
    if ((others & hindrance_) != 0) [[unlikely]]
      throw Clash();
    return true;
  }

  /// Makes sure that `count` cells that are held and are marked as being in conflict are owned. `is_fenced`:
  /// whether they were when cells were claimed last. Throws Clash.
  void own(const Index* cells, std::size_t count, bool is_fenced) {
    if (!shares_survivors()) return;
    if (!is_fenced) std::atomic_thread_fence(std::memory_order_seq_cst);
    const ClaimTable::View bytes = table_.view();
    unsigned others = 0;
    for (std::size_t i = 0; i < count; ++i) others |= of_others(bytes, cells[i]);
    if (others != 0) [[unlikely]]
      throw Clash();
  }
  /// The same for one cell that is held.
  void own(Index cell) {
    if (!shares_survivors()) return;
    const auto bits = table_.view().of(cell, worker_);
    if ((bits.load(std::memory_order_relaxed) & claim_bits::owned) != 0) return;
    bits.store(bits.load(std::memory_order_relaxed) | claim_bits::owned, std::memory_order_release);
    own(&cell, 1, false);
  }

  /// Prefetches the bytes of a cell, unless they are in its record.
  [[gnu::always_inline]] void prefetch(Index cell) const {
    const ClaimTable::View bytes = table_.view();
    if (bytes.are_apart) internal::prefetch_for_writing(bytes.first + cell * bytes.stride);
  }

  /// Claims one cell that others may have, or that is no cell any more. Returns whether it was got.
  bool try_claim(Index cell) {
    const ClaimTable::View bytes = table_.view();
    const auto own = bytes.of(cell, worker_);
    if (own.load(std::memory_order_relaxed) != claim_bits::none) return false;
    if (num_held_ + 1 >= held_.capacity()) held_.reserve(2 * num_held_ + 64);
    own.store(claim_bits::held | claim_bits::owned, std::memory_order_release);
    std::atomic_thread_fence(std::memory_order_seq_cst);
    if (of_others(bytes, cell) != 0) {
      own.store(claim_bits::none, std::memory_order_release);
      return false;
    }
    held_[num_held_++] = cell;
    return true;
  }
  /// Holds a cell that is kept. Throws std::bad_alloc.
  void hold_kept(Index cell) {
    if (num_held_ + 1 >= held_.capacity()) held_.reserve(2 * num_held_ + 64);
    table_.view().of(cell, worker_).store(claim_bits::held | claim_bits::owned, std::memory_order_release);
    held_[num_held_++] = cell;
  }

  /// The marks that find_conflict_zone() needs. They end with the claims.
  class Marks {
   public:
    Marks(ClaimTable::View bytes, unsigned worker) : bytes_(bytes), worker_(worker) {}
    Mark operator()(Index cell) const { return static_cast<Mark>(bits(cell) >> 1 & 3); }
    bool is_unseen(Index cell) const {
      return (bits(cell) & (claim_bits::in_conflict | claim_bits::not_in_conflict)) == 0;
    }
    bool is_in_conflict(Index cell) const { return (bits(cell) & claim_bits::in_conflict) != 0; }
    void set(Index cell, Mark mark) {
      constexpr int both = claim_bits::in_conflict | claim_bits::not_in_conflict;
      put(cell, static_cast<std::uint8_t>((bits(cell) & ~both) | static_cast<std::uint8_t>(mark) << 1));
    }
    void set_if(Index cell, bool conflict) {
      put(cell, static_cast<std::uint8_t>(bits(cell) | conflict << 1));
    }

   private:
    std::uint8_t bits(Index cell) const { return bytes_.of(cell, worker_).load(std::memory_order_relaxed); }
    void put(Index cell, std::uint8_t bits) {
      bytes_.of(cell, worker_).store(bits, std::memory_order_release);
    }
    ClaimTable::View bytes_;
    unsigned worker_;
  };
  Marks marks() const { return {table_.view(), worker_}; }

  /// Keeps a slot of which nobody else knows.
  void keep(Index cell) {
    table_.view().of(cell, worker_).store(claim_bits::kept, std::memory_order_relaxed);
  }
  /// Gives up cells that are kept, number i being cell_at(i), all but one.
  template <class CellAt>
  void release_kept(std::size_t count, CellAt cell_at, Index but) {
    const ClaimTable::View bytes = table_.view();
    const unsigned worker = worker_;
    for (std::size_t i = 0; i < count; ++i)
      if (cell_at(i) != but) bytes.of(cell_at(i), worker).store(claim_bits::none, std::memory_order_release);
  }
  /// Gives up all that is held.
  void give_up() {
    give_up([](std::uint8_t) { return claim_bits::none; });
  }
  /// The same but for cells that are marked as being in conflict: their slots are kept.
  void give_up_and_keep_zone() {
    give_up([](std::uint8_t bits) {
      constexpr int shift = std::countr_zero(claim_bits::kept) - std::countr_zero(claim_bits::in_conflict);
      return static_cast<std::uint8_t>((bits & claim_bits::in_conflict) << shift);
    });
  }

 private:
  template <class Rest>
  void give_up(Rest rest) {
    const ClaimTable::View bytes = table_.view();
    const unsigned worker = worker_;
    const Index* const held = held_.data();
    for (std::size_t i = 0, n = num_held_; i < n; ++i) {
      const auto own = bytes.of(held[i], worker);
      own.store(rest(own.load(std::memory_order_relaxed)), std::memory_order_release);
    }
    num_held_ = 0;
  }
  unsigned of_others(ClaimTable::View bytes, Index cell) const {
    unsigned others = 0;
    for (unsigned w = 0; w < table_.num_workers(); ++w)
      others |= w == worker_ ? 0u : bytes.of(cell, w).load(std::memory_order_acquire);
    return others;
  }

  ClaimTable& table_;
  unsigned worker_;
  unsigned hindrance_;  ///< what others may not have of a cell that is held
  internal::GrowableArray<Index> held_;
  std::size_t num_held_ = 0;
};

}  // namespace delone::engine
