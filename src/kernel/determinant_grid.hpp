// SPDX-License-Identifier: BSD-3-Clause
// The power-of-two grid that a determinant of differences of points lies on, perhaps with a column of lifts:
// the product of the grids of its columns (docs/predicates.md, "Zeros on a grid").
#pragma once

#include "kernel/flat.hpp"
#include "kernel/grid.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace delone::kernel {

/// Its exponent for all points of a set.
inline std::int64_t determinant_exponent(const Flat& flat, const Grid& grid, bool has_lifts) {
  std::int64_t sum = has_lifts ? grid.lift_exponent() : 0;
  for (const int axis : flat.axes) sum += grid.exponent(axis);
  return sum;
}

/// The same for `count` points and a base alone: not less than for a set that they are of.
inline std::int64_t determinant_exponent(const Flat& flat, const double* const* points, std::size_t count,
                                         const double* base, bool has_lifts) {
  const auto exponent = [&](int column) -> std::int64_t {
    int least = trailing_exponent(base[column]);
    for (std::size_t i = 0; i < count; ++i) least = std::min(least, trailing_exponent(points[i][column]));
    return least;
  };
  std::int64_t sum = 0;
  if (!has_lifts) {
    for (const int axis : flat.axes) sum += exponent(axis);
    return sum;
  }
  std::int64_t of_lifts = std::numeric_limits<int>::max();
  auto axis = flat.axes.begin();
  for (int j = 0; j < flat.ambient; ++j) {
    const std::int64_t of_column = exponent(j);
    of_lifts = std::min(of_lifts, 2 * of_column);
    if (axis != flat.axes.end() && *axis == j) {
      sum += of_column;
      ++axis;
    }
  }
  if (flat.weighted()) {
    const auto has_weight_of_base = [&](const double* p) { return p[flat.ambient] == base[flat.ambient]; };
    if (!std::all_of(points, points + count, has_weight_of_base))  // equal ones cancel
      of_lifts = std::min(of_lifts, exponent(flat.ambient));
  }
  return sum + of_lifts;
}

}  // namespace delone::kernel
