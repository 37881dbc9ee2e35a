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
  double factor = 1;   ///< by which the number of cells may be wrong
};

/// Up to this dimension each has constants of its own; beyond, all have the same, from 6 to 20 dimensions.
inline constexpr int largest_measured_dimension = 8;

/// Points that are spread evenly over k dimensions, `vertices` of them distinct, with d coordinates each.
/// `wraps`: cells are wrapped where this costs less than to insert points. REQUIRES k ≥ 1.
Cost cost_of_spread(int k, int d, double points, double vertices, bool wraps);
/// Distinct points that are spread evenly over d dimensions.
inline Cost cost_of_spread(int d, double points) { return cost_of_spread(d, d, points, points, true); }

/// Bytes for `cells` cells in k dimensions, finite and infinite ones, and their points, as above.
double bytes_of(int k, int d, double points, double vertices, double cells, bool wraps);

/// How many times as fast so many threads build; 1 for one.
double speedup(unsigned threads);

/// Nanoseconds per created cell of the set by which the speed of a machine is measured (speed.hpp), on the
/// machine of the measurements.
inline constexpr double reference_nanoseconds = 74;

}  // namespace delone::cost_model
