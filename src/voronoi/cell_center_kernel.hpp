// SPDX-License-Identifier: BSD-3-Clause
// Centres of circumspheres and power spheres of full-dimensional cells in 2 to 5 dimensions, one cell per
// lane of the best instruction set of the machine.
#pragma once

#include <cstddef>

namespace delone::internal {

/// How many cells are treated together.
inline constexpr std::size_t center_block = 32;

/// The dimensions it is there for.
inline constexpr std::size_t least_center_lanes = 2, most_center_lanes = 5;

/// The certified path of CenterFinder (voronoi_center.cpp) for center_block cells of n+1 points in R^n.
/// `corners`: coordinate j of corner i of all cells from (i·n + j)·center_block on, finite; `weights`: that
/// of corner i from i·center_block on, or null for 0; `centers`: coordinate j from j·center_block on, each
/// the nearest double where `settled` holds 1, and of no meaning where it holds 0.
void find_centers_in_lanes(std::size_t n, const double* corners, const double* weights, double* centers,
                           double* settled);

}  // namespace delone::internal
