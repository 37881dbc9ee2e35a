// SPDX-License-Identifier: BSD-3-Clause
// What the floating-point filters of RegionClipper assume.
#pragma once

namespace delone::voronoi::clipper_limits {

/// The filter handles only boxes and planes in this range, where no product overflows and underflow stays
/// below 10⁻²⁹⁰.
inline constexpr double least_extent = 1e-80, largest_extent = 1e80, underflow = 1e-290;

}  // namespace delone::voronoi::clipper_limits
