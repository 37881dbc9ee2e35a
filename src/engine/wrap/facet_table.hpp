// SPDX-License-Identifier: BSD-3-Clause
// The facets that have one cell so far, while cells are created one beside the other (wrapping.hpp): a hash
// table of keys that come and go in pairs.
#pragma once

#include "base/compiler.hpp"
#include "base/growable_array.hpp"
#include "engine/wrap/facet_table_kernel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>

namespace delone::engine {

/// Maps keys to values; a key is in the table while it has been met an odd number of times. A cache line has
/// room for five keys. Keys that do not fit go to the neighboring line, and those that do not fit there to a
/// map. Only these overflows are branches that depend on data in match().
class FacetTable {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  static constexpr std::size_t most_at_once = 17;

  FacetTable() : FacetTable(fewest_lines) {}

  std::size_t size() const { return size_; }
  [[gnu::always_inline]] void prefetch(std::uint64_t key) const {
    internal::prefetch_for_writing(&lines_[place(key)]);
  }

  /// Prefetches the line beside that of a key, if the key may be there or may go there. The key's own line
  /// should have been prefetched.
  [[gnu::always_inline]] void prefetch_overflow(std::uint64_t key) const {
    const std::size_t home = place(key);
    const Line& line = lines_[home];
    const std::uint64_t overflows = line.num_beside | line.keys[room - 1];  // 0, or not; no branch
    internal::prefetch_for_writing(
        &lines_[home ^ static_cast<std::size_t>((overflows | (0 - overflows)) >> 63)]);
  }

  /// For each of up to most_at_once keys, which are different: if it is there, removes it and writes its
  /// value to `others`; else adds it with the value `first` + its number, and writes `none`. Slow without a
  /// reserve() that covers them. REQUIRES that no key is 0. Throws std::bad_alloc.
  void match(std::span<const std::uint64_t> keys, std::uint32_t first, std::uint32_t* others) {
    std::array<FacetPlaces, most_at_once> places;
    find_facets(lines_.data(), num_lines_, keys, places.data());
    for (std::size_t i = 0; i < keys.size(); ++i)
      others[i] = match(keys[i], first + static_cast<std::uint32_t>(i), places[i]);
  }

  /// Makes room for `count` more keys, and releases memory if far fewer are left. Throws std::bad_alloc, and
  /// then changes nothing.
  void reserve(std::size_t count) {
    if (2 * (size_ + count) > most_per_two_lines * num_lines_)
      rebuild(2 * num_lines_);
    else if (num_lines_ > fewest_lines && 2 * (size_ + count) < num_lines_)
      rebuild(num_lines_ / 2);
  }

 private:
  using Line = FacetLine;
  static constexpr int room = Line::room;
  static constexpr std::size_t fewest_lines = 1024;
  static constexpr std::size_t most_per_two_lines = 4;  ///< then one line in 60 overflows

  /// `places`: where the key is and may go, found before other keys were added.
  [[gnu::always_inline]] std::uint32_t match(std::uint64_t key, std::uint32_t value, FacetPlaces places) {
    const std::size_t home = place(key);
    Line& line = lines_[home];
    // Whether the key is there is unpredictable; the rest is predictable and tested first.
    if ((line.num_beside | line.num_elsewhere) != 0) [[unlikely]]
      if (places.hits == 0)
        if (const std::uint32_t other = take_from_overflow(home, key); other != none) return other;
    if ((places.hits | places.vacancies) == 0) [[unlikely]]
      return add(home, key, value);
    // Masks, as compilers turn selections into branches.
    const std::uint32_t hit = 0u - static_cast<std::uint32_t>(places.hits != 0);
    const int i = std::countr_zero(places.hits | (places.vacancies & ~hit));
    const std::uint64_t vacated = static_cast<std::uint64_t>(static_cast<std::int32_t>(hit));
    if ((line.keys[i] & ~vacated) != 0) [[unlikely]]  // taken meanwhile
      return add(home, key, value);
    const std::uint32_t other = line.values[i] | ~hit;
    line.keys[i] = key & ~vacated;
    line.values[i] = value;
    size_ += (vacated | 1);
    return other;
  }

