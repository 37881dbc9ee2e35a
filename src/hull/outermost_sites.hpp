// SPDX-License-Identifier: BSD-3-Clause
// Sites to begin a hull with: those farthest out in some directions. Their hull has few cells and holds most
// of the points of many inputs, which it shows to be interior points at the cost of a short walk each, before
// they are sorted.
#pragma once

#include "compiled/simplicial_hull.hpp"

#include <delone/types.hpp>

#include <vector>

namespace delone::internal {

/// Of the sites from `first` on, in the order of their being found, those with the least and the greatest
/// value in the directions of the axes and, in at most 5 dimensions, of all diagonals of the box of the
/// sites. From 6 dimensions on, few sites hold little of the volume. What is chosen is a matter of speed
/// only. O(n·2^d·d), d ≤ 5, else O(n·d).
std::vector<Index> outermost_sites(const HullSites& sites, Index first);

}  // namespace delone::internal
