// SPDX-License-Identifier: BSD-3-Clause
// Small linear systems of a cell in any dimension: barycentric coordinates with a bound of their errors, and
// gradients, rounded.
#pragma once

#include <span>
#include <vector>

namespace delone::internal {

/// No barycentric coordinate that is given to users is off by more; see LocatedPoint.
inline constexpr double largest_weight_error = 0x1p-36;

/// The barycentric coordinates of q in the simplex of k+1 points, on the k axes: 0 for vertices that are not
/// of the smallest face that contains q, positive for the others (where rounding says otherwise: the least
/// normal number). None is off by more than largest_weight_error: they are those of exact arithmetic where
/// binary64 cannot promise that. O(k³).
void barycentric(std::span<const double* const> points, std::span<const unsigned char> on_face,
                 std::span<const int> axes, const double* q, std::vector<double>& weights);

/// The gradient of the affine function with the given values (columns of them, row-major by vertex) at k+1
/// points of R^d, tangent to their flat: columns×d numbers.
void gradients(std::span<const double* const> points, std::span<const double> values, int columns,
               int dimension, std::vector<double>& result);

}  // namespace delone::internal
