// SPDX-License-Identifier: BSD-3-Clause
// The cells of a triangulated sphere S^k in flat arrays: k+1 vertices and k+1 neighbors each, vacant slots in a free list.
// Neighbor i is across the facet opposite vertex i. Cells are coherently oriented.
#pragma once

#include "cell_memory.hpp"
#include "engine/link_kernel.hpp"

#include <delone/error.hpp>
#include <delone/types.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::engine {

/// K is the dimension of the cells, or 0 when it is chosen at run time.
template <int K>
class CellStore {
 public:
  explicit CellStore(CellMemory<K>& memory) : memory_(memory) {}

  int dimension() const { return memory_.dimension(); }
  /// From the vertices of a cell to those of the next, in ids.
  std::size_t stride() const { return memory_.layout().link_stride(); }

  const Index* vertices(Index cell) const { return memory_.links(cell); }
  Index* vertices(Index cell) { return memory_.links(cell); }
  const Index* neighbors(Index cell) const { return vertices(cell) + dimension() + 1; }
  Index* neighbors(Index cell) { return vertices(cell) + dimension() + 1; }

  /// The vertices and neighbors of all cells.
  CellLinks links() { return {vertices(0), dimension()}; }

  int slot_of_vertex(Index cell, Index vertex) const { return find(vertices(cell), vertex); }
  int slot_of_neighbor(Index cell, Index neighbor) const { return find(neighbors(cell), neighbor); }
  int infinite_slot(Index cell) const {  // without a branch that nothing foretells
    const Index* v = vertices(cell);
    int slot = -1;
    for (int i = 0; i <= dimension(); ++i) slot = v[i] == index(infinite_vertex) ? i : slot;
    return slot;
  }

  // Calls of functions that do nothing but prefetch are dropped by GCC as calls without effect, unless it inlines them early.

  /// Asks for the memory of a cell ahead of its use.
  [[gnu::always_inline]] void prefetch(Index cell) const {
    const CellLayout<K> layout = memory_.layout();
    const CellRecords<K> records = memory_.records();
    prefetch_bytes(records.functional(cell), layout.functional_stride() * sizeof(double));
    if (layout.certificates_are_apart()) __builtin_prefetch(records.certificate(cell));
    if (layout.links_are_apart()) prefetch_links(cell);
  }

  /// The same for all its neighbors.
  [[gnu::always_inline]] void prefetch_neighbors(Index cell) const {
    const Index* const across = neighbors(cell);
    for (int i = 0; i <= dimension(); ++i) prefetch(across[i]);
  }
  /// The same for the neighbor of an infinite cell across its hull facet.
  [[gnu::always_inline]] void prefetch_across_hull(Index cell) const { prefetch(neighbors(cell)[infinite_slot(cell)]); }
  /// The same for the vertices and neighbors of a cell alone.
  [[gnu::always_inline]] void prefetch_links(Index cell) const {
    prefetch_bytes(vertices(cell), 2 * (static_cast<std::size_t>(dimension()) + 1) * sizeof(Index));
  }

  /// Takes over which slots are vacant; their contents are the memory's.
  void copy_slots(const CellStore& other) {
    num_slots_ = other.num_slots_;
    num_vacant_ = other.num_vacant_;
    vacant_ = other.vacant_;
  }

  /// Removes all cells.
  void clear() {
    num_slots_ = 0;
    num_vacant_ = 0;
  }

  Index num_slots() const { return num_slots_; }
  Index num_cells() const { return num_slots_ - static_cast<Index>(num_vacant_); }
  bool is_vacant(Index cell) const { return vertices(cell)[0] == invalid_index; }
  std::size_t bytes() const { return memory_.bytes() + vacant_.capacity() * sizeof(Index); }

