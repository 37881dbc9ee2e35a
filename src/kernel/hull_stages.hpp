// SPDX-License-Identifier: BSD-3-Clause
// The predicates of convex hulls and of intersections of halfspaces: on which side of a facet a row is, with
// the tie-break. K is the dimension of the flat, or 0 when it is chosen at run time; a facet of its hull has
// k rows.
#pragma once

#include "kernel/rays.hpp"
#include "kernel/stages.hpp"

namespace delone::kernel {

/// The sign of the determinant of k+1 homogeneous rows on the axes of the flat. For rows (x, 1) it is (−1)^k
/// times that of the orientation of the points x.
template <int K>
Sign homogeneous_orientation(const Flat& flat, const double* const* rows, StageCounts& counts) {
  if (const auto sign = direct_determinant<K + (K > 0)>(flat.axes, rows)) {
    ++counts.direct;
    return *sign;
  }
  ++counts.exact;
  return exact_determinant(flat.axes, rows);
}

/// The side of the hyperplane through k rows (of a linear hyperplane, for homogeneous rows) that q is on: the
/// sign of the determinant of the homogeneous rows of the facet, in order, and then of q. For points this is
/// det(p_i − q). A facet whose rows are so ordered that the inside of the hull is positive is in conflict
/// with q iff the side is negative. `grid` is used for points only.
template <int K>
Sign hull_side(const Flat& flat, const double* const* facet, const double* q, const Grid& grid,
               StageCounts& counts) {
  if (flat.form == RowForm::homogeneous) {
    const int k = K > 0 ? K : flat.dimension();
    Buffer<const double*, K + (K > 0)> rows(static_cast<std::size_t>(k + 1));
    std::copy(facet, facet + k, rows.data());
    rows[static_cast<std::size_t>(k)] = q;
    return homogeneous_orientation<K>(flat, rows.data(), counts);
  }
  if (const auto sign = direct_orientation<K>(flat, facet, q, grid)) {
    ++counts.direct;
    return *sign;
  }
  ++counts.exact;
  return exact_orientation(flat, facet, q);
}

/// Whether two rows are the same point, or the same ray.
inline bool equal_rows(const Flat& flat, const double* p, const double* q) {
  return flat.form == RowForm::homogeneous ? compare_rays(p, q, flat.ambient) == 0
                                           : equal_points(p, q, flat.row_size());
}

/// The tie-break of Devillers and Teillaud for a q exactly on the hyperplane of a facet whose inside is
/// positive: every row moves by its own infinitesimal towards a row o inside the hull, points farther if they
/// are lexicographically larger, homogeneous rows if they come later in compare_rays(). The first row, from
/// the largest down, whose moving takes q off the hyperplane decides:
///   q itself: it moves inwards, +;   v_i: the hyperplane at q moves inwards by ε_i times the barycentric coordinate of q at
///   v_i.
/// `inner` is any row on the positive side of the facet; all of them give the same answer
/// (docs/predicates.md). `grid`: one for the facet, q and `inner`, used for points only. `side_of_inner` is
/// negative for a facet whose inside is. Never 0. REQUIRES that q is none of the rows of the facet, which are
/// independent, and that hull_side is 0.
template <int K>
Sign perturbed_hull_side(const Flat& flat, const double* const* facet, const double* q, const double* inner,
                         const Grid& grid, Sign side_of_inner = Sign::positive) {
  const int k = K > 0 ? K : flat.dimension();
  StageCounts uncounted;
  const auto volume = [&](const double* const* moved) {
    return hull_side<K>(flat, moved, inner, grid, uncounted) * side_of_inner;
  };
  if (flat.form != RowForm::homogeneous)
    return largest_point_decides<K>(facet, k, q, flat.ambient, grid, volume);
  const auto less = [&](const double* a, const double* b) { return compare_rays(a, b, flat.ambient) < 0; };
  return largest_decides<K>(facet, k, q, std::identity(), less, volume);
}

/// The sign of n·p + c for a row (n, c) of dimension+1 doubles: the side of the hyperplane that p is on.
inline Sign side_of_hyperplane(const double* row, const double* p, int dimension, StageCounts& counts) {
  if (const auto sign = direct_affine_form(row, p, dimension)) {
    ++counts.direct;
    return *sign;
  }
  ++counts.exact;
  return exact_affine_form(row, p, dimension);
}

}  // namespace delone::kernel
