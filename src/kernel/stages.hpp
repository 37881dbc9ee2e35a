// SPDX-License-Identifier: BSD-3-Clause
// The predicates: each a chain of stages, direct_ → exact_ → perturbed_. The filter_ stage before them
// belongs to the cells (geometry/). K is the dimension of the flat, or 0 when it is chosen at run time.
#pragma once

#include "base/stage_counts.hpp"
#include "kernel/direct.hpp"
#include "kernel/exact.hpp"
#include "kernel/flat.hpp"
#include "kernel/grid.hpp"
#include "kernel/small_differences.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <functional>
#include <type_traits>
#include <utility>

namespace delone::kernel {

using internal::StageCounts;

/// Whether two rows of `size` doubles are equal (−0 equals +0).
inline bool equal_points(const double* p, const double* q, int size) {
  for (int j = 0; j < size; ++j)
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

/// The position of q relative to the sphere through k+1 positively oriented points: − inside, 0 on it, +
/// outside. The lifted points are coplanar with q when det(p_i − q, |p_i − q|²) = 0, and for a positively
/// oriented simplex its sign times (−1)^(k+1) is the sign of |q − c|² − r² (docs/predicates.md, "Signs").
/// Weighted points: relative to the sphere orthogonal to the k+1 weighted points, |p_i − c|² − r² = w_i, the
/// sign of |q − c|² − r² − w_q; lifts are |p_i − q|² − w_i + w_q. For k = 0 it is − if q is heavier than the
/// point, + if lighter. Furthest points: the opposite sign, − outside, as all lifts are negated: −|p|² + |q|²
/// is −|p − q|² but for a multiple of p − q.
template <int K>
Sign in_sphere(const Flat& flat, const double* const* points, const double* q, const Grid& grid,
               StageCounts& counts) {
  Sign sign;
  if (const auto direct = direct_sphere<K>(flat, points, q, grid)) {
    sign = *direct;
    ++counts.direct;
  } else {
    sign = exact_sphere(flat, points, q);
    ++counts.exact;
  }
  return (flat.dimension() % 2 == 0) != flat.furthest() ? -sign : sign;
}

/// The pattern of both tie-breaks. Of size+1 rows (a cell's or a facet's, and q) that are dependent, the
/// largest in the order `less` that matters decides: q itself, for +; vertices[i], for minus the sign of
/// `volume` with q put in place i, if that is not zero: the sign of the coefficient of vertices[i] in the
/// combination of the vertices that makes q. `key_of`: what `less` compares of a row.
template <int K, class KeyOf, class Less, class Volume>
Sign largest_decides(const double* const* vertices, int size, const double* q, KeyOf key_of, Less less,
                     Volume volume) {
  using Key = std::decay_t<decltype(key_of(q))>;
  Buffer<Key, K + (K > 0)> keys(static_cast<std::size_t>(size));
  // The rows larger than q: only these can decide before q does.
  Buffer<std::size_t, K + (K > 0)> larger(static_cast<std::size_t>(size));
  Buffer<const double*, K + (K > 0)> moved(static_cast<std::size_t>(size));
  const Key key_of_q = key_of(q);
  std::size_t left = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i) {
    moved[i] = vertices[i];
    keys[i] = key_of(vertices[i]);
    larger[left] = i;
    left += less(key_of_q, keys[i]) ? 1 : 0;
  }
  // The first one mostly decides, so they are not sorted.
  while (left > 0) {
    std::size_t largest = 0;
    for (std::size_t j = 1; j < left; ++j)
      largest = less(keys[larger[largest]], keys[larger[j]]) ? j : largest;
    const std::size_t i = std::exchange(larger[largest], larger[left - 1]);
    --left;
    moved[i] = q;
    const Sign coefficient = volume(moved.data());
    moved[i] = vertices[i];
    if (coefficient != Sign::zero) return -coefficient;
  }
  return Sign::positive;
}

/// The same for points in their lexicographic order.
template <int K, class Volume>
Sign largest_point_decides(const double* const* vertices, int size, const double* q, int ambient,
                           const Grid& grid, Volume volume) {
  if (grid.is_small())
    return largest_decides<K>(
        vertices, size, q, [&](const double* p) { return grid.lexicographic_key(p); }, std::less<>(), volume);
  const auto less = [&](const double* a, const double* b) { return lexicographically_less(a, b, ambient); };
  return largest_decides<K>(vertices, size, q, std::identity(), less, volume);
}

/// perturbed_in_sphere() of points of R^K on a small grid, where everything is exact: from the differences of
/// points and q alone.
template <int K>
Sign perturbed_in_sphere_on_grid(const double* const* points, const double* q, const Grid& grid) {
  double differences[K + 1][K], keys[K + 1];  // keys: of the points less that of q
  for (int i = 0; i <= K; ++i) {
    keys[i] = 0;
    for (int r = 0; r < K; ++r) {
      differences[i][r] = points[i][r] - q[r];
      keys[i] += differences[i][r] * grid.key_weight(r);
    }
  }
  return perturbed_in_sphere_of_differences<K>(differences, keys);
}

/// The tie-break of Devillers and Teillaud (2011, doi:10.1016/j.comgeo.2010.09.010) for a q exactly on the
/// sphere of k+1 positively oriented points: every point is lifted by its own infinitesimal, larger for
/// lexicographically larger points. The first point, from the largest down, whose lifting moves q off the
/// sphere decides:
///   q itself: lifted out of the sphere, +;   p_i: the sphere at q rises by ε_i times the barycentric coordinate of q at p_i.
/// Never 0. REQUIRES that in_sphere is 0 and that q is none of the points. Of weighted points only the
/// coordinates count: a q with the coordinates of p_i is then equal to p_i, as in_sphere has the sign of w_i
/// − w_q.
template <int K>
Sign perturbed_in_sphere(const Flat& flat, const double* const* points, const double* q, const Grid& grid) {
  const int k = K > 0 ? K : flat.dimension();
  if constexpr (tabulates_minors<K>) {
    if (flat.ambient == k && grid.is_small()) return perturbed_in_sphere_on_grid<K>(points, q, grid);
    if (flat.ambient == k && !flat.weighted())
      if (const auto sign = perturbed_in_sphere_of_small<K>(points, q)) return *sign;
  }
  return largest_point_decides<K>(points, k + 1, q, flat.ambient, grid, [&](const double* const* moved) {
    return orientation<K>(flat, moved, grid);
  });
}

}  // namespace delone::kernel
