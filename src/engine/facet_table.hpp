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
/// does not fit is kept apart. Nothing in match() but that is a branch that depends on the data.
class FacetTable {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  FacetTable() : FacetTable(fewest_lines) {}

  std::size_t size() const { return size_; }
  [[gnu::always_inline]] void prefetch(std::uint64_t key) const { __builtin_prefetch(&lines_[place(key)], 1); }

  /// If the key is there, removes it and returns its value; else adds it with the given value and returns `none`. Slow without
  /// a reserve() that covers it. REQUIRES that the key is not 0. Throws std::bad_alloc.
  std::uint32_t match(std::uint64_t key, std::uint32_t value) {
    Line& line = lines_[place(key)];
    std::uint32_t hits = 0, vacancies = 0;
    for (int i = 0; i < room; ++i) {
      hits |= std::uint32_t{line.keys[i] == key} << i;
      vacancies |= std::uint32_t{line.keys[i] == 0} << i;
    }
    if (line.num_elsewhere != 0 && hits == 0) {
      const auto found = elsewhere_.find(key);
      if (found != elsewhere_.end()) {
        const std::uint32_t other = found->second;
        elsewhere_.erase(found);
        --line.num_elsewhere;
        --size_;
        return other;
      }
    }
    if ((hits | vacancies) == 0) {
      elsewhere_.emplace(key, value);
      ++line.num_elsewhere;
      ++size_;
      return none;
    }
    const bool is_hit = hits != 0;
    const int i = __builtin_ctz(is_hit ? hits : vacancies);
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
    std::uint32_t num_elsewhere;
  };

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
