// SPDX-License-Identifier: BSD-3-Clause
// Circumcentres of triangles in the plane and tetrahedra in space, one cell per lane of the best instruction set of the
// machine.
#pragma once

#include <cstddef>

namespace delone::front_ends {

/// How many cells are treated together.
inline constexpr std::size_t center_block = 32;

/// The certified path of CenterFinder (voronoi_center.cpp) for center_block cells of n+1 points without weights in R^n, n = 2
/// or 3. `corners`: coordinate j of corner i of all cells from (i·n + j)·center_block on, finite; `centers`: coordinate j from
/// j·center_block on, each the nearest double where `settled` holds 1, and of no meaning where it holds 0.
void find_centers_in_lanes(std::size_t n, const double* corners, double* centers, double* settled);

}  // namespace delone::front_ends
