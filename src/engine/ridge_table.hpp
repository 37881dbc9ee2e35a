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

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace delone::engine {

class RidgeTable {
 public:
  /// `rounds`: how often half-ridges are hashed before the caller has to link them by other means.
  explicit RidgeTable(int rounds = 6) : rounds_(rounds) {}

  /// Makes room for the star over `facets` facets of cells of dimension k. Throws std::bad_alloc.
  void reserve(std::size_t facets, int k) {
    const std::size_t halves = facets * static_cast<std::size_t>(k);
    if (halves >= hashes_.size()) {
      hashes_.resize(2 * halves + 1);
      unmatched_.resize(4 * halves + 2);
    }
    if (created_.size() < facets) created_.resize(2 * facets);
    const std::size_t entries = std::bit_ceil(entries_per_half * std::max<std::size_t>(halves, 1));
    if (entries_.size() < entries) entries_.resize(entries, 0);
  }

  /// Links the created cells of all facets across their ridges. Returns the half-ridges that it could not match, which the
  /// caller must link. REQUIRES reserve().
  template <int K>
  std::span<const std::uint32_t> link(CellStore<K>& cells, std::span<const HorizonFacet> facets);

  /// A half-ridge is numbered facet · k + j for the j-th slot other than that of the apex.
  static int slot(int j, int apex) { return j + (j >= apex ? 1 : 0); }

 private:
  static constexpr std::size_t entries_per_half = 2;
  static constexpr std::uint64_t one = std::uint64_t{1} << 32;

  /// Sums of tags are to be different for different sets of vertices, as a rule.
  static std::uint64_t tag(Index vertex) {
    std::uint64_t x = (static_cast<std::uint64_t>(vertex) + 1) * 0x9e3779b97f4a7c15;
    x ^= x >> 32;
    return x * 0xd6e8feb86659fd93;
  }

  int rounds_;
  std::vector<std::uint64_t>
      entries_;  // all zero between calls: in the high half how many selected it, in the low half their sum
  std::vector<std::uint32_t> hashes_;  // of the ridges of all half-ridges
  std::vector<std::uint32_t> unmatched_;
  std::vector<Index> created_;
};

template <int K>
std::span<const std::uint32_t> RidgeTable::link(CellStore<K>& cells, std::span<const HorizonFacet> facets) {
  const auto k = static_cast<std::uint32_t>(cells.dimension());
  const auto halves = static_cast<std::uint32_t>(facets.size()) * k;
  const int shift = 32 - (std::bit_width(std::bit_ceil(entries_per_half * std::max<std::size_t>(halves, 1))) - 1);
  std::uint64_t* const entries = entries_.data();
  Index* const created = created_.data();
  std::uint32_t* unmatched = unmatched_.data();
  std::uint32_t* spare = unmatched + halves + 1;

  std::uint32_t* hash = hashes_.data();
  for (std::size_t f = 0; f < facets.size(); ++f, hash += k) {
    created[f] = facets[f].created;
    const Index* vertices = cells.vertices(created[f]);
    const auto apex = static_cast<std::uint32_t>(facets[f].slot);
    std::uint64_t sum = 0;
    for (std::uint32_t i = 0; i <= k; ++i) sum += tag(vertices[i]);
    sum -= tag(vertices[apex]);
    // What is written for the apex is overwritten by the next.
    for (std::uint32_t i = 0; i <= k; ++i) hash[i - (i > apex)] = static_cast<std::uint32_t>((sum - tag(vertices[i])) >> 32);
  }

  if (rounds_ == 0) {
    std::iota(unmatched, unmatched + halves, 0u);
    return {unmatched, halves};
  }

  std::uint32_t left = 0;
  for (std::uint32_t half = 0; half < halves; ++half) entries[hashes_[half] >> shift] += one + half;
  hash = hashes_.data();
  for (std::uint32_t f = 0, half = 0; f < facets.size(); ++f) {
    Index* neighbors = cells.neighbors(created[f]);
    const int apex = facets[f].slot;
    for (std::uint32_t j = 0; j < k; ++j, ++half) {
      const std::uint64_t entry = entries[hash[half] >> shift];
      const bool matched = entry >> 32 == 2;
      const std::uint32_t other = matched ? static_cast<std::uint32_t>(entry) - half : half;
      neighbors[slot(static_cast<int>(j), apex)] = created[other / k];
      unmatched[left] = half;
      left += !matched;
    }
  }
  for (std::uint32_t half = 0; half < halves; ++half) entries[hashes_[half] >> shift] = 0;

  std::uint32_t multiplier = 0x9e3779b9;
  for (int round = 1; round < rounds_ && left > 0; ++round, multiplier *= 0x85ebca6b) {
    const std::uint32_t count = std::exchange(left, 0u);
    for (std::uint32_t i = 0; i < count; ++i) entries[hashes_[unmatched[i]] * multiplier >> shift] += one + unmatched[i];
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t half = unmatched[i];
      const std::uint64_t entry = entries[hashes_[half] * multiplier >> shift];
      const bool matched = entry >> 32 == 2;
      const std::uint32_t other = matched ? static_cast<std::uint32_t>(entry) - half : half;
      cells.neighbors(created[half / k])[slot(static_cast<int>(half % k), facets[half / k].slot)] = created[other / k];
      spare[left] = half;
      left += !matched;
    }
    for (std::uint32_t i = 0; i < count; ++i) entries[hashes_[unmatched[i]] * multiplier >> shift] = 0;
    std::swap(unmatched, spare);
  }
  return {unmatched, left};
}

}  // namespace delone::engine
