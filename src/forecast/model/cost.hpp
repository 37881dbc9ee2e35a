// SPDX-License-Identifier: BSD-3-Clause
// What a construction costs according to a curve.
#pragma once

#include "forecast/model/curves.hpp"

#include <string_view>

namespace delone::cost_model {

struct Cost {
  int affine_dimension = -1;
  double vertices = 0;
  double cells = 0, infinite_cells = 0, created_cells = 0;
  double bytes = 0;    ///< that the process needs at the peak, the points of the caller apart
  double seconds = 0;  ///< of one thread, on the machine of the measurements
};

/// A curve for point sets spread evenly in any dimension; beyond 8 it is continued from there.
Curve curve_of_spread(int dimension);
/// The curve of a kind in a dimension; nothing where none was measured.
const Curve* find_curve(std::string_view kind, int dimension);

/// Points whose distinct ones are `vertices`, in d coordinates each. `hull_volume`: of lattices, in boxes; 0:
/// that of a grid with equal sides.
Cost cost_of(const Curve& curve, int d, double points, double vertices, double hull_volume = 0);
/// Points spread evenly in d dimensions, `speed` times as fast as the machine of the measurements.
Cost cost_of_spread(int d, double points, double speed);

/// Whether so many points of k dimensions are wrapped, unless that fails.
bool is_worth_wrapping(int k, double points);

/// The number of distinct points among n of a kind.
double distinct_points(std::string_view kind, int d, double n);

}  // namespace delone::cost_model
