// SPDX-License-Identifier: BSD-3-Clause
// The points of one tile.
#pragma once

#include "tiles/duplicates.hpp"

#include <cstdint>
#include <vector>

namespace delone::tiles {

/// In the order of its pages.
struct TilePoints {
  std::vector<double> points;      ///< distinct: coordinates, and weights where points have them
  std::vector<std::int64_t> rows;  ///< of the input: the first equal one
  std::vector<Duplicate> duplicates;
};

}  // namespace delone::tiles
