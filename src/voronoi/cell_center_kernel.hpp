// SPDX-License-Identifier: BSD-3-Clause
// Centers of circumspheres and power spheres of full-dimensional cells in 2 to 5 dimensions: SIMD with one
// cell per lane, for the best instruction set of the processor.
#pragma once

#include <cstddef>

namespace delone::internal {

/// The number of cells per call.
inline constexpr std::size_t center_block = 32;

/// The range of dimensions.
inline constexpr std::size_t least_center_lanes = 2, most_center_lanes = 5;

/// The certified path of CenterFinder (cell_center.cpp) for center_block cells of n+1 points in R^n.
/// `corners`: coordinate j of corner i of all cells starts at (i·n + j)·center_block, and all must be finite.
/// `weights`: the weights of corner i start at i·center_block; null for zero weights. `centers`: coordinate j
/// starts at j·center_block. It is the nearest double where `settled` is 1, and meaningless where `settled`
/// is 0.
void find_centers_in_lanes(std::size_t n, const double* corners, const double* weights, double* centers,
                           double* settled);

}  // namespace delone::internal
