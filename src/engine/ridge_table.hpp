// SPDX-License-Identifier: BSD-3-Clause
// Finds which cells of a new star share a ridge of the horizon, by hashing and without branches that depend on the data.
//
// A half-ridge is a ridge seen from one of its cells. The horizon is the boundary of a ball, so every ridge has exactly two
// half-ridges. Each adds itself and a count to the table entry that a hash of the ridge's vertex set selects. Both half-ridges
// of a ridge select the same entry; so an entry that exactly two have selected holds the two halves of one ridge: the sum less
// one half is the other, exactly, whatever the quality of the hash. Half-ridges in fuller entries are hashed anew, among
// themselves.
//
// In two dimensions ridges are vertices and the horizon is a cycle of edges, each of which ends where another one begins: a
// small table of where edges begin links nearly all stars. Where two vertices share an entry, hashing does.
#pragma once

#include "engine/cell_store.hpp"
#include "growable_array.hpp"
#include "horizon_facet.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace delone::engine {

class RidgeTable {
 public:
  /// `rounds`: how often half-ridges are hashed before the caller has to link them by other means.
  explicit RidgeTable(int rounds = 6) : rounds_(rounds) {}

  /// Makes room for the star over `facets` facets of cells of dimension k. Throws std::bad_alloc.
  void reserve(std::size_t facets, int k) {
    const std::size_t halves = facets << facet_shift(k);
    if (halves >= std::min(hashes_.capacity(), unmatched_.capacity() / 2)) {
      unmatched_.reserve(4 * halves + 2);
      hashes_.reserve(2 * halves + 1);
    }
    if (created_.capacity() < facets) created_.reserve(2 * facets);
    const std::size_t size = num_entries(facets, k);
    if (fits(narrow_bits, facets, k)) {
      if (narrow_.size() < size) narrow_.resize(size, 0);
      if (!fits(short_bits, facets, k) && wide_.size() < rest_size(size)) wide_.resize(rest_size(size), 0);
    } else if (wide_.size() < size) {
      wide_.resize(size, 0);
    }
  }

  /// Takes note of a created cell of facet f as soon as it has its vertices, that of the apex in slot `apex`.
  template <int K>
  void note(std::uint32_t f, const Index* vertices, int apex) {
    if constexpr (K == 2) beginning_at(vertices[next_slot[apex]]) = f;
  }
  /// Hashes the ridges of the facets first … last − 1, whose created cells have their vertices. REQUIRES reserve().
  template <int K>
  void hash(const CellStore<K>& cells, std::span<const HorizonFacet> facets, std::size_t first, std::size_t last) {
    if constexpr (K != 2)
      hash_ridges(cells, facets, first, last);  // link() does it for the few stars of triangles that need it
  }
  /// Links the created cells of all facets across their ridges, once all are hashed. Returns the half-ridges that it could not
  /// match, which the caller must link.
  template <int K>
  std::span<const std::uint32_t> link(CellStore<K>& cells, std::span<const HorizonFacet> facets);

  /// The facet of a half-ridge, and its slot in the created cell. `apex`: the slot of the new vertex there.
  static std::uint32_t facet(std::uint32_t half, int k) { return half >> facet_shift(k); }
  static int slot(std::uint32_t half, int k, int apex) {
    return slot(static_cast<int>(half & ((1u << facet_shift(k)) - 1)), apex);
  }

 private:
  /// A half-ridge is numbered facet · 2^facet_shift + j for the j-th slot other than that of the apex.
  static int facet_shift(int k) { return std::bit_width(static_cast<unsigned>(k) - 1); }
  static int slot(int j, int apex) { return j + (j >= apex ? 1 : 0); }

  /// Entries count in the bits above those that the sum of two half-ridges takes. What more than two add to the sum may carry
  /// into the count, less than one for every two of them: a count that is more than 2 cannot look like 2 as long as one and a
  /// half times all half-ridges do not overflow it. That holds for 2^15 half-ridges with 16 bits for each part, and for all
  /// with
  /// 32. With 24 bits of 32 for the sum, a count may come round to 2: then more half-ridges have found another than there are
  /// entries with two, times two, and nothing is believed.
  static constexpr int short_bits = 16, narrow_bits = 24, wide_bits = 32;
  static bool fits(int sum_bits, std::size_t facets, int k) {
    return facets << facet_shift(k) <= std::size_t{1} << (sum_bits - 1);
  }
  /// A table that outgrows the cache is better fuller, though more is left by it.
  static std::size_t num_entries(std::size_t facets, int k) {
    return std::bit_ceil((fits(short_bits + 1, facets, k) ? 2 : 1) *
                         std::max<std::size_t>(facets * static_cast<std::size_t>(k), 1));
  }
  /// Entries for what the first round leaves in a narrow table of that size.
  static std::size_t rest_size(std::size_t size) { return std::max<std::size_t>(size / 2, 2); }

