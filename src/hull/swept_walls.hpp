// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a hull with many more sites on its walls, all at once.
#pragma once

#include "compiled/simplicial_hull.hpp"
#include "hull/hull_state.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace delone::hull {

/// The cells that a boundary has with some sites more, none of which is outside.
struct SweptWalls {
  SimplicialHull hull;          ///< without slots
  std::vector<Index> planes;    ///< for each cell the slot of a present one in the same hyperplane
  std::vector<char> is_inside;  ///< by site: whether one of those more is strictly inside
};

/// Sweeps all walls (sweep_wall()) with sites on them, and leaves the cells of the others. Nothing, if a
/// sample says that few of the sites are on walls. `sites`: none beyond the hull, and none of them inserted.
/// `tick` is told often how many sites are done, and may throw.
std::optional<SweptWalls> sweep_walls(const HullState& hull, std::span<const Index> sites,
                                      const std::function<void(std::size_t)>& tick);

}  // namespace delone::hull
