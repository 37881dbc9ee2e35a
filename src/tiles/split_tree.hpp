// SPDX-License-Identifier: BSD-3-Clause
// The cut into tiles: a k-d tree whose inner nodes compare positions with splitters.
#pragma once

#include "pages/cyclic_order.hpp"
#include "pages/pages.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::tiles {

using pages::Tile;

/// Which tile has a position: equal ones the same, by compare_along(). Plain arrays, which can be sent.
struct SplitTree {
  int dimension = 0;
  std::int32_t num_tiles = 1;
  /// Of each inner node, the first of which is the root.
  std::vector<std::int32_t> axes;
  std::vector<double> splitters;  ///< d numbers each
  std::vector<std::int32_t> below,
      beyond;  ///< a node, or −1 − t: tile t; `below` has what is before the splitter

  std::size_t tile_of(const double* point) const {
    if (axes.empty()) return 0;
    std::int32_t node = 0;
    while (node >= 0) {
      const auto n = static_cast<std::size_t>(node);
      const double* const splitter = splitters.data() + n * static_cast<std::size_t>(dimension);
      node = pages::compare_along(point, splitter, axes[n], dimension) < 0 ? below[n] : beyond[n];
    }
    return static_cast<std::size_t>(-1 - node);
  }
  /// The closed boxes of all tiles, without pages: no point of another tile is strictly inside.
  std::vector<Tile> boxes() const;
};

/// Cuts into `num_tiles` tiles of about equal numbers of points: T tiles in ⌊T/2⌋ and ⌈T/2⌉ at that quantile
/// of the sample, along the longest side of its box. Rows of d coordinates. Fewer tiles if the sample has
/// fewer distinct positions, so that each has a point of the sample. O(n log n · log T).
SplitTree make_split_tree(std::span<const double> sample, int dimension, std::size_t num_tiles);

}  // namespace delone::tiles
