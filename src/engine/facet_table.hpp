// SPDX-License-Identifier: BSD-3-Clause
// The facets that have one cell so far, while cells are created one beside the other (wrap.hpp): a hash table of keys that come
// and go in pairs.
#pragma once

#include "growable_array.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace delone::engine {

/// Maps keys to values, each for as long as it is met an odd number of times. A line of the cache has room for five keys; what
/// does not fit goes to the line beside it, and what does not fit there is kept apart. Nothing in match() but that is a branch
/// that depends on the data.
class FacetTable {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  FacetTable() : FacetTable(fewest_lines) {}

  std::size_t size() const { return size_; }
  [[gnu::always_inline]] void prefetch(std::uint64_t key) const { __builtin_prefetch(&lines_[place(key)], 1); }

  /// Asks for the line beside that of a key, if the key may be there, or may go there. The line of the key should have come.
  [[gnu::always_inline]] void prefetch_overflow(std::uint64_t key) const {
    const std::size_t home = place(key);
    const Line& line = lines_[home];
    const bool overflows = line.num_beside != 0 || line.keys[room - 1] != 0;
    __builtin_prefetch(&lines_[home ^ static_cast<std::size_t>(overflows)], 1);
  }

  /// If the key is there, removes it and returns its value; else adds it with the given value and returns `none`. Slow without
  /// a reserve() that covers it. REQUIRES that the key is not 0. Throws std::bad_alloc.
  std::uint32_t match(std::uint64_t key, std::uint32_t value) {
    const std::size_t home = place(key);
    Line& line = lines_[home];
    const Places places = places_of(line, key);
    if (places.hits == 0 && (line.num_beside | line.num_elsewhere) != 0) [[unlikely]]
      if (const std::uint32_t other = take_from_overflow(home, key); other != none) return other;
    if ((places.hits | places.vacancies) == 0) [[unlikely]] {
      add_to_overflow(home, key, value);
      return none;
    }
    const bool is_hit = places.hits != 0;
    const int i = __builtin_ctz(is_hit ? places.hits : places.vacancies);
    const std::uint32_t other = is_hit ? line.values[i] : none;
    line.keys[i] = is_hit ? 0 : key;
    line.values[i] = value;
    size_ += is_hit ? std::size_t{0} - 1 : 1;
    return other;
  }

  /// Makes room for `count` more keys, and gives memory back where far fewer are left. Throws std::bad_alloc, and then nothing
  /// has changed.
  void reserve(std::size_t count) {
    if (2 * (size_ + count) > most_per_two_lines * num_lines_)
      rebuild(2 * num_lines_);
    else if (num_lines_ > fewest_lines && 2 * (size_ + count) < num_lines_)
      rebuild(num_lines_ / 2);
  }

 private:
  static constexpr int room = 5;
  static constexpr std::size_t fewest_lines = 1024;
  static constexpr std::size_t most_per_two_lines = 5;  ///< then one line in 25 overflows
  struct Line {
    std::uint64_t keys[room];  ///< 0: vacant
    std::uint32_t values[room];
    std::uint16_t num_beside;     ///< keys of this line that are in the one beside it
    std::uint16_t num_elsewhere;  ///< and in no line
  };
  /// Bits of the places of a line.
  struct Places {
    std::uint32_t hits, vacancies;
  };

  static Places places_of(const Line& line, std::uint64_t key) {
    Places places{0, 0};
    for (int i = 0; i < room; ++i) {
      places.hits |= std::uint32_t{line.keys[i] == key} << i;
      places.vacancies |= std::uint32_t{line.keys[i] == 0} << i;
    }
    return places;
  }

  /// Removes a key that is not in its line from the line beside it, or from what is in no line; `none` if it is in neither.
  std::uint32_t take_from_overflow(std::size_t home, std::uint64_t key) {
    Line& line = lines_[home];
    Line& beside = lines_[home ^ 1];
    if (const std::uint32_t hits = places_of(beside, key).hits; line.num_beside != 0 && hits != 0) {
      const int i = __builtin_ctz(hits);
      beside.keys[i] = 0;
      --line.num_beside;
      --size_;
      return beside.values[i];
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
  void add_to_overflow(std::size_t home, std::uint64_t key, std::uint32_t value) {
    Line& beside = lines_[home ^ 1];
    if (const std::uint32_t vacancies = places_of(beside, key).vacancies; vacancies != 0) {
      const int i = __builtin_ctz(vacancies);
      beside.keys[i] = key;
      beside.values[i] = value;
      ++lines_[home].num_beside;
    } else {
      elsewhere_.emplace(key, value);
      ++lines_[home].num_elsewhere;
    }
    ++size_;
  }

  explicit FacetTable(std::size_t lines) : lines_(Pages::large), num_lines_(lines) {
    lines_.reserve(lines);
    std::fill_n(lines_.data(), lines, Line{});
  }
  void rebuild(std::size_t lines) {
    FacetTable other(lines);
    for (std::size_t l = 0; l < num_lines_; ++l)
      for (int i = 0; i < room; ++i)
        if (lines_[l].keys[i] != 0) other.match(lines_[l].keys[i], lines_[l].values[i]);
    for (const auto& [key, value] : elsewhere_) other.match(key, value);
    *this = std::move(other);
  }
  std::size_t place(std::uint64_t key) const { return static_cast<std::size_t>(key >> 20) & (num_lines_ - 1); }

  GrowableArray<Line> lines_;
  std::size_t num_lines_;  // a power of two
  std::unordered_map<std::uint64_t, std::uint32_t> elsewhere_;
  std::size_t size_ = 0;
};

}  // namespace delone::engine
