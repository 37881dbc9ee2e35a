// SPDX-License-Identifier: BSD-3-Clause
// The predicates: each a chain of stages, direct_ → exact_ → perturbed_. The filter_ stage before them belongs to the cells
// (geometry/). K is the dimension of the flat, or 0 when it is chosen at run time.
#pragma once

#include "kernel/direct.hpp"
#include "kernel/exact.hpp"
#include "kernel/flat.hpp"
#include "kernel/grid.hpp"
#include "stage_counts.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace delone::kernel {

/// Whether two points of R^ambient are equal (−0 equals +0).
inline bool equal_points(const double* p, const double* q, int ambient) {
  for (int j = 0; j < ambient; ++j)
    if (p[j] != q[j]) return false;
  return true;
}

/// The order behind the perturbation: lexicographic on all coordinates. A total order on distinct points.
inline bool lexicographically_less(const double* p, const double* q, int ambient) {
  return std::lexicographical_compare(p, p + ambient, q, q + ambient);
}

/// The sign of det(p_1 − p_0, …, p_k − p_0) on the axes of the flat.
template <int K>
Sign orientation(const Flat& flat, const double* const* points, const Grid& grid, StageCounts& counts) {
  if (const auto sign = direct_orientation<K>(flat, points + 1, points[0], grid)) {
    ++counts.direct;
    return *sign;
  }
  ++counts.exact;
  return exact_orientation(flat, points + 1, points[0]);
}

template <int K>
Sign orientation(const Flat& flat, const double* const* points, const Grid& grid) {
  StageCounts uncounted;
  return orientation<K>(flat, points, grid, uncounted);
}

/// The position of q relative to the sphere through k+1 positively oriented points: − inside, 0 on it, + outside.
/// The lifted points are coplanar with q when det(p_i − q, |p_i − q|²) = 0, and for a positively oriented simplex its sign
/// times (−1)^(k+1) is the sign of |q − c|² − r² (docs/predicates.md, "Signs").
template <int K>
Sign in_sphere(const Flat& flat, const double* const* points, const double* q, const Grid& grid, StageCounts& counts) {
  Sign sign;
  if (const auto direct = direct_sphere<K>(flat, points, q, grid)) {
    sign = *direct;
    ++counts.direct;
  } else {
    sign = exact_sphere(flat, points, q);
    ++counts.exact;
  }
  return flat.dimension() % 2 == 0 ? -sign : sign;
}

/// The tie-break of Devillers and Teillaud (2011, doi:10.1016/j.comgeo.2010.09.010) for a q exactly on the sphere of k+1
/// positively oriented points: every point is lifted by its own infinitesimal, larger for lexicographically larger points.
/// The first point, from the largest down, whose lifting moves q off the sphere decides:
///   q itself: lifted out of the sphere, +;   p_i: the sphere at q rises by ε_i times the barycentric coordinate of q at p_i.
/// Never 0. REQUIRES that q is none of the points.
template <int K>
Sign perturbed_in_sphere(const Flat& flat, const double* const* points, const double* q, const Grid& grid) {
  const int k = K > 0 ? K : flat.dimension();
  Buffer<int, K + (K > 0)> order(static_cast<std::size_t>(k + 1));
  Buffer<const double*, K + (K > 0)> moved(static_cast<std::size_t>(k + 1));
  int larger = 0;  // the points lexicographically larger than q, in decreasing order: only these can decide before q does
  for (int i = 0; i <= k; ++i) {
    moved[static_cast<std::size_t>(i)] = points[i];
    if (!lexicographically_less(q, points[i], flat.ambient)) continue;
    int rank = larger++;
    for (; rank > 0 && lexicographically_less(points[order[static_cast<std::size_t>(rank - 1)]], points[i], flat.ambient);
         --rank)
      order[static_cast<std::size_t>(rank)] = order[static_cast<std::size_t>(rank - 1)];
    order[static_cast<std::size_t>(rank)] = i;
  }
  for (int rank = 0; rank < larger; ++rank) {
    const auto i = static_cast<std::size_t>(order[static_cast<std::size_t>(rank)]);
    moved[i] = q;
    const Sign barycentric = orientation<K>(flat, moved.data(), grid);
    moved[i] = points[i];
    if (barycentric != Sign::zero) return -barycentric;
  }
  return Sign::positive;
}

}  // namespace delone::kernel
