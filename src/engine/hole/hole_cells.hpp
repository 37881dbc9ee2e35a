// SPDX-License-Identifier: BSD-3-Clause
// The cells that are found for a hole, each linked with those that have one of its facets already.
#pragma once

#include "base/random.hpp"
#include "base/stamped_table.hpp"
#include "engine/hole/hole.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace delone::engine {

/// Vertices are numbers of the hole. Facets have numbers, too: first those of the border, then those of the
/// cells, cell · (k + 1) + slot after them. Memory is kept from hole to hole.
template <int K>
class HoleCells {
 public:
  static constexpr std::uint32_t none = static_cast<std::uint32_t>(-1);

  explicit HoleCells(int dimension) : dimension_(dimension) {}

  /// Begins with no cell.
  void begin(const Hole<K>& hole) {
    const auto border = hole.border();
    num_cells_ = num_open_ = 0;
    first_facet_ = static_cast<std::uint32_t>(border.size());
    has_excess_ = false;
    beyond_border_.assign(border.size(), none);
    unmatched_.clear();
    while (keys_.size() <= hole.vertices().size() + 1)
      keys_.push_back(random::mix(0x9e3779b97f4a7c15u * (keys_.size() + 1)));
    facets_.clear((border.size() + hole.num_cells() * width()) / 2);
    for (std::uint32_t f = 0; f < border.size(); ++f)
      match(sum_of_keys(hole.numbers_of_cell(border[f].inner), border[f].slot), f);
  }

  /// Makes room for one more cell. Throws std::bad_alloc, or Error if there are too many.
  void reserve_one() {
    const std::size_t needed = num_cells_ + 1;
    if (is_odd_.size() >= needed) return;
    if (first_facet_ + 2 * needed * width() >= taken)
      throw Error(Errc::too_many, "a vertex has more cells than can be replaced at once");
    vertices_.resize(2 * needed * width());
    beside_.resize(2 * needed * width());
    is_odd_.resize(2 * needed);
  }
  /// How many cells there is room for.
  std::size_t capacity() const { return is_odd_.size(); }

  /// Adds a cell: that of `source`, but for the vertex in a slot. `is_odd`: it is oriented negatively.
  /// REQUIRES reserve_one().
  std::size_t add(const Index* source, int slot, Index apex, bool is_odd) {
    const std::size_t cell = num_cells_++;
    Index* const vertices = vertices_.data() + cell * width();
    std::copy_n(source, width(), vertices);
    vertices[slot] = apex;
    is_odd_[cell] = is_odd;
    return cell;
  }
  /// Links a cell with those that have its facets already, and notes the other facets of a finite one.
  void match_facets(std::size_t cell, bool is_finite) {
    const Index* const vertices = vertices_.data() + cell * width();
    const std::uint64_t key = sum_of_keys(vertices, -1);
    auto here = static_cast<std::uint32_t>(cell * width());
    for (std::size_t i = 0; i < width(); ++i, ++here) {
      const std::uint32_t other = match(key - keys_[vertices[i]], first_facet_ + here);
      if (other != none) {
        link(here, other);
        continue;
      }
      beside_[here] = none;
      if (is_finite) unmatched_.push_back(here);
    }
  }
  /// Links facet `here` of all cells with another cell's, or one of the border, given by its number.
  void link(std::uint32_t here, std::uint32_t other) {
    beside_[here] = other;
    set_beside(other, here);
  }
  /// Those that match_facets() has noted since begin() or the last clear_unmatched(). Some have been matched
  /// since.
  std::span<const std::uint32_t> unmatched() const { return unmatched_; }
  void clear_unmatched() { unmatched_.clear(); }

  std::size_t size() const { return num_cells_; }
  const Index* vertices(std::size_t cell) const { return vertices_.data() + cell * width(); }
  Index vertex_opposite(std::uint32_t facet) const { return vertices_[facet]; }
  bool is_odd(std::size_t cell) const { return is_odd_[cell] != 0; }
  /// The number of the first facet that is not one of the border.
  std::uint32_t first_facet() const { return first_facet_; }
  std::size_t num_facets() const { return num_cells_ * width(); }
  /// For facet `here` of all cells, the number of the same one of another cell or of the border.
  std::uint32_t beside(std::size_t here) const { return beside_[here]; }
  /// For a facet of the border, that of the cell in the hole, or none.
  std::uint32_t beyond_border(std::size_t facet) const { return beyond_border_[facet]; }
  std::size_t cell_of(std::uint32_t facet) const { return facet / width(); }

