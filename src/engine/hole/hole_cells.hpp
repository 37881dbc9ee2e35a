// SPDX-License-Identifier: BSD-3-Clause
// The cells that are found for a hole, each linked with those that have one of its facets already.
#pragma once

#include "base/compiler.hpp"
#include "base/random.hpp"
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
    is_packed_ = can_pack && hole.vertices().size() + 1 < (std::uint64_t{1} << (field_bits - 1));
    reserve_facets(2 * border.size());
    std::fill_n(beside_.begin(), border.size(), none);
    if (!is_packed_)
      while (keys_.size() <= hole.vertices().size()) keys_.push_back(random::mix(seed_ * (keys_.size() + 1)));
    // As many cells as have gone have so many facets.
    clear_table((border.size() + hole.num_cells() * width()) / 2);
    for (std::uint32_t f = 0; f < border.size(); ++f) {
      write_record(f, hole.numbers_of_cell(border[f].inner), border[f].slot);
      match(f);
    }
  }
  /// Other keys tell facets apart from the next begin() on.
  void renew_keys() {
    keys_.clear();
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
    is_odd_[cell] = !is_of_border(across) && !is_odd(cell_of(across));
    const auto first = static_cast<std::uint32_t>(first_facet_ + cell * width());
    std::fill_n(beside_.begin() + first, width(), none);
    write_records(vertices, slot, records_[across], records_.data() + first);
    for (std::uint32_t i = 0; i < width(); ++i) internal::prefetch(&table_[place(hash(first + i))]);
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
  Index vertex_opposite(std::size_t here) const { return vertices_[here]; }
  /// Whether a cell is oriented negatively.
  bool is_odd(std::size_t cell) const { return is_odd_[cell] != 0; }
  std::size_t num_facets() const { return num_cells_ * width(); }
  /// The number of facet `here` of all cells.
  std::uint32_t facet(std::size_t here) const { return first_facet_ + static_cast<std::uint32_t>(here); }
  /// For a facet, that of another cell, or of the border, which is the same; none if there is none yet.
  std::uint32_t beside(std::uint32_t facet) const { return beside_[facet]; }
  bool is_of_border(std::uint32_t facet) const { return facet < first_facet_; }
  /// The cell of a facet that is not of the border.
  std::size_t cell_of(std::uint32_t facet) const { return (facet - first_facet_) / width(); }

  /// Whether more than two cells have a facet.
  bool has_excess() const { return has_excess_; }
  /// Whether every facet has been matched with one other.
  bool are_all_matched() const { return num_open_ == 0 && !has_excess_; }
  /// Whether facets that have been matched are the same indeed, with cells on both sides.
  bool are_matches_right() { return is_packed_ ? !is_wrong_ : are_facets_the_same(); }
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

  // A facet has a record. Its upper bit is the orientation that the cell induces on the facet, if its
  // vertices are in the order of their numbers; of the border, that of the survivor. It differs between the
  // two sides. The other bits are the numbers of the vertices in this order, in fields of which one bit is
  // spare. Where numbers are too large for that, there is a sum of random keys instead, and
  // are_facets_the_same() tells afterwards whether facets were told apart.

  static constexpr bool can_pack = K >= 1 && K <= 7;
  static constexpr int field_bits = can_pack ? std::min(63 / K, 32) : 1;
  static constexpr std::uint64_t orientation_bit = std::uint64_t{1} << 63;
  static constexpr std::uint64_t all_fields = (std::uint64_t{1} << (K * field_bits)) - 1;
  /// One in every field.
  static constexpr std::uint64_t ones = [] {
    std::uint64_t word = 0;
    for (int i = 0; i < K; ++i) word |= std::uint64_t{1} << (i * field_bits);
    return word;
  }();
  /// How many fields are at most x.
  static unsigned num_up_to(std::uint64_t packed, Index x) {
    constexpr std::uint64_t spare = ones << (field_bits - 1);
    const std::uint64_t is_up_to = (((ones * x) | spare) - packed) & spare;
    // The sum of all fields is in the last one of the product.
    return static_cast<unsigned>((is_up_to >> (field_bits - 1)) * ones >> ((K - 1) * field_bits)) &
           ((1u << 4) - 1);
  }
  static std::uint64_t before(unsigned field) { return (std::uint64_t{1} << (field * field_bits)) - 1; }
  static std::uint64_t without_field(std::uint64_t packed, unsigned field) {
    return (packed & before(field)) | (packed >> field_bits & ~before(field));
  }
  static std::uint64_t with_field(std::uint64_t packed, unsigned field, Index x) {
    return (packed & before(field)) | std::uint64_t{x} << (field * field_bits) |
           (packed & ~before(field)) << field_bits;
  }
  /// The record of a facet of the border, from the cell in the hole.
  static std::uint64_t pack_facet(const Index* numbers, int slot) {
    // Fields that are not there yet are larger than any number.
    constexpr std::uint64_t none_yet = (ones << (field_bits - 1)) - ones;
    std::uint64_t packed = none_yet;
    unsigned inversions = static_cast<unsigned>(slot) + 1;  // seen from the other side
    unsigned count = 0;
    for (int i = 0; i <= K; ++i) {
      if (i == slot) continue;
      const unsigned place = num_up_to(packed, numbers[i]);
      packed = with_field(packed, place, numbers[i]);
      inversions += count++ - place;
    }
    return (packed & all_fields) | std::uint64_t{inversions % 2} << 63;
  }
  /// The records of the facets of a cell; see write_records().
  static void pack_facets(const Index* vertices, int slot, std::uint64_t across, std::uint64_t* records) {
    const std::uint64_t packed = across & ~orientation_bit;
    const Index apex = vertices[slot];
    const unsigned place = num_up_to(packed, apex), side = static_cast<unsigned>(across >> 63) + 1 + place;
    for (int i = 0; i <= K; ++i) {
      const unsigned rank = num_up_to(packed, vertices[i]) - (i != slot);  // on the facet
      const bool is_after = rank >= place;
      records[i] = with_field(without_field(packed, rank), place - !is_after, apex) |
                   std::uint64_t{(side + rank + is_after) % 2} << 63;
    }
    records[slot] = across ^ orientation_bit;
  }

  /// Of a facet of the border, from the cell in the hole.
  void write_record(std::uint32_t facet, const Index* numbers, int slot) {
    if constexpr (can_pack)
      if (is_packed_) {
        records_[facet] = pack_facet(numbers, slot);
        return;
      }
    records_[facet] = sum_of_keys(numbers, slot);
  }
  /// Of the facets of a cell; `across`: the record of the one opposite the slot, as seen from the other side.
  void write_records(const Index* vertices, int slot, std::uint64_t across, std::uint64_t* records) const {
    if constexpr (can_pack)
      if (is_packed_) return pack_facets(vertices, slot, across, records);
    const std::uint64_t sum = sum_of_keys(vertices, -1);
    for (std::size_t i = 0; i < width(); ++i) records[i] = sum - keys_[vertices[i]];
  }
  /// Of all vertices but the one in a slot; −1: of all.
  std::uint64_t sum_of_keys(const Index* vertices, int slot) const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < width(); ++i)
      if (static_cast<int>(i) != slot) sum += keys_[vertices[i]];
    return sum;
  }

  // An entry of the table has the number of a facet, plus 1, and above it bits of the hash of its record.

  std::uint64_t hash(std::uint32_t facet) const {
    return (records_[facet] & ~orientation_bit) * 0x9e3779b97f4a7c15u;
  }
  /// The upper bits of a product depend on all others.
  std::size_t place(std::uint64_t hash) const { return static_cast<std::size_t>(hash >> shift_); }
  static std::uint64_t tag(std::uint64_t hash) { return hash >> 20 << 32; }

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
      std::size_t at = place(hash(static_cast<std::uint32_t>(entry) - 1));
      while (larger[at] != 0) at = (at + 1) & mask_;
      larger[at] = entry;
    }
    table_.swap(larger);
  }
  /// Returns the facet that is the same and has no other one yet; if there is none, keeps this one.
  std::uint32_t match(std::uint32_t facet) {
    const std::uint64_t hash = this->hash(facet);
    std::size_t at = place(hash);
    for (; table_[at] != 0; at = (at + 1) & mask_) {
      if ((table_[at] ^ tag(hash)) >> 32 != 0) continue;
      const std::uint32_t other = static_cast<std::uint32_t>(table_[at]) - 1;
      const std::uint64_t difference = records_[facet] ^ records_[other];
      if ((difference & ~orientation_bit) != 0) continue;
      if (beside_[other] != none) {
        has_excess_ = true;
        return none;
      }
      is_wrong_ |= difference == 0;
      --num_open_;
      return other;
    }
    table_[at] = tag(hash) | (facet + 1);
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
  bool is_packed_ = false;   // records have numbers of vertices
  int shift_ = 0;            // from a hash to a place in the table
  bool is_wrong_ = false;    // if so, two cells are on one side of their common facet
  std::uint64_t seed_ = 0x9e3779b97f4a7c15u;
  std::vector<std::uint64_t> keys_;     // of vertices
  std::vector<std::uint64_t> records_;  // of facets
  std::vector<std::uint64_t> table_;    // the first mask_ + 1 entries
  std::vector<Index> vertices_;         // k + 1 for each cell
  std::vector<std::uint32_t> beside_;
  std::vector<std::uint8_t> is_odd_;
  std::vector<std::uint8_t> is_met_;
  std::vector<Sorted> sorted_;
};

}  // namespace delone::engine
