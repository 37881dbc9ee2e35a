// SPDX-License-Identifier: BSD-3-Clause
// A hash table from points to sites: open addressing with linear probing, at most half full. Sites are
// numbered in the order in which they are added.
#pragma once

#include "base/compiler.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::sites {

class SiteTable {
 public:
  /// The site with this tag for which is_at(site) holds; invalid_index if there is none.
  template <class IsAt>
  Index find(std::uint64_t tag, IsAt is_at) const {
    if (entries_.empty()) return invalid_index;
    for (std::size_t at = tag & mask();; at = (at + 1) & mask()) {
      const Entry& entry = entries_[at];
      if (entry.site == invalid_index) return invalid_index;
      if (entry.tag == tag && is_at(entry.site)) return entry.site;
    }
  }

  /// Makes room for n sites in total.
  void reserve(std::size_t n) {
    std::size_t most = std::max(entries_.size(), std::size_t{16});
    while (2 * n > most) most *= 2;
    if (n > 0 && most > entries_.size()) rehash(most);
  }
  /// Prefetches the entry where find() and add() start.
  [[gnu::always_inline]] void prefetch(std::uint64_t tag) const {
    if (!entries_.empty()) internal::prefetch_for_writing(&entries_[tag & mask()]);
  }

  /// Strong guarantee: throws std::bad_alloc or succeeds.
  void add(std::uint64_t tag, Index site) {
    reserve(size_ + 1);
    place(entries_, {tag, site});
    ++size_;
  }

  /// Removes the site if it is the last one added; does nothing if it is not in the table. No later entry was
  /// displaced by it, so it leaves no gap in a probe sequence.
  void remove_last(std::uint64_t tag, Index site) {
    if (entries_.empty()) return;
    std::size_t at = tag & mask();
    while (entries_[at].site != site && entries_[at].site != invalid_index) at = (at + 1) & mask();
    if (entries_[at].site == invalid_index) return;
    entries_[at] = {};
    --size_;
  }

 private:
  struct Entry {
    std::uint64_t tag = 0;
    Index site = invalid_index;
  };

  std::size_t mask() const { return entries_.size() - 1; }
  static void place(std::vector<Entry>& entries, const Entry& entry) {
    std::size_t at = entry.tag & (entries.size() - 1);
    while (entries[at].site != invalid_index) at = (at + 1) & (entries.size() - 1);
    entries[at] = entry;
  }
  /// `most`: a power of two.
  void rehash(std::size_t most) {
    std::vector<Entry> larger(most);
    for (const Entry& entry : entries_)
      if (entry.site != invalid_index) place(larger, entry);
    entries_ = std::move(larger);
  }

  std::vector<Entry> entries_;
  std::size_t size_ = 0;
};

}  // namespace delone::sites
