// SPDX-License-Identifier: BSD-3-Clause
// What makes a batch of insertions all-or-nothing: cells that existed before it are noted when they die.
//
// A note is the vertices and neighbors of the cell as they were just before: 8(k + 1) bytes and the cell's
// id. Undone in reverse order, every slot gets its cell back, and every cell its neighbors. For of two cells
// A and B that were neighbors before the batch, if any of them dies, let A be the first: then its note names
// B, and B is in its slot when A is put back, as it survives or has died, and so has been put back, after A
// did; there it is linked with A. What a note says of neighbors that the batch has made is written over when
// what was before in the slots of those, and died earlier, is put back.
//
// Which cells existed before the batch, a bit for each slot tells; of small batches, a table of the slots
// that these have changed, so that they cost nothing that grows with the number of cells.
#pragma once

#include "base/growable_array.hpp"
#include "base/stamped_table.hpp"
#include "cells/horizon_facet.hpp"
#include "engine/cell_store.hpp"
#include "engine/create_functionals.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::engine {

template <int K>
class UndoLog {
 public:
  bool is_on() const { return is_on_; }
  std::size_t bytes() const {
    return notes_.capacity() * sizeof(Index) + was_there_.capacity() * sizeof(std::uint64_t);
  }

  /// Begins to note. `is_small`: the batch changes few of the cells, and note_new() will be called. Throws
  /// std::bad_alloc, and then changes nothing.
  void begin(const CellStore<K>& cells, bool is_small = false) {
    if (!is_small) {
      was_there_.assign((std::size_t{cells.num_slots()} + 63) / 64, 0);
      for (Index cell = 0; cell < cells.num_slots(); ++cell)
        was_there_[cell / 64] |= std::uint64_t{!cells.is_vacant(cell)} << cell % 64;
    }
    changed_.clear();
    fresh_.clear();
    num_slots_ = cells.num_slots();
    num_notes_ = 0;
    is_small_ = is_small;
    is_on_ = true;
  }
  void end() noexcept {
    is_on_ = false;
    if (is_small_ && notes_.capacity() < most_kept) return;  // what there is serves the next small batch
    fresh_ = std::vector<Index>();
    notes_ = internal::GrowableArray<Index>();
    was_there_ = std::vector<std::uint64_t>();
  }

  /// Notes those of the cells that are about to die that were there in the beginning, if it is on. Throws
  /// std::bad_alloc, and then changes nothing. A cell that does not die after all is put back as it was.
  void note(const CellStore<K>& cells, std::span<const Index> dying) {
    if (!is_on_) return;
    const std::size_t size = size_of_note(cells), needed = (num_notes_ + dying.size()) * size;
    if (needed > notes_.capacity()) notes_.reserve(needed + needed / 2);
    if (is_small_) changed_.reserve(dying.size());
    for (const Index cell : dying) {
      if (!was_there(cell)) continue;
      if (is_small_)
        changed_.insert(cell, 1);
      else
        was_there_[cell / 64] &= ~(std::uint64_t{1} << cell % 64);
      Index* note = notes_.data() + size * num_notes_++;
      *note++ = cell;
      for (int i = 0; i <= cells.dimension(); ++i) *note++ = cells.vertex(cell, i);
      std::copy_n(cells.neighbors(cell), cells.dimension() + 1, note);
    }
  }

  /// Makes room for so many new cells, if they are noted. Throws std::bad_alloc.
  void reserve_new(std::size_t count) {
    if (!is_on_ || !is_small_) return;
    changed_.reserve(count);
    if (fresh_.capacity() < fresh_.size() + count) fresh_.reserve(2 * (fresh_.size() + count));
  }
  /// Notes cells that are new, some perhaps in the slots of others that have been noted. REQUIRES a
  /// reserve_new() that covers them.
  void note_new(std::span<const Index> cells) {
    if (!is_on_ || !is_small_) return;
    for (const Index cell : cells) note_new(cell);
  }
  void note_new(std::span<const HorizonFacet> star) {
    if (!is_on_ || !is_small_) return;
    for (const HorizonFacet& facet : star) note_new(facet.created);
  }

  /// Appends the ids of the cells that were there in the beginning and are not any more, and of those that
  /// are there and were not; in ascending order unless the batch is small.
  void list_changes(const CellStore<K>& cells, std::vector<CellId>& gone, std::vector<CellId>& made) const {
    if (is_small_)
      list_few_changes(cells, gone, made);
    else
      list_many_changes(cells, gone, made);
  }

  /// Appends those of the cells that are gone that were infinite, in no order.
  void list_infinite_changes(const CellStore<K>& cells, std::vector<CellId>& gone) const {
    for (std::size_t n = 0; n < num_notes_; ++n) {
      const Index *const note = notes_.data() + n * size_of_note(cells), *const vertices = note + 1;
      const Index* const end = vertices + cells.dimension() + 1;
      if (std::find(vertices, end, index(infinite_vertex)) != end && !is_there(cells, note))
        gone.push_back(CellId{note[0]});
    }
  }

