// SPDX-License-Identifier: BSD-3-Clause
// The certified path of CenterFinder: centers of circumspheres and power spheres, one at a time, or one per
// SIMD lane for the best instruction set of the processor. With a_i = p_i − p_0 and z = 2(c − p_0), the
// center c solves Σ_j a_ij·z_j = Σ_j a_ij² − (w_i − w_0), i = 1 … n.
#pragma once

#include <cstddef>
#include <span>

namespace delone::solve {

/// The number of cells per call.
inline constexpr std::size_t center_block = 32;

/// Cells of this many dimensions are solved one per SIMD lane; others one by one.
inline constexpr std::size_t least_center_lanes = 2, most_center_lanes = 5;

/// Of center_block cells of n+1 points in R^n. `corners`: coordinate j of corner i of all cells starts at
/// (i·n + j)·center_block, and all must be finite. `weights`: the weights of corner i start at
/// i·center_block; null for zero weights. `centers`: coordinate j starts at j·center_block. It is the nearest
/// double where `settled` is 1, and meaningless where `settled` is 0.
void find_centers_in_lanes(std::size_t n, const double* corners, const double* weights, double* centers,
                           double* settled);

/// The coordinates on the axes of the center of one cell with axes.size() + 1 points: the nearest doubles;
/// false if that is not settled. `weights` may be null.
bool find_center(std::span<const int> axes, const double* const* points, const double* weights,
                 double* center);

/// The same, less the first point and without weights, each coordinate within 5/4 of a unit roundoff of its
/// magnitude and 1/4 of one of the extent of the cell from its first point.
bool find_center_offset(std::span<const int> axes, const double* const* points, double* offset);

}  // namespace delone::solve
