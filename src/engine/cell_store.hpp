// SPDX-License-Identifier: BSD-3-Clause
// The cells of a triangulated sphere S^k in flat arrays: k+1 vertices and k+1 neighbors each, vacant slots in
// a free list. Neighbor i is across the facet opposite vertex i. Cells are coherently oriented.
#pragma once

#include "base/compiler.hpp"
#include "cells/cell_memory.hpp"
#include "engine/link_kernel.hpp"

#include <delone/complex.hpp>
#include <delone/error.hpp>
#include <delone/types.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace delone::engine {

using cells::CellLayout;
using cells::CellMemory;
using cells::Mark;

/// Where the store of a worker gets slots from (parallel_insertion.hpp).
class SlotSource {
 public:
  /// Slots first … last − 1, vacant, and at least as many as that. Throws, and then changes nothing.
  virtual std::pair<Index, Index> take(std::size_t least) = 0;

 protected:
  ~SlotSource() = default;
};

/// K is the dimension of the cells, or 0 when it is chosen at run time.
template <int K>
class CellStore {
 public:
  explicit CellStore(CellMemory<K>& memory) : memory_(memory) {}
  /// The store of one of several workers on the same memory. It knows the vacant slots of its own alone.
  CellStore(CellMemory<K>& memory, SlotSource& source) : memory_(memory), source_(&source) {}

  int dimension() const { return memory_.dimension(); }
  const CellLayout<K>& layout() const { return memory_.layout(); }

  /// Allows vertices up to `last` to be written from now on. Throws std::bad_alloc, and then changes nothing.
  void admit_vertices(Index last) {
    if (last > cells::last_narrow_vertex && memory_.layout().is_narrow()) [[unlikely]]
      widen_vertices();
  }
  /// Makes vertices wide, so that they can be used in place. Throws as above.
  void widen_vertices() { memory_.widen(num_slots_); }

  Index vertex(Index cell, int i) const { return memory_.layout().vertex(memory_.links(cell), i); }
  /// REQUIRES an admitted vertex.
  void set_vertex(Index cell, int i, Index vertex) {
    memory_.layout().set_vertex(memory_.links(cell), i, vertex);
  }
  cells::CellVertices<K> vertices(Index cell) const {
    if constexpr (cells::may_be_narrow(K))
      return cells::CellVertices<K>([layout = memory_.layout(), links = memory_.links(cell)](int i) {
        return layout.vertex(links, i);
      });
    else
      return memory_.links(cell);
  }
  /// The same, in place or copied to `room`, which has k+1 entries.
  const Index* vertices(Index cell, [[maybe_unused]] Index* room) const {
    if constexpr (cells::may_be_narrow(K)) {
      for (int i = 0; i <= K; ++i) room[i] = vertex(cell, i);
      return room;
    } else {
      return memory_.links(cell);
    }
  }
  /// The vertices of a cell, in place. REQUIRES that they are wide.
  const Index* wide_vertices(Index cell) const { return memory_.links(cell); }
  Index* wide_vertices(Index cell) { return memory_.links(cell); }
  const Index* neighbors(Index cell) const {
    return memory_.links(cell) + memory_.layout().ids_before_neighbors();
  }
  Index* neighbors(Index cell) { return memory_.links(cell) + memory_.layout().ids_before_neighbors(); }

  /// The vertices and neighbors of all cells.
  CellLinks links() { return {memory_.links(0), dimension(), memory_.layout().vertex_ids()}; }
  Complex::Links links_of_complex() const {
    const CellLayout<K>& layout = memory_.layout();
    return {memory_.links(0), layout.link_stride(), layout.is_narrow()};
  }

  /// The slot of a vertex, or neighbor, of a cell. REQUIRES that it is not in two slots.
  int slot_of_vertex(Index cell, Index vertex) const {
    return find([&](int i) { return this->vertex(cell, i) == vertex; });
  }
  int slot_of_neighbor(Index cell, Index neighbor) const {
    return find([all = neighbors(cell), neighbor](int i) { return all[i] == neighbor; });
  }
  int infinite_slot(Index cell) const {  // without an unpredictable branch
    const Index* const links = memory_.links(cell);
    const CellLayout<K> layout = memory_.layout();
    int slot = -1;
    for (int i = 0; i <= dimension(); ++i)
      slot = layout.vertex(links, i) == index(infinite_vertex) ? i : slot;
    return slot;
  }