  /// Makes the cells those that were there in the beginning, in their slots. In the end `put_back` is called
  /// with each that was noted.
  template <Geometry G, class PutBack>
  void undo(CellStore<K>& cells, G& geometry, PutBack&& put_back) noexcept {
    const std::size_t size = size_of_note(cells);
    for (std::size_t n = num_notes_; n-- > 0;) restore(cells, notes_.data() + n * size);
    if (is_small_)
      cells.restore_changed_slots(num_slots_, fresh_);
    else
      cells.restore_slots(num_slots_, [&](Index cell) { return was_there(cell); });
    for (std::size_t n = 0; n < num_notes_; ++n) {
      create_functional(cells, geometry, notes_[n * size]);
      put_back(notes_[n * size]);
    }
    end();
  }

 private:
  static constexpr std::size_t most_kept = std::size_t{1} << 20;

  void note_new(Index cell) {
    if (changed_.insert(cell, 0).second) fresh_.push_back(cell);
  }

  static std::size_t size_of_note(const CellStore<K>& cells) {
    return 1 + 2 * (static_cast<std::size_t>(cells.dimension()) + 1);
  }
  void list_few_changes(const CellStore<K>& cells, std::vector<CellId>& gone,
                        std::vector<CellId>& made) const {
    const auto add_made = [&](Index cell) {
      if (cell < cells.num_slots() && !cells.is_vacant(cell)) made.push_back(CellId{cell});
    };
    for (const Index cell : fresh_) add_made(cell);
    for (std::size_t n = 0; n < num_notes_; ++n) {
      const Index* const note = notes_.data() + n * size_of_note(cells);
      if (is_there(cells, note)) continue;
      gone.push_back(CellId{note[0]});
      add_made(note[0]);
    }
  }
  /// A bit for each slot sorts the ids.
  void list_many_changes(const CellStore<K>& cells, std::vector<CellId>& gone,
                         std::vector<CellId>& made) const {
    std::vector<std::uint64_t> are_gone((std::size_t{cells.num_slots()} + 63) / 64), are_old = was_there_;
    are_gone.resize(std::max(are_gone.size(), was_there_.size()));
    are_old.resize(are_gone.size());
    for (std::size_t n = 0; n < num_notes_; ++n) {
      const Index* const note = notes_.data() + n * size_of_note(cells);
      (is_there(cells, note) ? are_old : are_gone)[note[0] / 64] |= std::uint64_t{1} << note[0] % 64;
    }
    for (std::size_t word = 0; word < are_gone.size(); ++word)
      for (std::uint64_t bits = are_gone[word]; bits != 0; bits &= bits - 1)
        gone.push_back(CellId{static_cast<Index>(64 * word) + static_cast<Index>(std::countr_zero(bits))});
    for (Index cell = 0; cell < cells.num_slots(); ++cell)
      if ((are_old[cell / 64] >> cell % 64 & 1) == 0 && !cells.is_vacant(cell)) made.push_back(CellId{cell});
  }

  /// Whether the cell of a note is in its slot, with its vertices in their order.
  static bool is_there(const CellStore<K>& cells, const Index* note) {
    if (note[0] >= cells.num_slots()) return false;
    for (int i = 0; i <= cells.dimension(); ++i)
      if (cells.vertex(note[0], i) != note[1 + i]) return false;
    return true;
  }
  /// Whether it was, and has not been noted.
  bool was_there(Index cell) const {
    if (is_small_) return !changed_.contains(cell);
    return cell < num_slots_ && (was_there_[cell / 64] >> cell % 64 & 1) != 0;
  }

  void restore(CellStore<K>& cells, const Index* note) noexcept {
    const int k = cells.dimension();
    const Index cell = note[0];
    const Index *const vertices = note + 1, *const end = vertices + k + 1, *const neighbors = end;
    if (!is_small_) was_there_[cell / 64] |= std::uint64_t{1} << cell % 64;
    for (int i = 0; i <= k; ++i) cells.set_vertex(cell, i, vertices[i]);
    std::copy_n(neighbors, k + 1, cells.neighbors(cell));
    for (int i = 0; i <= k; ++i) {
      int slot = 0;  // of the neighbor's vertex that is not on the common facet
      while (slot < k && std::find(vertices, end, cells.vertex(neighbors[i], slot)) != end) ++slot;
      cells.neighbors(neighbors[i])[slot] = cell;
    }
  }

  bool is_on_ = false, is_small_ = false;
  Index num_slots_ = 0;
  std::size_t num_notes_ = 0;
  internal::GrowableArray<Index> notes_;  // id, vertices, neighbors
  std::vector<std::uint64_t> was_there_;  // a bit for each slot: a cell was there, and is there
  // Of a small batch: slots whose cells have been noted, and those of new cells that were vacant; the latter.
  internal::StampedTable changed_;
  std::vector<Index> fresh_;
};

}  // namespace delone::engine
