// SPDX-License-Identifier: BSD-3-Clause
// Records that begin with the same key, among those of a bucket: facets and ridges by their vertices.
#pragma once

#include "base/random.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::tiles {

/// Equal keys have equal hashes.
inline std::uint64_t hash_of_key(std::span<const std::int64_t> key) {
  std::uint64_t hash = 0;
  for (const std::int64_t word : key)
    hash = random::mix(hash + 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(word));
  return hash;
}

/// The bucket of a key among so many, by the lowest bits of its hash.
inline std::size_t bucket_of_key(std::span<const std::int64_t> key, std::size_t buckets) {
  return static_cast<std::size_t>((hash_of_key(key) & 0xffffffffu) * buckets >> 32);
}

/// Calls each(records) for the records of every key, as numbers of records, increasing. A record is `size`
/// words, of which the first `key_size` are its key. Takes 24 bytes per record; O(records · log).
template <class Each>
void for_equal_records(std::span<const std::int64_t> words, std::size_t size, std::size_t key_size,
                       const Each& each) {
  struct Entry {
    std::uint64_t hash;
    std::size_t record;
  };
  const std::size_t count = words.size() / size;
  std::vector<Entry> entries(count);
  for (std::size_t i = 0; i < count; ++i) entries[i] = {hash_of_key(words.subspan(i * size, key_size)), i};
  const auto key = [&](const Entry& entry) { return words.begin() + entry.record * size; };
  std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
    if (a.hash != b.hash) return a.hash < b.hash;
    const auto end = key(a) + key_size;
    const auto [first, second] = std::mismatch(key(a), end, key(b));
    return first != end ? *first < *second : a.record < b.record;
  });
  std::vector<std::size_t> equal;
  for (std::size_t i = 0; i < count;) {
    const std::size_t first = i;
    equal.clear();
    while (i < count && entries[i].hash == entries[first].hash &&
           std::equal(key(entries[i]), key(entries[i]) + key_size, key(entries[first])))
      equal.push_back(entries[i++].record);
    each(std::span<const std::size_t>(equal));
  }
}

}  // namespace delone::tiles