  /// Sums of tags are to be different for different sets of vertices, as a rule.
  static std::uint32_t tag(Index vertex) {
    auto x = static_cast<std::uint32_t>(vertex) * 0x9e3779b1;
    x ^= x >> 16;
    return x * 0x85ebca6b;
  }

  /// Seen from the apex of a triangle, its edge goes from the vertex in the next slot to that in the one after it.
  static constexpr int next_slot[] = {1, 2, 0};
  std::uint32_t& beginning_at(Index vertex) { return beginning_[vertex % beginning_.size()]; }

  template <int K>
  void hash_ridges(const CellStore<K>& cells, std::span<const HorizonFacet> facets, std::size_t first, std::size_t last);
  /// Links the triangles of a star along the cycle of its edges. Returns whether each vertex has an entry of its own; else the
  /// links are of no use.
  bool link_cycle(CellStore<2>& cells, std::span<const HorizonFacet> facets);

  /// Hashes all half-ridges and links the created cells of those that match. Returns how many of unmatched_ are left.
  template <int SumBits, class Entry, int K>
  std::uint32_t match_all(Entry* entries, std::size_t size, CellStore<K>& cells, std::span<const HorizonFacet> facets);
  /// The same for those that are left, round after round.
  template <int SumBits, class Entry, int K>
  std::span<const std::uint32_t> match_rest(Entry* entries, std::size_t size, std::uint32_t left, CellStore<K>& cells,
                                            std::span<const HorizonFacet> facets);
  std::uint32_t all_unmatched(std::size_t facets, int k);

  int rounds_;
  std::vector<std::uint32_t> narrow_;    // entries, all zero between calls: above how many selected it, below their sum
  std::vector<std::uint64_t> wide_;      // the same for stars that need the room, and for what is left of others
  GrowableArray<std::uint32_t> hashes_;  // of the ridges of all half-ridges
  GrowableArray<std::uint32_t> unmatched_;
  GrowableArray<Index> created_;
  std::array<std::uint32_t, 1024> beginning_{};  // which edge of a cycle begins at a vertex, by the low bits of its id
};

inline std::uint32_t RidgeTable::all_unmatched(std::size_t facets, int k) {
  std::uint32_t left = 0;
  for (std::uint32_t f = 0; f < facets; ++f)
    for (int j = 0; j < k; ++j) unmatched_[left++] = (f << facet_shift(k)) + static_cast<std::uint32_t>(j);
  return left;
}

template <int K>
std::span<const std::uint32_t> RidgeTable::link(CellStore<K>& cells, std::span<const HorizonFacet> facets) {
  const int k = cells.dimension();
  if (rounds_ == 0) return {unmatched_.data(), all_unmatched(facets.size(), k)};
  if constexpr (K == 2) {
    if (link_cycle(cells, facets)) return {};
    hash_ridges(cells, facets, 0, facets.size());
  }
  const std::size_t size = num_entries(facets.size(), k);
  if (fits(short_bits, facets.size(), k)) {
    const std::uint32_t left = match_all<short_bits>(narrow_.data(), size, cells, facets);
    return match_rest<short_bits>(narrow_.data(), size, left, cells, facets);
  }
  if (fits(narrow_bits, facets.size(), k)) {
    const std::uint32_t left = match_all<narrow_bits>(narrow_.data(), size, cells, facets);
    return match_rest<wide_bits>(wide_.data(), rest_size(size), left, cells, facets);
  }
  const std::uint32_t left = match_all<wide_bits>(wide_.data(), size, cells, facets);
  return match_rest<wide_bits>(wide_.data(), size, left, cells, facets);
}

template <int K>
void RidgeTable::hash_ridges(const CellStore<K>& cells, std::span<const HorizonFacet> facets, std::size_t first,
                             std::size_t last) {
  const auto k = static_cast<std::uint32_t>(cells.dimension());
  std::uint32_t* hash = hashes_.data() + (first << facet_shift(cells.dimension()));
  for (std::size_t f = first; f < last; ++f, hash += std::size_t{1} << facet_shift(cells.dimension())) {
    created_[f] = facets[f].created;
    const Index* vertices = cells.vertices(facets[f].created);
    const auto apex = static_cast<std::uint32_t>(facets[f].slot);
    std::uint32_t sum = 0;
    for (std::uint32_t i = 0; i <= k; ++i) sum += tag(vertices[i]);
    sum -= tag(vertices[apex]);
    // What is written for the apex is overwritten by the next.
    for (std::uint32_t i = 0; i <= k; ++i) hash[i - (i > apex)] = sum - tag(vertices[i]);
  }
}

