// SPDX-License-Identifier: BSD-3-Clause
// Small numbers by key, in a hash table that is emptied in constant time: for loops that need a fresh table
// in every turn.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace delone::internal {

/// A map of 64-bit keys to 32-bit numbers. Open addressing; an entry is valid if it carries the stamp of the
/// present turn.
class StampedTable {
 public:
  StampedTable() : entries_(smallest) {}

  /// Removes all entries. O(1). If few are expected next, they share few cache lines.
  void clear(std::size_t expected = static_cast<std::size_t>(-1) / 4) {
    size_ = 0;
    mask_ = std::min(entries_.size(), std::bit_ceil(std::max(smallest, 2 * expected))) - 1;
    if (++stamp_ != 0) return;
    entries_.assign(entries_.size(), Entry{});
    stamp_ = 1;
  }
  std::size_t size() const { return size_; }

  bool contains(std::uint64_t key) const { return find_value(key) != nullptr; }
  /// The number of `key`, or null.
  const std::uint32_t* find_value(std::uint64_t key) const {
    const Entry& entry = entries_[place(entries_, mask_, key)];
    return entry.stamp == stamp_ ? &entry.value : nullptr;
  }

  /// Makes room for `count` more keys. Throws std::bad_alloc, and then changes nothing.
  void reserve(std::size_t count) {
    while (2 * (size_ + count) > mask_ + 1) grow();
  }
  /// The number of `key`, until the next is inserted, and whether it was inserted just now, with `value`.
  std::pair<std::uint32_t&, bool> insert(std::uint64_t key, std::uint32_t value) {
    if (2 * (size_ + 1) > mask_ + 1) grow();
    Entry& entry = entries_[place(entries_, mask_, key)];
    if (entry.stamp == stamp_) return {entry.value, false};
    entry = {key, value, stamp_};
    ++size_;
    return {entry.value, true};
  }
  /// Gives `key` this number, whether it has one or not.
  void set(std::uint64_t key, std::uint32_t value) { insert(key, value).first = value; }

 private:
  struct Entry {
    std::uint64_t key = 0;
    std::uint32_t value = 0, stamp = 0;
  };
  static constexpr std::size_t smallest = 64;

  /// Where the key is, or else the free entry where it belongs.
  std::size_t place(const std::vector<Entry>& entries, std::size_t mask, std::uint64_t key) const {
    std::size_t at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15u) >> 32) & mask;
    while (entries[at].stamp == stamp_ && entries[at].key != key) at = (at + 1) & mask;
    return at;
  }
  void grow() {
    const std::size_t mask = 2 * mask_ + 1;
    std::vector<Entry> larger(mask + 1);
    for (const Entry& entry : entries_)
      if (entry.stamp == stamp_) larger[place(larger, mask, entry.key)] = entry;
    entries_.swap(larger);
    mask_ = mask;
  }

  std::vector<Entry> entries_;
  std::size_t mask_ = smallest - 1;  // of the entries in use, a power of two
  std::size_t size_ = 0;
  std::uint32_t stamp_ = 1;
};

}  // namespace delone::internal
