// SPDX-License-Identifier: BSD-3-Clause
// What the construction of points that are spread evenly costs.
#pragma once

namespace delone::cost_model {

struct Cost {
  int affine_dimension = -1;
  double vertices = 0;
  double cells = 0, infinite_cells = 0, created_cells = 0;
  double bytes = 0;    ///< that the process needs at the peak, the points of the caller apart
  double seconds = 0;  ///< of one thread, on the machine of the measurements
  double beyond = 1;   ///< how many times as many vertices as the largest measured set has; at least 1
};

/// Beyond this dimension costs are continued, and rough.
inline constexpr int largest_measured_dimension = 8;

/// Points that are spread evenly over k dimensions, `vertices` of them distinct, with d coordinates each.
/// `wraps`: cells are wrapped where this costs less than to insert points. REQUIRES k ≥ 1.
Cost cost_of_spread(int k, int d, double points, double vertices, bool wraps);
/// Distinct points that are spread evenly over d dimensions.
inline Cost cost_of_spread(int d, double points) { return cost_of_spread(d, d, points, points, true); }

/// Bytes for `cells` cells in k dimensions, finite and infinite ones, and their points, as above.
double bytes_of(int k, int d, double points, double vertices, double cells, bool wraps);

/// Nanoseconds per created cell of the set by which the speed of a machine is measured (speed.hpp), on the
/// machine of the measurements.
inline constexpr double reference_nanoseconds = 74;

}  // namespace delone::cost_model