  /// Removes a key that is not in its line from the line beside it or from the map, and returns its value;
  /// `none` if it is in neither.
  std::uint32_t take_from_overflow(std::size_t home, std::uint64_t key) {
    Line& line = lines_[home];
    Line& beside = lines_[home ^ 1];
    std::uint64_t* const found_beside = std::find(beside.keys, beside.keys + room, key);
    if (line.num_beside != 0 && found_beside != beside.keys + room) {
      *found_beside = 0;
      --line.num_beside;
      --size_;
      return beside.values[found_beside - beside.keys];
    }
    if (line.num_elsewhere == 0) return none;
    const auto found = elsewhere_.find(key);
    if (found == elsewhere_.end()) return none;
    const std::uint32_t other = found->second;
    elsewhere_.erase(found);
    --line.num_elsewhere;
    --size_;
    return other;
  }
  /// Adds a key to the first place with room. Returns `none`.
  std::uint32_t add(std::size_t home, std::uint64_t key, std::uint32_t value) {
    const auto put = [&](Line& line) {
      std::uint64_t* const vacant = std::find(line.keys, line.keys + room, 0);
      if (vacant == line.keys + room) return false;
      *vacant = key;
      line.values[vacant - line.keys] = value;
      return true;
    };
    if (put(lines_[home])) {
    } else if (put(lines_[home ^ 1])) {
      ++lines_[home].num_beside;
    } else {
      elsewhere_.emplace(key, value);
      ++lines_[home].num_elsewhere;
    }
    ++size_;
    return none;
  }

  explicit FacetTable(std::size_t lines) : lines_(internal::Pages::large), num_lines_(lines) {
    lines_.reserve(lines);
    std::fill_n(lines_.data(), lines, Line{});
  }
  void rebuild(std::size_t lines) {
    FacetTable other(lines);
    const auto add_all = [&](const Line& line) {
      for (int i = 0; i < room; ++i)
        if (const std::uint64_t key = line.keys[i]; key != 0)
          other.add(other.place(key), key, line.values[i]);
    };
    // Otherwise the line also has keys of the line beside it.
    const auto has_only_its_own = [&](std::size_t l) { return lines_[l ^ 1].num_beside == 0; };
    if (lines == 2 * num_lines_) {
      for (std::size_t l = 0; l < num_lines_; ++l)
        if (has_only_its_own(l)) other.share_out(lines_[l], other.lines_[l], other.lines_[l + num_lines_]);
      for (std::size_t l = 0; l < num_lines_; ++l)
        if (!has_only_its_own(l)) add_all(lines_[l]);
    } else {
      std::for_each_n(lines_.data(), num_lines_, add_all);
    }
    for (const auto& [key, value] : elsewhere_) other.add(other.place(key), key, value);
    *this = std::move(other);
  }
  /// Distributes the keys of a line of a table half as large to two empty lines. The choice is unpredictable,
  /// so there is no branch.
  void share_out(const Line& line, Line& lower, Line& upper) {
    Line* const lines[] = {&lower, &upper};
    std::size_t counts[] = {0, 0};
    for (int i = 0; i < room; ++i) {
      const std::uint64_t key = line.keys[i];
      const bool is_upper = place(key) >= num_lines_ / 2;
      lines[is_upper]->keys[counts[is_upper]] = key;
      lines[is_upper]->values[counts[is_upper]] = line.values[i];
      counts[is_upper] += key != 0;
    }
    size_ += counts[0] + counts[1];
  }
  std::size_t place(std::uint64_t key) const { return Line::place(key, num_lines_); }

  internal::GrowableArray<Line> lines_;
  std::size_t num_lines_;  // a power of two
  std::unordered_map<std::uint64_t, std::uint32_t> elsewhere_;
  std::size_t size_ = 0;
};

}  // namespace delone::engine
