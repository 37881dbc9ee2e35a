// SPDX-License-Identifier: BSD-3-Clause
// Start vertices for walks to points in arbitrary order: a digital search tree (Coffman and Eve 1970,
// doi:10.1145/362686.362693) of nested cubes, each half as wide as the one around it. A vertex is stored in
// the largest of its cubes that has none yet. All cubes share one hash table (Warren and Salmon 1993,
// doi:10.1145/169627.169640), so a search can begin at the level where most searches end.
#pragma once

#include "geometry/frame.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::construction {

/// For evenly spread points a search costs one or two cache misses, and for any points at most the logarithm
/// of the number of levels. Memory: 16 to 32 bytes per vertex. A wrong answer only costs time, so two cubes
/// may share a key.
class Landmarks {
 public:
  /// For points in the box of the frame. Points outside are treated as if they were on its boundary.
  Landmarks(const geometry::Frame& frame, std::size_t dimension);

  /// Adds a vertex, unless all cubes around its point have one. Strong guarantee: throws std::bad_alloc or
  /// succeeds.
  void add(Index vertex, const double* point);

  /// A vertex, usually near the point, for which accept(vertex) is true; invalid_index if no cube around the
  /// point has one.
  template <class Accept>
  Index near(const double* point, Accept&& accept) const {
    for (int level = deepest(point); level >= 0; --level)
      if (const Index vertex = find(key(point, level)); vertex != none && accept(vertex)) return vertex;
    return invalid_index;
  }

 private:
  struct Entry {
    std::uint32_t key;
    Index vertex;
  };
  static constexpr Index none = index(infinite_vertex);
  /// The level of the smallest cubes; level 0 is the cube around all points. Coordinates cannot tell smaller
  /// cubes apart.
  static constexpr int smallest = 52;
  static constexpr std::size_t most = std::size_t{1} << 31;  // half of all 32-bit keys

  /// The key of the cube of a level that contains the point.
  std::uint32_t key(const double* point, int level) const;
  std::size_t home(std::uint32_t key) const { return key >> (32 - log2_capacity_); }
  Index find(std::uint32_t key) const;
  /// The level of the smallest cube around the point that has a vertex; −1 if there is none.
  int deepest(const double* point) const;
  void put(Entry entry);
  void grow();

  std::vector<double> low_;
  double scale_;  // half a distance, times this, counts smallest cubes
  int log2_capacity_ = 10;
  std::vector<Entry> table_;
  std::size_t size_ = 0;
  int typical_ = 0;  // tracks the median of the levels so far: searches begin there
};

}  // namespace delone::construction
