// SPDX-License-Identifier: BSD-3-Clause
// A few hundred or thousand points, each the farthest from those before it (Gonzalez 1985,
// doi:10.1016/0304-3975(85)90224-5), several compared per instruction. Compiled for several instruction sets,
// which all choose the same points; the best one of the machine is chosen at run time.
#pragma once

#include <delone/types.hpp>

#include <hwy/aligned_allocator.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace delone::order {

/// Distances are Euclidean, of rounded coordinates; all are 0 if the extent of the points is 0 or not finite.
class FarthestFirst {
 public:
  /// For up to `most` rows of `dimension` coordinates. Throws std::bad_alloc.
  FarthestFirst(int dimension, std::size_t most);

  /// Chooses as many of the rows as `chosen` has room for, and writes their places among them. The first is
  /// at `start`; of rows at the same distance the first one is chosen. REQUIRES chosen.size() ≤ rows.size()
  /// and start < rows.size() ≤ most. Cost O(rows · chosen · dimension); `stop` is called now and then, and
  /// may throw.
  void choose(PointsView points, std::span<const Index> rows, std::size_t start,
              std::span<std::uint32_t> chosen, const std::function<void()>& stop = {});

 private:
  void load(PointsView points, std::span<const Index> rows);

  std::size_t dimension_, stride_;
  hwy::AlignedFreeUniquePtr<float[]> coordinates_;  // scaled to an extent of at most 1, axis by axis
  // Squared, to the nearest chosen row; −1 for chosen rows and for entries that are no row.
  hwy::AlignedFreeUniquePtr<float[]> distances_;
};

}  // namespace delone::order
