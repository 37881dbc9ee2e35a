// SPDX-License-Identifier: BSD-3-Clause
// The certified path of meeting_point(): common points of n hyperplanes, one at a time, or one per SIMD lane
// for the best instruction set of the processor.
#pragma once

#include <cstddef>
#include <span>

namespace delone::halfspaces {

/// The number of points per call.
inline constexpr std::size_t meeting_block = 32;

/// Points of this many dimensions are found one per SIMD lane; others one by one.
inline constexpr std::size_t least_meeting_lanes = 2, most_meeting_lanes = 5;

/// Of meeting_block systems of n homogeneous rows of n + 1 finite numbers. `rows`: entry j of row i of all
/// systems starts at (i·(n + 1) + j)·meeting_block. `points`: coordinate j starts at j·meeting_block. It is
/// the nearest double where `settled` is 1, and meaningless where `settled` is 0.
void find_meeting_points_in_lanes(std::size_t n, const double* rows, double* points, double* settled);

/// Of one system; false if it is not settled.
bool find_meeting_point(std::span<const double* const> rows, std::span<const int> columns, double* point);

}  // namespace delone::halfspaces
