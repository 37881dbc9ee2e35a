// SPDX-License-Identifier: BSD-3-Clause
// Finds the cells of a new star that share a ridge of the horizon, by hashing and without branches that
// depend on data.
//
// A half-ridge is a ridge seen from one of its cells. The horizon is the boundary of a ball, so every ridge
// has exactly two half-ridges. Each adds itself and a count to the table entry that a hash of the ridge's
// vertex set selects. Both half-ridges of a ridge select the same entry; so an entry that exactly two have
// selected holds the two halves of one ridge: the sum less one half is the other, exactly, whatever the
// quality of the hash. Half-ridges in fuller entries are hashed again, among themselves. Those that are still
// left after some rounds, mostly because their hashes are equal, are compared.
//
// In two dimensions ridges are vertices and the horizon is a cycle of edges, each of which ends where another
// one begins: a small table of where edges begin links nearly all stars. If two vertices share an entry, the
// ridges are hashed.
#pragma once

#include "base/compiler.hpp"
#include "base/growable_array.hpp"
#include "cells/horizon_facet.hpp"
#include "engine/cell_store.hpp"
#include "engine/link_kernel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace delone::engine {

using internal::GrowableArray;

class RidgeTable {
 public:
  /// `rounds`: how often half-ridges are hashed before they are compared.
  explicit RidgeTable(int rounds = 6) : rounds_(rounds) {}

  /// Makes room for the star over `facets` facets of cells of dimension k. Throws std::bad_alloc.
  void reserve(std::size_t facets, int k) {
    if (k != k_) [[unlikely]]
      grow(few, k);
    if (facets > few) [[unlikely]]
      grow(facets, k);
  }

  /// Notes a created triangle of facet f as soon as it has its vertices, with the apex in slot `apex`.
  void note(std::uint32_t f, const Index* vertices, int apex) { beginning_at(vertices[next_slot[apex]]) = f; }
  /// Hashes the ridges of the facets first … last − 1, whose created cells have their vertices. REQUIRES
  /// reserve().
  template <int K>
  void hash(CellStore<K>& cells, std::span<const HorizonFacet> facets, std::size_t first, std::size_t last) {
    if constexpr (K == 2) return;  // link() does it for the few stars of triangles that need it
    const RidgeEntries table = narrow_table(facets.size(), cells.dimension());
    hash_ridges(cells.links(), facets, first, last, hashes_.data(), created_.data(),
                table.entries != nullptr ? &table : nullptr);
  }
  /// Links the created cells of all facets across their ridges, once all are hashed.
  template <int K>
  void link(CellStore<K>& cells, std::span<const HorizonFacet> facets);

 private:
  /// The facet of a half-ridge, and its slot in the created cell.
  static std::uint32_t facet(std::uint32_t half, int k) { return half >> half_ridge_shift(k); }
  static int slot(std::uint32_t half, int k) {
    return static_cast<int>(half & ((1u << half_ridge_shift(k)) - 1));
  }

  /// An entry has its count in the bits above the sum, which has room for two half-ridges. The sum of more
  /// than two may carry into the count, less than 1 for every two of them. So a count above 2 cannot look
  /// like 2 as long as one and a half times the number of all half-ridges does not overflow it. That holds
  /// for 2^15 half-ridges with 16 bits for each part, and always with 32. With 24 of 32 bits for the sum, a
  /// count may overflow and come round to 2. Then the half-ridges that have found another are more than twice
  /// as many as the entries with a count of two, and no match is used.
  static constexpr int short_bits = 16, narrow_bits = 24, wide_bits = 32;
  static bool fits(int sum_bits, std::size_t facets, int k) {
    return facets << half_ridge_shift(k) <= std::size_t{1} << (sum_bits - 1);
  }
  /// Small tables have more entries per half-ridge than large ones: a table that fills the L1 cache, or does
  /// not fit it, is better fuller, although it leaves more half-ridges unmatched.
  static std::size_t num_entries(std::size_t facets, int k) {
    const std::size_t halves = std::max<std::size_t>(facets * static_cast<std::size_t>(k), 1);
    return std::bit_ceil(halves * (4 * halves <= least_entries       ? 4
                                   : fits(short_bits + 1, facets, k) ? 2
                                                                     : 1));
  }
  /// A star of less than `few` facets has at most this many entries, or as many as a star of `few` facets.
  static constexpr std::size_t least_entries = 1024;

  /// Makes room for a star of so many facets; for `few` facets, also for all smaller stars.
  [[gnu::noinline]] void grow(std::size_t facets, int k) {
    const std::size_t halves = facets << half_ridge_shift(k);
    if (halves >= std::min(hashes_.capacity(), unmatched_.capacity() / 2)) {
      unmatched_.reserve(4 * halves + 2);
      hashes_.reserve(2 * halves + 1);
    }
    if (created_.capacity() < facets) created_.reserve(2 * facets);
    if (left_.size() < num_words(halves)) left_.resize(2 * num_words(halves));
    const std::size_t size = num_entries(facets, k);
    if (fits(narrow_bits, facets, k)) {
      if (narrow_.size() <= size) narrow_.resize(std::max(size, least_entries) + 1, 0);
      if (!fits(short_bits, facets, k) && wide_.size() < rest_size(size)) wide_.resize(rest_size(size), 0);
    } else if (wide_.size() < size) {
      wide_.resize(size, 0);
    }
    k_ = k;
  }
  /// Entries for what the first round leaves in a narrow table of that size.
  static std::size_t rest_size(std::size_t size) { return std::max<std::size_t>(size / 2, 2); }

