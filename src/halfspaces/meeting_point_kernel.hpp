// SPDX-License-Identifier: BSD-3-Clause
// Common points of n hyperplanes in 2 to 5 dimensions: SIMD with one point per lane, for the best instruction
// set of the processor.
#pragma once

#include <cstddef>

namespace delone::internal {

/// The number of points per call.
inline constexpr std::size_t meeting_block = 32;

/// The range of dimensions.
inline constexpr std::size_t least_meeting_lanes = 2, most_meeting_lanes = 5;

/// The certified path of meeting_point() (halfspace_vertex.cpp) for meeting_block systems of n homogeneous
/// rows of n + 1 finite numbers. `rows`: entry j of row i of all systems starts at (i·(n + 1) +
/// j)·meeting_block. `points`: coordinate j starts at j·meeting_block. It is the nearest double where
/// `settled` is 1, and meaningless where `settled` is 0.
void find_meeting_points_in_lanes(std::size_t n, const double* rows, double* points, double* settled);

}  // namespace delone::internal