  /// Makes room for `count` more cells, so that as many calls of allocate() cannot fail. Throws
  /// Errc::too_many when the ids are exhausted.
  void reserve(std::size_t count) {
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
  /// Makes room for `count` more vacant slots, so that as many calls of release() cannot fail.
  void reserve_vacancies(std::size_t count) {
    if (vacant_.size() < num_vacant_ + count) vacant_.resize(2 * (num_vacant_ + count));
  }

  /// A vacant slot. REQUIRES a reserve() that covers it.
  Index allocate() {
    // Which of the two it is cannot be predicted: there is no branch.
    const bool vacant = num_vacant_ > 0;
    const Index mask = Index{0} - static_cast<Index>(vacant);
    const Index cell = (vacant_[num_vacant_ - vacant] & mask) | (num_slots_ & ~mask);
    num_vacant_ -= vacant;
    num_slots_ += !vacant;
    *memory_.records().certificate(cell) = 0;
    return cell;
  }
  /// A slot behind all others, of which only the links are expected to be written before the next reserve(). REQUIRES a
  /// reserve_links() that covers it, and no vacant slot.
  Index append() { return num_slots_++; }
  /// Makes a slot vacant. REQUIRES a reserve_vacancies() that covers it.
  void release(Index cell) {
    vertices(cell)[0] = invalid_index;
    vacant_[num_vacant_++] = cell;
  }

  /// The marks of all cells; valid until cells are allocated.
  class Marks {
   public:
    explicit Marks(CellMemory<K>& memory) : records_(memory.records()) {}
    Mark operator()(Index cell) const { return mark_bits::read(std::bit_cast<std::uint64_t>(word(cell))); }
    bool is_unseen(Index cell) const { return (std::bit_cast<std::uint64_t>(word(cell)) & mark_bits::all) == 0; }
    bool is_in_conflict(Index cell) const {
      return (std::bit_cast<std::uint64_t>(word(cell)) >> mark_bits::in_conflict & 1) != 0;
    }
    void set(Index cell, Mark mark) {
      word(cell) = std::bit_cast<double>((std::bit_cast<std::uint64_t>(word(cell)) & ~mark_bits::all) | mark_bits::write(mark));
    }
    /// Marks a cell that is in conflict, and leaves the mark of another as it is, without a branch.
    void set_if(Index cell, bool conflict) {
      word(cell) =
          std::bit_cast<double>(std::bit_cast<std::uint64_t>(word(cell)) | std::uint64_t{conflict} << mark_bits::in_conflict);
    }

   private:
    double& word(Index cell) const { return *records_.certificate(cell); }
    CellRecords<K> records_;
  };
  Marks marks() { return Marks(memory_); }
  Mark mark(Index cell) { return marks()(cell); }

 private:
  /// How many slots there will be with `count` more cells.
  std::size_t slots_for(std::size_t count) const {
    const std::size_t fresh = count > num_vacant_ ? count - num_vacant_ : 0;
    if (fresh > max_index - num_slots_) throw Error(Errc::too_many, "the triangulation has more cells than this build has ids");
    return num_slots_ + fresh;
  }
  /// For how many to make room where there is room for `present`.
  static std::size_t with_slack(std::size_t slots, std::size_t present) {
    return std::min<std::size_t>(std::max(slots, present + present / 2 + 64), max_index);
  }

  /// Not where they start at a line: lines that are asked for twice cost little, branches more.
  [[gnu::always_inline]] static void prefetch_bytes(const void* first, std::size_t bytes) {
    for (std::size_t byte = 0; byte < bytes; byte += 64) __builtin_prefetch(static_cast<const char*>(first) + byte);
    if (bytes % 64 != 0) __builtin_prefetch(static_cast<const char*>(first) + bytes - 1);
  }

  /// Which of the k+1 entries the value is, without a branch that depends on the data. REQUIRES that no two are.
  int find(const Index* entries, Index value) const {
    int found = 0;
    for (int i = 1; i <= dimension(); ++i) found |= i & -static_cast<int>(entries[i] == value);
    return found;
  }

  CellMemory<K>& memory_;
  Index num_slots_ = 0;
  std::size_t num_vacant_ = 0;
  std::vector<Index> vacant_{0};  // the first num_vacant_ entries; the others are unspecified
};

}  // namespace delone::engine