  // GCC drops calls of functions that only prefetch, as having no effect, unless it inlines them early.

  /// Prefetches a cell.
  [[gnu::always_inline]] void prefetch(Index cell) const {
    const CellLayout<K> layout = memory_.layout();
    const cells::CellRecords<K> records = memory_.records();
    prefetch_bytes(records.functional(cell), layout.functional_stride() * sizeof(double));
    if (layout.certificates_are_apart()) internal::prefetch(records.certificate(cell));
    if (layout.links_are_apart()) prefetch_links(cell);
  }

  /// The same for all its neighbors.
  [[gnu::always_inline]] void prefetch_neighbors(Index cell) const {
    const Index* const across = neighbors(cell);
    for (int i = 0; i <= dimension(); ++i) prefetch(across[i]);
  }
  /// Prefetches the marks and links of all neighbors of a cell, without their functionals.
  [[gnu::always_inline]] void prefetch_around(Index cell) const {
    const CellLayout<K> layout = memory_.layout();
    const cells::CellRecords<K> records = memory_.records();
    const Index* const across = neighbors(cell);
    for (int i = 0; i <= dimension(); ++i) {
      const double* const mark = records.certificate(across[i]);
      if (layout.certificates_are_apart() || layout.links_are_apart()) {
        internal::prefetch(mark);
        prefetch_links(across[i]);
      } else {
        prefetch_bytes(mark, sizeof(double) + layout.num_link_ids() * sizeof(Index));
      }
    }
  }
  /// Prefetches the neighbor of an infinite cell across its hull facet.
  [[gnu::always_inline]] void prefetch_across_hull(Index cell) const {
    prefetch(neighbors(cell)[infinite_slot(cell)]);
  }
  /// The same for the vertices and neighbors of a cell alone.
  [[gnu::always_inline]] void prefetch_links(Index cell) const {
    prefetch_bytes(memory_.links(cell), memory_.layout().num_link_ids() * sizeof(Index));
  }

  /// Takes over the list of vacant slots; the contents of slots are the memory's.
  void copy_slots(const CellStore& other) {
    num_slots_ = other.num_slots_;
    num_vacant_ = other.num_vacant_;
    vacant_ = other.vacant_;
  }

  /// Says which slots before `num_slots`, no more than there are, are cells; the others become vacant. No
  /// fewer may have been vacant at any time.
  template <class IsCell>
  void restore_slots(Index num_slots, IsCell is_cell) noexcept {
    num_slots_ = num_slots;
    num_vacant_ = 0;
    for (Index cell = 0; cell < num_slots; ++cell)
      if (!is_cell(cell)) release(cell);
    shrink();
  }
  /// The same where few slots have changed. `fresh`: all that were vacant at that time and have had a cell
  /// since. Slots that had a cell then have it again. Cost O(vacant + fresh).
  void restore_changed_slots(Index num_slots, std::span<const Index> fresh) noexcept {
    const auto first = vacant_.begin();
    const auto last = std::remove_if(first, first + static_cast<std::ptrdiff_t>(num_vacant_),
                                     [&](Index cell) { return cell >= num_slots || !is_vacant(cell); });
    num_vacant_ = static_cast<std::size_t>(last - first);
    for (const Index cell : fresh)
      if (cell < num_slots && !is_vacant(cell)) release(cell);
    num_slots_ = num_slots;
  }
  /// Gives back the memory of slots and vacancies that are not there any more, but for as many as a growth
  /// would add to those that are.
  void shrink() noexcept {
    memory_.shrink(with_slack(num_slots_, num_slots_));
    const std::size_t vacancies = 2 * num_vacant_ + 4096;
    if (vacant_.size() <= vacancies) return;
    try {
      std::vector<Index> fewer(vacancies);
      std::copy_n(vacant_.begin(), num_vacant_, fewer.begin());
      vacant_ = std::move(fewer);
    } catch (const std::bad_alloc&) {  // all stay
    }
  }

