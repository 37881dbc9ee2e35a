// SPDX-License-Identifier: BSD-3-Clause
// A few hundred or thousand points, each the farthest from those before it (Gonzalez 1985,
// doi:10.1016/0304-3975(85)90224-5), several compared per instruction; compiled for several instruction sets,
// of which the best that the machine has is chosen at run time, and all of which choose the same points.
#pragma once

#include <delone/types.hpp>

#include <hwy/aligned_allocator.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace delone::order {

/// Distances are Euclidean ones of rounded coordinates. Where the extent of the points is 0 or not finite,
/// all are.
class FarthestFirst {
 public:
  /// For up to `most` rows of `dimension` coordinates. Throws std::bad_alloc.
  FarthestFirst(int dimension, std::size_t most);

  /// Chooses as many of the rows as `chosen` has room for, and writes their places among them. The first is
  /// at `start`; of rows that are as far the first is chosen. REQUIRES start < rows.size() ≤ most, and no
  /// more to be chosen than there are. Cost O(rows · chosen · dimension).
  void choose(PointsView points, std::span<const Index> rows, std::size_t start,
              std::span<std::uint32_t> chosen);

 private:
  void load(PointsView points, std::span<const Index> rows);

  std::size_t dimension_, stride_;
  hwy::AlignedFreeUniquePtr<float[]> coordinates_;  // between 0 and 1, those of each axis side by side
  hwy::AlignedFreeUniquePtr<float[]>
      distances_;  // squares, to the nearest that is chosen; −1: is chosen itself, or no row
};

}  // namespace delone::order