  /// The table for a star, whose entries are null if it needs the wide one.
  RidgeEntries narrow_table(std::size_t facets, int k) {
    const int bits = std::bit_width(num_entries(facets, k)) - 1;
    if (!fits(narrow_bits, facets, k)) return {nullptr, bits, wide_bits};
    return {narrow_.data(), bits, fits(short_bits, facets, k) ? short_bits : narrow_bits};
  }
  /// The word whose lowest bits are those of the first byte.
  static std::uint64_t from_bytes(std::uint64_t bytes) {
    return std::endian::native == std::endian::big ? internal::byte_swap(bytes) : bytes;
  }
  static std::size_t num_words(std::size_t halves) { return halves / 64 + 1; }

  /// Seen from the apex of a triangle, its edge goes from the vertex in the next slot to that in the one
  /// after it.
  static constexpr int next_slot[] = {1, 2, 0};
  std::uint32_t& beginning_at(Index vertex) { return beginning_[vertex % beginning_.size()]; }

  /// Links the triangles of a star along the cycle of its edges. Returns whether each vertex has an entry of
  /// its own; else the links are of no use.
  bool link_cycle(CellStore<2>& cells, std::span<const HorizonFacet> facets);

  /// Links the created cells of all half-ridges that match. Returns how many of unmatched_ are left.
  template <int K>
  std::uint32_t match_narrow(const RidgeEntries& table, CellStore<K>& cells,
                             std::span<const HorizonFacet> facets);
  /// The same for those that are left, by other hashes, round after round. Returns those that are left then.
  template <int SumBits, class Entry, int K>
  std::span<std::uint32_t> match_rest(Entry* entries, std::size_t size, std::uint32_t left,
                                      CellStore<K>& cells);
  /// The same for all that are left, by comparing vertices. The halves of a ridge have the same hash, so only
  /// half-ridges of one hash are compared. Allocates nothing, as it must not fail: cells have been changed.
  template <int K>
  void compare(CellStore<K>& cells, std::span<std::uint32_t> left);
  std::uint32_t all_unmatched(std::span<const HorizonFacet> facets, int k);

  /// There is room for stars of so many facets from the first one on.
  static constexpr std::size_t few = 64;

  int rounds_;
  int k_ = -1;                           // the dimension of the cells that there is room for
  std::vector<std::uint32_t> narrow_;    // entries, all zero between calls: counts above, sums below
  std::vector<std::uint64_t> wide_;      // the same for large stars, and for the rest of others
  GrowableArray<std::uint32_t> hashes_;  // of the ridges of all half-ridges
  GrowableArray<std::uint32_t> unmatched_;
  GrowableArray<Index> created_;
  std::vector<std::uint64_t> left_;  // a bit for each half-ridge: whether it is unmatched
  std::array<std::uint32_t, 1024>
      beginning_{};  // which edge of a cycle begins at a vertex, by the low bits of its id
};

inline std::uint32_t RidgeTable::all_unmatched(std::span<const HorizonFacet> facets, int k) {
  std::uint32_t left = 0;
  for (std::uint32_t f = 0; f < facets.size(); ++f)
    for (int i = 0; i <= k; ++i)
      if (i != facets[f].slot)
        unmatched_[left++] = (f << half_ridge_shift(k)) + static_cast<std::uint32_t>(i);
  return left;
}

template <int K>
void RidgeTable::link(CellStore<K>& cells, std::span<const HorizonFacet> facets) {
  const int k = cells.dimension();
  if constexpr (K == 2)
    if (link_cycle(cells, facets)) return;
  const RidgeEntries table = narrow_table(facets.size(), k);
  if constexpr (K == 2)
    hash_ridges(cells.links(), facets, 0, facets.size(), hashes_.data(), created_.data(),
                table.entries != nullptr ? &table : nullptr);
  const std::size_t size = num_entries(facets.size(), k);
  const std::uint32_t left =
      table.entries != nullptr ? match_narrow(table, cells, facets) : all_unmatched(facets, k);
  if (table.entries != nullptr && table.sum_bits == short_bits)
    return compare(cells, match_rest<short_bits>(narrow_.data(), size, left, cells));
  compare(cells, match_rest<wide_bits>(wide_.data(), table.entries != nullptr ? rest_size(size) : size, left,
                                       cells));
}