inline bool RidgeTable::link_cycle(CellStore<2>& cells, std::span<const HorizonFacet> facets) {
  bool matched = true;
  for (const HorizonFacet& facet : facets) {
    const int begin = next_slot[facet.slot], end = next_slot[begin];
    const Index vertex = cells.vertices(facet.created)[end];
    const HorizonFacet& other = facets[beginning_at(vertex)];  // some edge begins here, so that the entry is of this star
    const int begin_of_other = next_slot[other.slot];
    matched &= cells.vertices(other.created)[begin_of_other] == vertex;
    cells.neighbors(facet.created)[begin] = other.created;
    cells.neighbors(other.created)[next_slot[begin_of_other]] = facet.created;
  }
  return matched;
}

template <int SumBits, class Entry, int K>
std::uint32_t RidgeTable::match_all(Entry* entries, std::size_t size, CellStore<K>& cells,
                                    std::span<const HorizonFacet> facets) {
  constexpr Entry one = Entry{1} << SumBits;
  const int k = cells.dimension();
  const std::uint32_t step = 1u << facet_shift(k);
  const int shift = 32 - (std::bit_width(size) - 1);
  const std::uint32_t* const hashes = hashes_.data();
  const Index* const created = created_.data();
  std::uint32_t* const unmatched = unmatched_.data();

  std::uint32_t left = 0;
  const auto last = static_cast<std::uint32_t>(facets.size()) * step;
  for (std::uint32_t first = 0; first < last; first += step)
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(k); ++j)
      entries[hashes[first + j] >> shift] += static_cast<Entry>(one + first + j);
  for (std::uint32_t f = 0, first = 0; first < last; ++f, first += step) {
    Index* neighbors = cells.neighbors(created[f]);
    const int apex = facets[f].slot;
    for (int j = 0; j < k; ++j) {
      const std::uint32_t half = first + static_cast<std::uint32_t>(j);
      const Entry entry = entries[hashes[half] >> shift];
      const bool matched = entry >> SumBits == 2;
      const std::uint32_t sum = static_cast<std::uint32_t>(entry - 2 * one);
      std::uint32_t other = matched ? sum - half : half;
      if constexpr (SumBits == narrow_bits) other = std::min(other, last - 1);  // what comes of a count that came round
      neighbors[slot(j, apex)] = created[facet(other, k)];
      unmatched[left] = half;
      left += !matched;
    }
  }
  if constexpr (SumBits == narrow_bits) {
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < size; ++i) {
      pairs += entries[i] >> SumBits == 2;
      entries[i] = 0;
    }
    if (2 * pairs + left != facets.size() * static_cast<std::size_t>(k)) return all_unmatched(facets.size(), k);
  } else if constexpr (std::is_same_v<Entry, std::uint32_t>) {  // it is in the cache, so that filling it is faster
    std::fill_n(entries, size, Entry{0});
  } else {
    for (std::uint32_t first = 0; first < last; first += step)
      for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(k); ++j) entries[hashes[first + j] >> shift] = 0;
  }
  return left;
}

template <int SumBits, class Entry, int K>
std::span<const std::uint32_t> RidgeTable::match_rest(Entry* entries, std::size_t size, std::uint32_t left, CellStore<K>& cells,
                                                      std::span<const HorizonFacet> facets) {
  constexpr Entry one = Entry{1} << SumBits;
  const int k = cells.dimension();
  const int shift = 32 - (std::bit_width(size) - 1);
  std::uint32_t* unmatched = unmatched_.data();
  std::uint32_t* spare = unmatched + unmatched_.capacity() / 2;
  std::uint32_t multiplier = 0x9e3779b9;
  for (int round = 1; round < rounds_ && left > 0; ++round, multiplier *= 0x85ebca6b) {
    const auto entry_of = [&](std::uint32_t half) -> Entry& { return entries[hashes_[half] * multiplier >> shift]; };
    const std::uint32_t count = std::exchange(left, 0u);
    for (std::uint32_t i = 0; i < count; ++i) entry_of(unmatched[i]) += static_cast<Entry>(one + unmatched[i]);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t half = unmatched[i];
      const Entry entry = entry_of(half);
      const bool matched = entry >> SumBits == 2;
      const std::uint32_t other = matched ? static_cast<std::uint32_t>(entry - 2 * one) - half : half;
      const std::uint32_t f = facet(half, k);
      cells.neighbors(created_[f])[slot(half, k, facets[f].slot)] = created_[facet(other, k)];
      spare[left] = half;
      left += !matched;
    }
    for (std::uint32_t i = 0; i < count; ++i) entry_of(unmatched[i]) = 0;
    std::swap(unmatched, spare);
  }
  return {unmatched, left};
}

}  // namespace delone::engine
