// SPDX-License-Identifier: BSD-3-Clause
// The sites to start a hull with: the extremes in a few directions. Their hull has few cells and contains
// most points of many inputs. A short walk proves these to be interior, before the rest is sorted.
#pragma once

#include "compiled/simplicial_hull.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <vector>

namespace delone::hull {

/// In higher dimensions the diagonals of a box are too many to be looked at.
inline constexpr std::size_t most_axes_with_diagonals = 5;

/// Among the sites from `first` on, those with the smallest and largest value along each axis and, in at most
/// most_axes_with_diagonals dimensions, along each diagonal of the bounding box; without repetition. In
/// higher dimensions so few sites span little of the volume, and diagonals are not used. The choice affects
/// speed only. O(n·2^d) for d ≤ 5, else O(n·d).
std::vector<Index> outermost_sites(const sites::BoundarySites& sites, Index first);

}  // namespace delone::hull
