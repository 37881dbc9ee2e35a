// SPDX-License-Identifier: BSD-3-Clause
// The dimensions that products take.
#pragma once

namespace delone::internal {

/// Some arrays have as many entries as the space has dimensions, whatever the number of points.
inline constexpr int largest_dimension = 1 << 20;

/// Throws Errc::bad_dimension unless 1 ≤ dimension ≤ largest_dimension.
void require_dimension(int dimension);

}  // namespace delone::internal