  /// Takes over the vacant slots of another store on the same memory, in which there are `num_slots` in all.
  /// REQUIRES a reserve_vacancies() that covers them.
  void take_vacant(CellStore& other, Index num_slots) noexcept {
    std::copy_n(other.vacant_.begin(), other.num_vacant_,
                vacant_.begin() + static_cast<std::ptrdiff_t>(num_vacant_));
    num_vacant_ += other.num_vacant_;
    other.num_vacant_ = 0;
    num_slots_ = num_slots;
  }
  /// After the cells have been moved to the first slots.
  void close_gaps() noexcept {
    num_slots_ = num_cells();
    num_vacant_ = 0;
  }
  std::size_t num_vacant() const { return num_vacant_; }
  /// The vacant slots.
  std::span<const Index> vacant() const { return {vacant_.data(), num_vacant_}; }

  /// Removes all cells.
  void clear() {
    num_slots_ = 0;
    num_vacant_ = 0;
  }

  Index num_slots() const { return num_slots_; }
  Index num_cells() const { return num_slots_ - static_cast<Index>(num_vacant_); }
  bool is_vacant(Index cell) const { return vertex(cell, 0) == memory_.layout().vacant(); }
  std::size_t bytes() const { return memory_.bytes() + vacant_.capacity() * sizeof(Index); }

  /// Makes room for `count` more cells, so that as many calls of allocate() cannot fail. Throws
  /// Errc::too_many when the ids are exhausted.
  void reserve(std::size_t count) {
    if (source_ != nullptr) return take_slots(count);
    const std::size_t slots = slots_for(count);
    if (slots > memory_.capacity()) memory_.reserve(with_slack(slots, memory_.capacity()));
    memory_.prepare(slots);
  }
  /// The same for append().
  void reserve_links(std::size_t count) {
    const std::size_t slots = slots_for(count);
    if (slots > memory_.link_capacity()) memory_.reserve_links(with_slack(slots, memory_.link_capacity()));
    memory_.prepare_links(slots);
  }
  /// The first of `count` slots after those of `more` new cells. They hold drafts of cells, which are written
  /// and computed as cells are, until one is allocated that is not among these. Throws as above.
  Index reserve_drafts(std::size_t count, std::size_t more) {
    const std::size_t first = slots_for(more), last = first + count;
    if (last > max_index)
      throw Error(Errc::too_many, "the triangulation has more cells than this build has ids");
    if (last > memory_.capacity()) memory_.reserve(with_slack(last, memory_.capacity()));
    memory_.prepare(last);
    return static_cast<Index>(first);
  }
  /// Writes a draft to a slot. `neighbor`: what to put in place of the ids of neighbors. The cell has no
  /// mark.
  template <class Neighbor>
  void adopt_draft(Index draft, Index cell, Neighbor&& neighbor) {
    const CellLayout<K> layout = memory_.layout();
    const cells::CellRecords<K> records = memory_.records();
    std::copy_n(records.functional(draft), layout.num_coefficients(), records.functional(cell));
    *records.certificate(cell) = *records.certificate(draft);
    const Index* const from = memory_.links(draft);
    Index* const to = memory_.links(cell);
    const std::size_t before = layout.ids_before_neighbors();
    std::copy_n(from, layout.num_coefficients(), to);  // narrow vertices take fewer, neighbors follow
    for (std::size_t i = 0; i < layout.num_coefficients(); ++i) to[before + i] = neighbor(from[before + i]);
  }
  /// Makes room for `count` more vacant slots, so that as many calls of release() cannot fail.
  void reserve_vacancies(std::size_t count) {
    if (vacant_.size() < num_vacant_ + count) vacant_.resize(2 * (num_vacant_ + count));
  }

