// SPDX-License-Identifier: BSD-3-Clause
// The cells that are found for a hole, each linked with those that have one of its facets already.
#pragma once

#include "base/compiler.hpp"
#include "base/random.hpp"
#include "engine/hole/facet_keys.hpp"
#include "engine/hole/hole.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <array>
#include <bit>
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
    hole_ = &hole;
    num_cells_ = num_entries_ = num_open_ = 0;
    first_facet_ = static_cast<std::uint32_t>(border.size());
    has_excess_ = is_wrong_ = false;
    reserve_facets(2 * border.size());
    std::fill_n(beside_.begin(), border.size(), none);
    set_keys(hole.vertices().size());
    // As many cells as have gone have so many facets.
    clear_table((border.size() + hole.num_cells() * width()) / 2);
    for (std::uint32_t f = 0; f < border.size(); ++f) {
      write_record_of_border(f);
      match(f);
    }
  }
  /// From the next begin() on, other keys tell facets apart, unless the present ones do so for certain.
  void renew_keys() {
    if (telling_ == Telling::by_keys) return;
    keys_.clear();
    second_keys_.clear();
    seed_ = random::mix(seed_);
  }

  /// Makes room for so many more cells. Throws std::bad_alloc, or Error if there are too many.
  void reserve(std::size_t count) {
    const std::size_t needed = num_cells_ + count;
    if (is_odd_.size() < needed || beside_.size() < first_facet_ + needed * width()) {
      if (first_facet_ + 2 * needed * width() >= none)
        throw Error(Errc::too_many, "a vertex has more cells than can be replaced at once");
      reserve_facets(first_facet_ + 2 * needed * width());
      if (is_odd_.size() < needed) {
        vertices_.resize(2 * needed * width());
        orientations_.resize(2 * needed);
        is_odd_.resize(2 * needed);
      }
    }
    const std::size_t entries = 2 * (num_entries_ + count * width());
    if (entries > mask_ + 1) [[unlikely]]
      grow_table(std::bit_ceil(2 * entries));
  }

  /// Adds the cell beyond facet `across` of a cell, or on the inner side of one of the border. `source`: the
  /// vertices of that cell, or of the one in the hole at the border, whose slot opposite the facet gets the
  /// apex. Links it with the cells that have its other facets already.
  /// REQUIRES reserve(), and an apex that is not on the facet.
  std::size_t add(const Index* source, int slot, Index apex, std::uint32_t across) {
    const std::size_t cell = num_cells_++;
    Index* const vertices = vertices_.data() + cell * width();
    std::copy_n(source, width(), vertices);
    vertices[slot] = apex;
    const auto first = static_cast<std::uint32_t>(first_facet_ + cell * width());
    std::fill_n(beside_.begin() + first, width(), none);
    if (is_of_border(across)) {
      is_odd_[cell] = 0;
      orientations_[cell] = orientations_of(vertices);
    } else {
      const std::size_t from = cell_of(across);
      is_odd_[cell] = is_odd_[from] ^ 1;
      orientations_[cell] = orientations_beyond(orientations_[from], vertices, slot, source[slot]);
    }
    write_records(vertices, orientations_[cell], records_.data() + first);
    for (std::uint32_t i = 0; i < width(); ++i) internal::prefetch(&table_[place(records_[first + i])]);
    for (std::uint32_t i = 0; i < width(); ++i) {
      if (i == static_cast<std::uint32_t>(slot)) continue;
      const std::uint32_t other = match(first + i);
      if (other != none) link(first + i, other);
    }
    if (beside_[across] == none)
      --num_open_;
    else
      has_excess_ = true;
    link(first + static_cast<std::uint32_t>(slot), across);
    return cell;
  }
  /// Says that two facets are the same.
  void link(std::uint32_t facet, std::uint32_t other) {
    beside_[facet] = other;
    beside_[other] = facet;
  }

  /// Writes the slots of a cell opposite which there is no other one yet, and returns how many they are.
  std::size_t find_open(std::size_t cell, int* slots) const {
    const std::uint32_t* const beside = beside_.data() + first_facet_ + cell * width();
    std::size_t count = 0;
    for (std::size_t i = 0; i < width(); ++i) {
      slots[count] = static_cast<int>(i);
      count += beside[i] == none;
    }
    return count;
  }

  std::size_t size() const { return num_cells_; }
  const Index* vertices(std::size_t cell) const { return vertices_.data() + cell * width(); }
  /// The vertex opposite a facet that is not of the border.
  Index vertex_opposite(std::uint32_t facet) const { return vertices_[facet - first_facet_]; }
  /// Whether a cell is oriented negatively.
  bool is_odd(std::size_t cell) const { return is_odd_[cell] != 0; }
  std::size_t num_facets() const { return num_cells_ * width(); }
  /// The number of facet `here` of all cells.
  std::uint32_t facet(std::size_t here) const { return first_facet_ + static_cast<std::uint32_t>(here); }
  /// For a facet, that of another cell, or of the border, which is the same; none if there is none yet.
  std::uint32_t beside(std::uint32_t facet) const { return beside_[facet]; }
  /// The same for the k + 1 facets of a cell.
  const std::uint32_t* beside_of_cell(std::size_t cell) const {
    return beside_.data() + first_facet_ + cell * width();
  }
  bool is_of_border(std::uint32_t facet) const { return facet < first_facet_; }
  /// The cell of a facet that is not of the border.
  std::size_t cell_of(std::uint32_t facet) const { return (facet - first_facet_) / width(); }

  /// Whether more than two cells have a facet.
  bool has_excess() const { return has_excess_; }
  /// Whether every facet has been matched with one other.
  bool are_all_matched() const { return num_open_ == 0 && !has_excess_; }
  /// Whether facets that have been matched are the same indeed, with cells on both sides.
  bool are_matches_right() {
    return telling_ == Telling::by_sorting
               ? are_facets_the_same()
               : !is_wrong_ && (telling_ == Telling::by_keys || are_second_sums_right());
  }
  /// The same, of facets that have been linked in any way. Cost O(k²) per cell.
  bool are_facets_the_same() {
    sorted_.resize(num_cells_ + 1);
    for (std::size_t cell = 0; cell < num_cells_; ++cell)
      sorted_[cell].sort(vertices(cell), width(), is_odd(cell));
    Sorted& of_hole = sorted_.back();
    for (std::uint32_t here = 0; here < num_facets(); ++here) {
      const std::uint32_t other = beside_[first_facet_ + here], there = other - first_facet_;
      if (other == none) continue;
      const std::size_t cell = here / width(), slot = here - cell * width();
      if (other < first_facet_) {
        const auto& facet = hole_->border()[other];
        of_hole.sort(hole_->numbers_of_cell(facet.inner), width(), false);
        if (!sorted_[cell].has_facet(slot, of_hole, static_cast<std::size_t>(facet.slot), true)) return false;
      } else if (there < here) {
        const std::size_t neighbor = there / width();
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
  std::size_t width() const { return static_cast<std::size_t>(K > 0 ? K : dimension_) + 1; }

  void reserve_facets(std::size_t count) {
    if (beside_.size() >= count) return;
    records_.resize(count);
    beside_.resize(count);  // last, so that it tells what there is room for
  }

  // A facet has a record: the sum of the keys of its vertices, and in the lowest bit, which is clear in keys,
  // the orientation that its cell induces on them in the order of their numbers; of the border, that of the
  // survivor. It differs between the two sides.
  //
  // Where one word tells facets apart (FacetKeys), a key is that word times an odd factor, which is
  // invertible modulo 2^63: so the upper bits of a sum depend on all digits, and are its hash. Where it takes
  // two words, a key is a combination of both with odd factors. If in the end the sums of the second words
  // are the same as well, so are those of the first. Beyond that, keys are random, and are_facets_the_same()
  // tells whether they told facets apart.

  enum class Telling : std::uint8_t { by_keys, by_two_keys, by_sorting };

  static Telling telling_for(std::size_t last) {
    if constexpr (K > 0) {
      if (last < FacetKeys<K>::prime(1)) return Telling::by_keys;
      if (last < FacetKeys<K>::prime(2)) return Telling::by_two_keys;
    }
    return Telling::by_sorting;
  }
  /// For numbers up to `last`.
  void set_keys(std::size_t last) {
    const Telling telling = telling_for(last);
    if (telling != telling_) {
      telling_ = telling;
      keys_.clear();
      second_keys_.clear();
    }
    if (keys_.size() > last) return;
    keys_.reserve(last + 1);
    if (telling == Telling::by_two_keys) second_keys_.reserve(last + 1);
    while (keys_.size() <= last) add_key(keys_.size());
  }
  void add_key(std::uint64_t number) {
    constexpr std::uint64_t factor = 0x9e3779b97f4a7c15u;
    if constexpr (K > 0) {
      if (telling_ == Telling::by_keys) return keys_.push_back(2 * factor * FacetKeys<K>::word(number, 1, 0));
      if (telling_ == Telling::by_two_keys) {
        second_keys_.push_back(FacetKeys<K>::word(number, 2, 1));
        return keys_.push_back(2 * factor * FacetKeys<K>::word(number, 2, 0) +
                               2 * (seed_ | 1) * second_keys_.back());
      }
    }
    keys_.push_back(2 * random::mix(seed_ * (number + 1)));
  }

  /// The orientation that an even cell induces on the facet opposite a slot.
  std::uint32_t orientation_of_facet(const Index* numbers, int slot) const {
    if constexpr (K == 0) return 0;  // unused
    auto inversions = static_cast<std::uint32_t>(slot);
    for (int i = 1; i <= K; ++i)
      for (int j = 0; j < i; ++j)
        inversions += static_cast<std::uint32_t>(numbers[j] > numbers[i]) & (j != slot) & (i != slot);
    return inversions & 1;
  }
  /// The same of all facets, a bit for each.
  std::uint32_t orientations_of(const Index* numbers) const {
    std::uint32_t all = 0;
    for (int i = 0; i <= K; ++i) all |= orientation_of_facet(numbers, i) << i;
    return all;
  }
  /// Of a cell, given those of its neighbor that has another vertex in one slot. An inversion comes or goes
  /// with every vertex between the two in the order of numbers.
  static std::uint32_t orientations_beyond(std::uint32_t of_neighbor, const Index* numbers, int slot,
                                           Index other) {
    if constexpr (K == 0) return 0;
    const Index low = std::min(numbers[slot], other) + 1, distance = std::max(numbers[slot], other) - low;
    std::uint32_t between = 0;
    for (int i = 0; i <= K; ++i) between |= static_cast<std::uint32_t>(numbers[i] - low < distance) << i;
    const std::uint32_t is_odd = static_cast<std::uint32_t>(std::popcount(between)) & 1;
    return of_neighbor ^ between ^ is_odd << slot ^ (is_odd - 1);
  }

  void write_record_of_border(std::uint32_t f) {
    const auto& facet = hole_->border()[f];
    const Index* const numbers = hole_->numbers_of_cell(facet.inner);
    records_[f] = sum_of_keys(keys_, numbers, facet.slot) | (orientation_of_facet(numbers, facet.slot) ^ 1);
  }
  /// Of the facets of a cell.
  void write_records(const Index* vertices, std::uint32_t orientations, std::uint64_t* records) const {
    const std::uint64_t sum = sum_of_keys(keys_, vertices, -1);
    for (std::size_t i = 0; i < width(); ++i)
      records[i] = (sum - keys_[vertices[i]]) | (K > 0 ? orientations >> i & 1 : 0);
  }
  /// Of all vertices but the one in a slot; −1: of all.
  std::uint64_t sum_of_keys(const std::vector<std::uint64_t>& keys, const Index* vertices, int slot) const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < width(); ++i)
      if (static_cast<int>(i) != slot) sum += keys[vertices[i]];
    return sum;
  }
  bool are_second_sums_right() {
    second_sums_.resize(num_facets());
    for (std::size_t cell = 0; cell < num_cells_; ++cell) {
      const Index* const numbers = vertices(cell);
      const std::uint64_t sum = sum_of_keys(second_keys_, numbers, -1);
      for (std::size_t i = 0; i < width(); ++i)
        second_sums_[cell * width() + i] = sum - second_keys_[numbers[i]];
    }
    for (std::uint32_t here = 0; here < num_facets(); ++here) {
      const std::uint32_t other = beside_[first_facet_ + here];
      if (other == none) continue;
      std::uint64_t sum = 0;
      if (is_of_border(other)) {
        const auto& facet = hole_->border()[other];
        sum = sum_of_keys(second_keys_, hole_->numbers_of_cell(facet.inner), facet.slot);
      } else {
        sum = second_sums_[other - first_facet_];
      }
      if (second_sums_[here] != sum) return false;
    }
    return true;
  }

  // An entry of the table has the number of a facet, plus 1, and above it bits of its record.

  std::size_t place(std::uint64_t record) const { return static_cast<std::size_t>(record >> shift_); }
  static std::uint64_t tag(std::uint64_t record) { return record >> 20 << 32; }

  void set_table_size(std::size_t size) {
    mask_ = size - 1;
    shift_ = 64 - (std::bit_width(size) - 1);
  }
  void clear_table(std::size_t expected) {
    const std::size_t size = std::bit_ceil(2 * expected + 64);
    if (table_.size() < size) table_.resize(size);
    set_table_size(size);
    std::fill_n(table_.begin(), size, 0);
  }
  void grow_table(std::size_t size) {
    std::vector<std::uint64_t> larger(size);
    const std::size_t old_size = mask_ + 1;
    set_table_size(size);
    for (const std::uint64_t entry : std::span(table_).first(old_size)) {
      if (entry == 0) continue;
      std::size_t at = place(records_[static_cast<std::uint32_t>(entry) - 1]);
      while (larger[at] != 0) at = (at + 1) & mask_;
      larger[at] = entry;
    }
    table_.swap(larger);
  }
  /// Returns the facet that is the same and has no other one yet; if there is none, keeps this one.
  std::uint32_t match(std::uint32_t facet) {
    const std::uint64_t record = records_[facet];
    std::size_t at = place(record);
    for (; table_[at] != 0; at = (at + 1) & mask_) {
      if ((table_[at] ^ tag(record)) >> 32 != 0) continue;
      const std::uint32_t other = static_cast<std::uint32_t>(table_[at]) - 1;
      const std::uint64_t difference = record ^ records_[other];
      if (difference > 1) continue;
      if (beside_[other] != none) {
        has_excess_ = true;
        return none;
      }
      is_wrong_ |= difference == 0;
      --num_open_;
      return other;
    }
    table_[at] = tag(record) | (facet + 1);
    ++num_entries_;
    ++num_open_;
    return none;
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
  const Hole<K>* hole_ = nullptr;
  std::size_t num_cells_ = 0, num_entries_ = 0, num_open_ = 0, mask_ = 0;
  std::uint32_t first_facet_ = 0;
  bool has_excess_ = false;  // more than two cells have a facet
  Telling telling_ = Telling::by_sorting;
  int shift_ = 0;          // from a record to a place in the table
  bool is_wrong_ = false;  // if so, two cells are on one side of their common facet
  std::uint64_t seed_ = 0xd1b54a32d192ed03u;
  std::vector<std::uint64_t> keys_, second_keys_;     // of vertices
  std::vector<std::uint64_t> records_, second_sums_;  // of facets
  std::vector<std::uint64_t> table_;                  // the first mask_ + 1 entries
  std::vector<Index> vertices_;                       // k + 1 for each cell
  std::vector<std::uint32_t> beside_;
  std::vector<std::uint32_t> orientations_;  // that a cell induces on its facets, a bit for each
  std::vector<std::uint8_t> is_odd_;
  std::vector<std::uint8_t> is_met_;
  std::vector<Sorted> sorted_;
};

}  // namespace delone::engine