template <int K>
void RidgeTable::compare(CellStore<K>& cells, std::span<std::uint32_t> left) {
  const int k = cells.dimension();
  const auto cell_of = [&](std::uint32_t half) { return created_[facet(half, k)]; };
  const auto is_one_ridge = [&](std::uint32_t half, std::uint32_t other) {
    const auto vertices = cells.vertices(cell_of(half)), vertices_of_other = cells.vertices(cell_of(other));
    const std::span<const Index> ids{static_cast<const Index*>(vertices), static_cast<std::size_t>(k) + 1};
    const std::span<const Index> others{static_cast<const Index*>(vertices_of_other), ids.size()};
    const Index omitted = others[static_cast<std::size_t>(slot(other, k))];
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (i != static_cast<std::size_t>(slot(half, k)) &&
          (ids[i] == omitted || std::find(others.begin(), others.end(), ids[i]) == others.end()))
        return false;
    return true;
  };
  std::sort(left.begin(), left.end(),
            [&](std::uint32_t a, std::uint32_t b) { return hashes_[a] < hashes_[b]; });
  for (std::size_t i = 0; i < left.size(); ++i)
    for (std::size_t j = i + 1; j < left.size() && hashes_[left[j]] == hashes_[left[i]]; ++j) {
      if (!is_one_ridge(left[i], left[j])) continue;
      cells.neighbors(cell_of(left[i]))[slot(left[i], k)] = cell_of(left[j]);
      cells.neighbors(cell_of(left[j]))[slot(left[j], k)] = cell_of(left[i]);
    }
}

inline bool RidgeTable::link_cycle(CellStore<2>& cells, std::span<const HorizonFacet> facets) {
  bool matched = true;
  for (const HorizonFacet& facet : facets) {
    const int begin = next_slot[facet.slot], end = next_slot[begin];
    const Index vertex = cells.vertex(facet.created, end);
    const HorizonFacet& other =
        facets[beginning_at(vertex)];  // some edge begins here, so that the entry is of this star
    const int begin_of_other = next_slot[other.slot];
    matched &= cells.vertex(other.created, begin_of_other) == vertex;
    cells.neighbors(facet.created)[begin] = other.created;
    cells.neighbors(other.created)[next_slot[begin_of_other]] = facet.created;
  }
  return matched;
}

template <int K>
std::uint32_t RidgeTable::match_narrow(const RidgeEntries& table, CellStore<K>& cells,
                                       std::span<const HorizonFacet> facets) {
  const int k = cells.dimension();
  const std::size_t words = num_words(facets.size() << half_ridge_shift(k)),
                    size = std::size_t{1} << table.bits;
  left_[words - 1] = 0;
  match_ridges(cells.links(), facets, hashes_.data(), created_.data(), table,
               reinterpret_cast<std::uint8_t*>(left_.data()));
  std::uint32_t left = 0;
  for (std::size_t word = 0; word < words; ++word)
    for (std::uint64_t bits = from_bytes(left_[word]); bits != 0; bits &= bits - 1)
      unmatched_[left++] =
          static_cast<std::uint32_t>(64 * word) + static_cast<std::uint32_t>(std::countr_zero(bits));
  std::size_t pairs = 0;
  if (table.sum_bits == narrow_bits)
    for (std::size_t i = 0; i < size; ++i) pairs += table.entries[i] >> narrow_bits == 2;
  std::fill_n(table.entries, size + 1,
              0u);  // it is in the cache, so filling it is faster than clearing single entries
  if (table.sum_bits == narrow_bits && 2 * pairs + left != facets.size() * static_cast<std::size_t>(k))
    return all_unmatched(facets, k);
  return left;
}

template <int SumBits, class Entry, int K>
std::span<std::uint32_t> RidgeTable::match_rest(Entry* entries, std::size_t size, std::uint32_t left,
                                                CellStore<K>& cells) {
  constexpr Entry one = Entry{1} << SumBits;
  const int k = cells.dimension();
  const int shift = 32 - (std::bit_width(size) - 1);
  std::uint32_t* unmatched = unmatched_.data();
  std::uint32_t* spare = unmatched + unmatched_.capacity() / 2;
  std::uint32_t multiplier = 0x9e3779b9;
  for (int round = 1; round < rounds_ && left > 0; ++round, multiplier *= 0x85ebca6b) {
    const auto entry_of = [&](std::uint32_t half) -> Entry& {
      return entries[hashes_[half] * multiplier >> shift];
    };
    const std::uint32_t count = std::exchange(left, 0u);
    for (std::uint32_t i = 0; i < count; ++i)
      entry_of(unmatched[i]) += static_cast<Entry>(one + unmatched[i]);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t half = unmatched[i];
      const Entry entry = entry_of(half);
      const bool matched = entry >> SumBits == 2;
      const std::uint32_t other = matched ? static_cast<std::uint32_t>(entry - 2 * one) - half : half;
      const std::uint32_t f = facet(half, k);
      cells.neighbors(created_[f])[slot(half, k)] = created_[facet(other, k)];
      spare[left] = half;
      left += !matched;
    }
    for (std::uint32_t i = 0; i < count; ++i) entry_of(unmatched[i]) = 0;
    std::swap(unmatched, spare);
  }
  return {unmatched, left};
}

}  // namespace delone::engine
