// SPDX-License-Identifier: BSD-3-Clause
// Dual points in pairs of doubles: one at a time, or one per SIMD lane for the best instruction set of the
// processor.
#pragma once

#include <cstddef>
#include <span>

namespace delone::halfspaces {

/// The number of rows per call.
inline constexpr std::size_t dual_block = 32;

/// The dual points of dual_block homogeneous rows of d + 1 finite numbers, seen from a point p of doubles.
/// `rows`: entry j of all rows starts at j·dual_block. `duals`: the leading parts on axis j start at
/// j·dual_block, the remainders at (k + j)·dual_block for k axes. They are as those of dual_point() where
/// `settled` is 1, and meaningless where it is 0, because of cancellation or the range of doubles.
void find_duals_in_lanes(const double* rows, std::span<const double> p, std::span<const int> axes,
                         double* duals, double* settled);

/// The dual point of one row; false if it is not settled.
bool find_dual(const double* row, std::span<const double> p, std::span<const int> axes, double* dual);

}  // namespace delone::halfspaces
