// SPDX-License-Identifier: BSD-3-Clause
// Finds which cells of a new star share a ridge of the horizon, by hashing and without branches that depend on the data.
//
// A half-ridge is a ridge seen from one of its cells. The horizon is the boundary of a ball, so every ridge has exactly two
// half-ridges. Each adds itself and a count to the table entry that a hash of the ridge's vertex set selects. Both half-ridges
// of a ridge select the same entry; so an entry that exactly two have selected holds the two halves of one ridge: the sum less
// one half is the other, exactly, whatever the quality of the hash. Half-ridges in fuller entries are hashed anew, among
// themselves.
#pragma once

#include "engine/cell_store.hpp"
#include "growable_array.hpp"
#include "horizon_facet.hpp"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::engine {

class RidgeTable {
 public:
  /// Makes room for the star over `facets` facets of cells of dimension k. Throws std::bad_alloc.
  void reserve(std::size_t facets, int k) {
    const std::size_t halves = facets * static_cast<std::size_t>(k);
    if (halves > positions_.size()) {
      positions_.resize(2 * halves);
      unmatched_.resize(2 * halves + 1);
    }
    tags_.resize(static_cast<std::size_t>(k));
    if (entries_.size() < entries_per_half * halves) entries_.resize(std::bit_ceil(entries_per_half * halves), 0);
  }

  /// Links the created cells of all facets across their ridges. Returns the half-ridges that it could not match, which the
  /// caller must link: facet · 2^bits + j stands for the j-th slot other than that of the apex. REQUIRES reserve().
  template <int K>
  std::span<const std::uint32_t> link(CellStore<K>& cells, std::span<const HorizonFacet> facets);

  static int bits(int k) { return std::bit_width(static_cast<unsigned>(k - 1)); }
  /// The j-th slot other than that of the apex.
  static int slot(int j, int apex) { return j + (j >= apex ? 1 : 0); }

 private:
  static constexpr std::size_t entries_per_half = 4;
  static constexpr int largest_rounds = 6;
  static constexpr std::uint64_t one = std::uint64_t{1} << 32;

  /// Sums of tags are to be different for different sets of vertices, as a rule.
  static std::uint64_t tag(Index vertex) {
    std::uint64_t x = (static_cast<std::uint64_t>(vertex) + 1) * 0x9e3779b97f4a7c15;
    x ^= x >> 32;
    return x * 0xd6e8feb86659fd93;
  }

  template <int K>
  static std::uint64_t key(const CellStore<K>& cells, const HorizonFacet& facet, int j) {
    const int left_out = slot(j, facet.slot);
    std::uint64_t sum = 0;
    for (int i = 0; i <= cells.dimension(); ++i)
      if (i != facet.slot && i != left_out) sum += tag(cells.vertices(facet.created)[i]);
    return sum;
  }

  std::vector<std::uint64_t> entries_;    // all zero between calls: in the high half how many selected it, in the low half their sum
  std::vector<std::uint32_t> positions_;  // which entry each half-ridge selected
  std::vector<std::uint32_t> unmatched_;
  std::vector<std::uint64_t> tags_;  // of one cell, for dimensions chosen at run time
};

template <int K>
std::span<const std::uint32_t> RidgeTable::link(CellStore<K>& cells, std::span<const HorizonFacet> facets) {
  const int k = cells.dimension();
  const int shift = bits(k);
  const std::size_t halves = facets.size() * static_cast<std::size_t>(k);
  const int key_shift = 64 - std::bit_width(entries_per_half * halves - 1);
  std::uint64_t* const entries = entries_.data();
  std::uint64_t tags_of_compiled[K > 0 ? K : 1];
  std::uint64_t* const tags = K > 0 ? tags_of_compiled : tags_.data();

  std::uint32_t* position = positions_.data();
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const Index* vertices = cells.vertices(facets[f].created);
    const int apex = facets[f].slot;
    std::uint64_t total = 0;
    for (int j = 0; j < k; ++j) total += tags[j] = tag(vertices[slot(j, apex)]);
    const std::uint64_t first = one + (f << shift);
    for (int j = 0; j < k; ++j) {
      const auto at = static_cast<std::uint32_t>((total - tags[j]) >> key_shift);
      *position++ = at;
      entries[at] += first + static_cast<std::uint64_t>(j);
    }
  }
  position = positions_.data();
  std::size_t unmatched = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    Index* neighbors = cells.neighbors(facets[f].created);
    const int apex = facets[f].slot;
    for (int j = 0; j < k; ++j) {
      const std::uint64_t entry = entries[*position++];
      const auto half = static_cast<std::uint32_t>(f << shift) + static_cast<std::uint32_t>(j);
      const bool matched = entry >> 32 == 2;
      const std::uint32_t other = matched ? static_cast<std::uint32_t>(entry) - half : half;
      neighbors[slot(j, apex)] = facets[other >> shift].created;
      unmatched_[unmatched] = half;
      unmatched += !matched;
    }
  }
  for (std::size_t i = 0; i < halves; ++i) entries[positions_[i]] = 0;

  std::uint64_t multiplier = 0x9e3779b97f4a7c15;
  for (int round = 1; round < largest_rounds && unmatched > 0; ++round, multiplier *= 0xd6e8feb86659fd93) {
    const std::uint32_t mask = (std::uint32_t{1} << shift) - 1;
    for (std::size_t i = 0; i < unmatched; ++i) {
      const std::uint32_t half = unmatched_[i];
      const std::uint64_t hash = key(cells, facets[half >> shift], static_cast<int>(half & mask)) * multiplier;
      positions_[i] = static_cast<std::uint32_t>(hash >> key_shift);
      entries[positions_[i]] += one + half;
    }
    std::size_t left = 0;
    for (std::size_t i = 0; i < unmatched; ++i) {
      const std::uint32_t half = unmatched_[i];
      const HorizonFacet& facet = facets[half >> shift];
      const std::uint64_t entry = entries[positions_[i]];
      const bool matched = entry >> 32 == 2;
      const std::uint32_t other = matched ? static_cast<std::uint32_t>(entry) - half : half;
      cells.neighbors(facet.created)[slot(static_cast<int>(half & mask), facet.slot)] = facets[other >> shift].created;
      unmatched_[left] = half;
      left += !matched;
    }
    for (std::size_t i = 0; i < unmatched; ++i) entries[positions_[i]] = 0;
    unmatched = left;
  }
  return {unmatched_.data(), unmatched};
}

}  // namespace delone::engine
