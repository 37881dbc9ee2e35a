// SPDX-License-Identifier: BSD-3-Clause
// Where walks to points that come in no order start: a vertex close by, found in a digital search tree
// (Coffman and Eve 1970, doi:10.1145/362686.362693) of cubes, each half as wide as the one around it. A
// vertex is filed under the largest of the cubes around it that has none yet. All cubes are in one table,
// found by hashing (Warren and Salmon 1993, doi:10.1145/169627.169640), so that looking for the smallest one
// that is known begins where most searches end.
#pragma once

#include "geometry/frame.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::internal {

/// A search expects one or two misses of the cache where points are evenly spread, and the logarithm of the
/// number of levels in any case. Takes 16 to 32 bytes for each vertex. A wrong answer costs time and nothing
/// else, so two cubes may have one key.
class Landmarks {
 public:
  /// For points in the box of the frame; others count as on its border.
  Landmarks(const geometry::Frame& frame, std::size_t dimension);

  /// Adds a vertex, unless all cubes around its point have one. Throws std::bad_alloc, and then changes
  /// nothing.
  void add(Index vertex, const double* point);

  /// A vertex that accept(vertex) is true for, close to the point as a rule; invalid_index if there is none
  /// around it.
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
  /// The level of the smallest cubes, if the one around all points is level 0: below, they could not be told
  /// apart.
  static constexpr int smallest = 52;
  static constexpr std::size_t most = std::size_t{1} << 31;  // half of what 32 bits can tell apart

  /// Of the cube of a level that the point is in.
  std::uint32_t key(const double* point, int level) const;
  std::size_t home(std::uint32_t key) const { return key >> (32 - log2_capacity_); }
  Index find(std::uint32_t key) const;
  /// The level of the smallest cube around the point that has a vertex; −1 if none has.
  int deepest(const double* point) const;
  void put(Entry entry);
  void grow();

  std::vector<double> low_;
  double scale_;  // from half a distance to the smallest cubes it spans
  int log2_capacity_ = 10;
  std::vector<Entry> table_;
  std::size_t size_ = 0;
  int typical_ = 0;  // the median of the levels so far: searches begin there
};

}  // namespace delone::internal