  /// Whether every facet has been matched with one other.
  bool are_all_matched() const { return num_open_ == 0 && !has_excess_; }
  /// Whether facets that have been matched are the same indeed, with cells on both sides.
  bool are_matches_right(const Hole<K>& hole) {
    sorted_.resize(num_cells_ + 1);
    for (std::size_t cell = 0; cell < num_cells_; ++cell)
      sorted_[cell].sort(vertices(cell), width(), is_odd(cell));
    Sorted& of_hole = sorted_.back();
    for (std::uint32_t here = 0; here < num_facets(); ++here) {
      const std::uint32_t other = beside_[here], there = other - first_facet_;
      const std::size_t cell = cell_of(here), slot = here - cell * width();
      if (other < first_facet_) {
        const auto& facet = hole.border()[other];
        of_hole.sort(hole.numbers_of_cell(facet.inner), width(), false);
        if (!sorted_[cell].has_facet(slot, of_hole, static_cast<std::size_t>(facet.slot), true)) return false;
      } else if (there < here) {
        const std::size_t neighbor = cell_of(there);
        if (!sorted_[cell].has_facet(slot, sorted_[neighbor], there - neighbor * width(), false))
          return false;
      }
    }
    return true;
  }
  /// Whether the cells have all vertices that stay: they do not where vertices have met.
  bool have_all_vertices(const Hole<K>& hole) {
    is_met_.assign(hole.vertices().size() + 1, 0);
    std::for_each_n(vertices_.data(), num_facets(), [&](Index number) { is_met_[number] = 1; });
    return std::find(is_met_.begin() + 1, is_met_.end(), 0) == is_met_.end();
  }

 private:
  /// Instead of the number of a facet that has been matched.
  static constexpr std::uint32_t taken = none - 1;

  std::size_t width() const { return static_cast<std::size_t>(K > 0 ? K : dimension_) + 1; }

  /// Of all vertices but the one in a slot; −1: of all.
  std::uint64_t sum_of_keys(const Index* vertices, int slot) const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < width(); ++i) sum += keys_[vertices[i]];
    return slot < 0 ? sum : sum - keys_[vertices[slot]];
  }
  std::uint32_t match(std::uint64_t key, std::uint32_t facet) {
    const auto [value, is_new] = facets_.insert(key, facet);
    if (is_new) {
      ++num_open_;
      return none;
    }
    if (value == taken) {
      has_excess_ = true;
      return none;
    }
    --num_open_;
    return std::exchange(value, taken);
  }
  void set_beside(std::uint32_t facet, std::uint32_t here) {
    if (facet < first_facet_)
      beyond_border_[facet] = here;
    else
      beside_[facet - first_facet_] = first_facet_ + here;
  }

  template <class T>
  using PerSlot = std::conditional_t<(K > 0), std::array<T, static_cast<std::size_t>(K) + 1>, std::vector<T>>;

  /// The vertices of a cell in the order of their numbers.
  struct Sorted {
    PerSlot<Index> numbers;
    PerSlot<std::uint32_t> ranks;  // of the vertices in the slots
    bool is_odd = false;           // oriented negatively in this order

    /// By counting, as branches would be unpredictable. REQUIRES different vertices.
    void sort(const Index* vertices, [[maybe_unused]] std::size_t width, bool odd) {
      if constexpr (K == 0) {
        numbers.resize(width);
        ranks.resize(width);
      }
      const std::size_t size = numbers.size();  // known at compile time with K
      std::uint32_t inversions = odd;
      for (std::size_t i = 0; i < size; ++i) {
        std::uint32_t before = 0, after = 0;
        for (std::size_t j = 0; j < i; ++j) before += vertices[j] < vertices[i];
        for (std::size_t j = i + 1; j < size; ++j) after += vertices[j] < vertices[i];
        inversions += after;
        ranks[i] = before + after;
      }
      for (std::size_t i = 0; i < size; ++i) numbers[ranks[i]] = vertices[i];
      is_odd = inversions % 2 != 0;
    }
    /// Whether another cell has the facet opposite the vertex in a slot, and is on the same side of it, or on
    /// the other one: then the two induce different orientations on the facet.
    bool has_facet(std::size_t slot, const Sorted& other, std::size_t other_slot, bool same_side) const {
      const std::size_t rank = ranks[slot], other_rank = other.ranks[other_slot];
      bool is_same = (is_odd != other.is_odd) != ((rank + other_rank) % 2 == (same_side ? 0 : 1));
      for (std::size_t i = 0; i + 1 < numbers.size(); ++i)
        is_same &= numbers[i + (i >= rank)] == other.numbers[i + (i >= other_rank)];
      return is_same;
    }
  };

  int dimension_;
  std::size_t num_cells_ = 0, num_open_ = 0;
  std::uint32_t first_facet_ = 0;
  bool has_excess_ = false;          // more than two cells have a facet
  std::vector<std::uint64_t> keys_;  // of vertices; that of a facet is the sum of theirs
  internal::StampedTable facets_;    // their numbers by key
  std::vector<Index> vertices_;      // k + 1 for each cell
  std::vector<std::uint32_t> beside_, beyond_border_, unmatched_;
  std::vector<std::uint8_t> is_odd_;
  std::vector<std::uint8_t> is_met_;
  std::vector<Sorted> sorted_;
};

}  // namespace delone::engine
