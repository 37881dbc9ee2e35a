// SPDX-License-Identifier: BSD-3-Clause
// Corners of a box with sides parallel to the axes are on one sphere, around its center. Most ties of
// lattices are of this kind, whatever the rounding of their coordinates, and are decided here without
// arithmetic.
#pragma once

#include <numeric>
#include <optional>

namespace delone::kernel {

/// The value that coordinates of some points have besides `first`; `first` itself if there is none, nullopt
/// if there are more.
inline std::optional<double> other_value(const double* const* points, int count, int axis, double first) {
  double second = first;
  for (int i = 0; i < count; ++i) {
    const double x = points[i][axis];
    if (x == first || x == second) continue;
    if (second != first) return std::nullopt;
    second = x;
  }
  return second;
}

/// Whether q and some points are corners of one box.
inline bool are_corners_of_a_box(int ambient, const double* const* points, int count, const double* q) {
  for (int axis = 0; axis < ambient; ++axis)
    if (!other_value(points, count, axis, q[axis])) return false;
  return true;
}

/// Sets the center of the box, correctly rounded; false if there is none. The mean of two doubles has one
/// rounding: a sum in the normal range is halved exactly, and a smaller one is exact.
inline bool find_center_of_box(int ambient, const double* const* points, int count, double* center) {
  for (int axis = 0; axis < ambient; ++axis) {
    const double first = points[0][axis];
    const std::optional<double> other = other_value(points, count, axis, first);
    if (!other) return false;
    center[axis] = std::midpoint(first, *other) + 0.0;
  }
  return true;
}

}  // namespace delone::kernel
