// SPDX-License-Identifier: BSD-3-Clause
// The predicates of hulls for facets in the hyperplane of a coordinate, as walls and floors mostly are. What
// lies on it is seen by comparison, and determinants are smaller by one row.
#pragma once

#include "kernel/hull_stages.hpp"

#include <algorithm>
#include <cstddef>

namespace delone::kernel {

inline constexpr int no_axis = -1;

/// The number r of an axis of the flat on which q and all rows of a facet have the same coordinate, whose
/// hyperplane is that of the facet then; or no_axis. `row`: row i of the facet.
template <class Row>
int common_axis(const Flat& flat, const double* q, Row row) {
  if (flat.form == RowForm::homogeneous) return no_axis;
  const int k = flat.dimension();
  for (int r = 0; r < k; ++r) {
    const int axis = flat.axes[static_cast<std::size_t>(r)];
    int i = 0;
    while (i < k && row(i)[axis] == q[axis]) ++i;
    if (i == k) return r;
  }
  return no_axis;
}

/// hull_side() of k rows that have the same coordinate on axis r of the flat, and of a point o that has
/// another one there. The first row is subtracted from the others: then the determinant is that of the others
/// without this column, times (−1)^r and the difference of the first row and o in it.
template <int K>
Sign side_off_coordinate_plane(const Flat& flat, const double* const* rows, int r, const double* o,
                               const Grid& grid) {
  constexpr int N = K > 0 ? K - 1 : 0;
  const std::size_t n = flat.axes.size() - 1;
  Buffer<int, N> others(n);
  for (std::size_t j = 0; j < n; ++j) others[j] = flat.axes[j + (j >= static_cast<std::size_t>(r))];
  const Sign sign = orientation<N>({flat.ambient, {others.data(), n}, flat.form}, rows, grid);
  const int axis = flat.axes[static_cast<std::size_t>(r)];
  return (o[axis] < rows[0][axis]) == (r % 2 == 0) ? sign : -sign;
}

/// perturbed_hull_side() of a facet in the hyperplane of coordinate r, which q is on, and a point o inside.
template <int K>
Sign perturbed_side_in_coordinate_plane(const Flat& flat, const double* const* facet, const double* q, int r,
                                        const double* o, const Grid& grid) {
  const int k = K > 0 ? K : flat.dimension();
  const auto side = [&](const double* const* moved) {
    return side_off_coordinate_plane<K>(flat, moved, r, o, grid);
  };
  // The largest row decides, unless that is q or q is on a hyperplane through the others.
  int largest = 0;
  for (int i = 1; i < k; ++i)
    if (lexicographically_less(facet[largest], facet[i], flat.ambient)) largest = i;
  if (lexicographically_less(facet[largest], q, flat.ambient)) return Sign::positive;
  Buffer<const double*, K> moved(static_cast<std::size_t>(k));
  std::copy_n(facet, k, moved.data());
  moved[static_cast<std::size_t>(largest)] = q;
  if (const Sign coefficient = side(moved.data()); coefficient != Sign::zero) return -coefficient;
  return largest_point_decides<K>(facet, k, q, flat.ambient, grid, side);
}

}  // namespace delone::kernel
