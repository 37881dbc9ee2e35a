// SPDX-License-Identifier: BSD-3-Clause
// The cells of a triangulated sphere S^k in flat arrays: k+1 vertices and k+1 neighbors each, vacant slots in a free list.
// Neighbor i is across the facet opposite vertex i. Cells are coherently oriented.
#pragma once

#include "growable_array.hpp"

#include <delone/error.hpp>
#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::engine {

/// What an insertion has found out about a cell.
enum class Mark : std::uint8_t { unseen, in_conflict, not_in_conflict };

/// K is the dimension of the cells, or 0 when it is chosen at run time.
template <int K>
class CellStore {
 public:
  explicit CellStore(int dimension) : dimension_(dimension) {}

  int dimension() const { return K > 0 ? K : dimension_; }
  std::size_t stride() const { return 2 * (static_cast<std::size_t>(dimension()) + 1); }

  const Index* vertices(Index cell) const { return links_.data() + cell * stride(); }
  Index* vertices(Index cell) { return links_.data() + cell * stride(); }
  const Index* neighbors(Index cell) const { return vertices(cell) + dimension() + 1; }
  Index* neighbors(Index cell) { return vertices(cell) + dimension() + 1; }

  int slot_of_vertex(Index cell, Index vertex) const { return find(vertices(cell), vertex); }
  int slot_of_neighbor(Index cell, Index neighbor) const { return find(neighbors(cell), neighbor); }
  int infinite_slot(Index cell) const {
    const Index* v = vertices(cell);
    for (int i = 0; i <= dimension(); ++i)
      if (v[i] == index(infinite_vertex)) return i;
    return -1;
  }

  /// Asks for the memory of a cell ahead of its use.
  void prefetch(Index cell) const {
    const Index* links = vertices(cell);
    __builtin_prefetch(links);
    __builtin_prefetch(links + stride() - 1);
  }

  /// The same if `wanted`, without a branch: otherwise for a cell that is at hand anyway.
  void prefetch_if(Index cell, bool wanted) const { prefetch(wanted ? cell : Index{0}); }

  Index num_slots() const { return num_slots_; }
  Index num_cells() const { return num_slots_ - static_cast<Index>(vacant_.size()); }
  bool is_vacant(Index cell) const { return vertices(cell)[0] == invalid_index; }
  std::size_t bytes() const {
    return links_.capacity() * sizeof(Index) + marks_.capacity() + vacant_.capacity() * sizeof(Index);
  }

  /// Makes room for `count` more cells, so that as many calls of allocate() cannot fail. Returns the number of slots there
  /// will be at most. Throws Errc::too_many when the ids are exhausted.
  std::size_t reserve(std::size_t count) {
    const std::size_t fresh = count > vacant_.size() ? count - vacant_.size() : 0;
    if (fresh > max_index - num_slots_) throw Error(Errc::too_many, "the triangulation has more cells than this build has ids");
    const std::size_t slots = num_slots_ + fresh;
    if (slots > capacity_) {
      const std::size_t grown = std::min<std::size_t>(std::max(slots, capacity_ + capacity_ / 2 + 64), max_index);
      links_.reserve(grown * stride());
      marks_.resize(grown, Mark::unseen);
      capacity_ = grown;
    }
    return capacity_;
  }

  /// Makes room for `count` more vacant slots, so that as many calls of release() cannot fail.
  void reserve_vacancies(std::size_t count) {
    if (vacant_.capacity() < vacant_.size() + count) vacant_.reserve(2 * (vacant_.size() + count));
  }

  /// A vacant slot. REQUIRES a reserve() that covers it.
  Index allocate() {
    if (vacant_.empty()) return num_slots_++;
    const Index cell = vacant_.back();
    vacant_.pop_back();
    return cell;
  }
  void release(Index cell) {
    vertices(cell)[0] = invalid_index;
    vacant_.push_back(cell);
  }

  Mark mark(Index cell) const { return marks_[cell]; }
  void set_mark(Index cell, Mark mark) { marks_[cell] = mark; }
  /// The marks of all cells; valid until cells are allocated.
  class Marks {
   public:
    explicit Marks(Mark* marks) : marks_(marks) {}
    Mark operator()(Index cell) const { return marks_[cell]; }
    void set(Index cell, Mark mark) { marks_[cell] = mark; }
    /// Marks a cell that is in conflict, and leaves the mark of another as it is, without a branch.
    void set_if(Index cell, bool conflict) {
      marks_[cell] = static_cast<Mark>(static_cast<unsigned>(marks_[cell]) | static_cast<unsigned>(conflict));
    }

   private:
    Mark* marks_;
  };
  Marks marks() { return Marks(marks_.data()); }

 private:
  /// Which of the k+1 entries the value is, without a branch that depends on the data.
  int find(const Index* entries, Index value) const {
    int found = 0;
    for (int i = 1; i <= dimension(); ++i) found = entries[i] == value ? i : found;
    return found;
  }

  int dimension_;
  Index num_slots_ = 0;
  std::size_t capacity_ = 0;
  GrowableArray<Index> links_;
  std::vector<Mark> marks_;
  std::vector<Index> vacant_;
};

}  // namespace delone::engine