  /// A vacant slot. REQUIRES a reserve() that covers it.
  Index allocate() {
    // Without a branch, as the case is unpredictable.
    const bool vacant = num_vacant_ > 0;
    const Index mask = Index{0} - static_cast<Index>(vacant);
    const Index cell = (vacant_[num_vacant_ - vacant] & mask) | (num_slots_ & ~mask);
    num_vacant_ -= vacant;
    num_slots_ += !vacant;
    *memory_.records().certificate(cell) = 0;
    return cell;
  }
  /// A slot after all others. Only its links may be written before the next reserve().
  /// REQUIRES a reserve_links() that covers it, and no vacant slot.
  Index append() { return num_slots_++; }
  /// Makes a slot vacant. REQUIRES a reserve_vacancies() that covers it.
  void release(Index cell) {
    set_vertex(cell, 0, memory_.layout().vacant());
    vacant_[num_vacant_++] = cell;
  }

  /// The marks of all cells; valid until cells are allocated.
  class Marks {
   public:
    explicit Marks(CellMemory<K>& memory) : records_(memory.records()) {}
    Mark operator()(Index cell) const {
      return cells::mark_bits::read(std::bit_cast<std::uint64_t>(word(cell)));
    }
    bool is_unseen(Index cell) const {
      return (std::bit_cast<std::uint64_t>(word(cell)) & cells::mark_bits::all) == 0;
    }
    bool is_in_conflict(Index cell) const {
      return (std::bit_cast<std::uint64_t>(word(cell)) >> cells::mark_bits::in_conflict & 1) != 0;
    }
    void set(Index cell, Mark mark) {
      word(cell) = std::bit_cast<double>((std::bit_cast<std::uint64_t>(word(cell)) & ~cells::mark_bits::all) |
                                         cells::mark_bits::write(mark));
    }
    /// Marks a cell that is in conflict, and leaves the mark of another as it is, without a branch.
    void set_if(Index cell, bool conflict) {
      word(cell) = std::bit_cast<double>(std::bit_cast<std::uint64_t>(word(cell)) |
                                         std::uint64_t{conflict} << cells::mark_bits::in_conflict);
    }

   private:
    double& word(Index cell) const { return *records_.certificate(cell); }
    cells::CellRecords<K> records_;
  };
  Marks marks() { return Marks(memory_); }
  Mark mark(Index cell) { return marks()(cell); }

 private:
  /// Makes sure that there are so many vacant slots.
  void take_slots(std::size_t count) {
    if (count <= num_vacant_) return;
    reserve_vacancies(count + 4096);
    const auto [first, last] = source_->take(count - num_vacant_);
    reserve_vacancies(last - first);
    for (Index cell = last; cell-- > first;) release(cell);
  }
  /// How many slots there will be with `count` more cells.
  std::size_t slots_for(std::size_t count) const {
    const std::size_t fresh = count > num_vacant_ ? count - num_vacant_ : 0;
    if (fresh > max_index - num_slots_)
      throw Error(Errc::too_many, "the triangulation has more cells than this build has ids");
    return num_slots_ + fresh;
  }
  /// How many to make room for, if there is room for `present`.
  static std::size_t with_slack(std::size_t slots, std::size_t present) {
    return std::min<std::size_t>(std::max(slots, present + present / 2 + 64), max_index);
  }

  /// From any start, not that of a line: a line that is prefetched twice costs less than a branch.
  [[gnu::always_inline]] static void prefetch_bytes(const void* first, std::size_t bytes) {
    for (std::size_t byte = 0; byte < bytes; byte += 64)
      internal::prefetch(static_cast<const char*>(first) + byte);
    if (bytes % 64 != 0) internal::prefetch(static_cast<const char*>(first) + bytes - 1);
  }

  /// Without branches that depend on data.
  template <class IsAt>
  int find(IsAt is_at) const {
    int found = 0;
    for (int i = 1; i <= dimension(); ++i) found |= i & -static_cast<int>(is_at(i));
    return found;
  }

  CellMemory<K>& memory_;
  SlotSource* source_ = nullptr;
  Index num_slots_ = 0;
  std::size_t num_vacant_ = 0;
  std::vector<Index> vacant_{0};  // the first num_vacant_ entries; the others are unspecified
};

}  // namespace delone::engine
