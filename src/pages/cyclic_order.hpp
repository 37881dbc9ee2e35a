// SPDX-License-Identifier: BSD-3-Clause
// The order of positions along an axis, in which only equal positions are tied.
#pragma once

namespace delone::pages {

/// Negative, zero or positive as a is before, at or after b: lexicographically by the coordinates axis,
/// axis + 1, … d − 1, 0, … axis − 1. −0 and +0 are equal. So a lattice can be cut within a plane, and equal
/// points are never parted.
inline int compare_along(const double* a, const double* b, int axis, int dimension) {
  if (a[axis] != b[axis]) return a[axis] < b[axis] ? -1 : 1;
  for (int i = 1; i < dimension; ++i) {
    const int other = axis + i < dimension ? axis + i : axis + i - dimension;
    if (a[other] != b[other]) return a[other] < b[other] ? -1 : 1;
  }
  return 0;
}

/// The axis along which a box is longest, the first of several.
inline int longest_axis(const double* low, const double* high, int dimension) {
  int longest = 0;
  double length = -1;
  for (int axis = 0; axis < dimension; ++axis)
    // Halves, as the difference may be beyond the largest double.
    if (const double side = high[axis] / 2 - low[axis] / 2; side > length) {
      length = side;
      longest = axis;
    }
  return longest;
}

}  // namespace delone::pages
