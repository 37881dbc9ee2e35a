// SPDX-License-Identifier: BSD-3-Clause
// Small linear systems of a cell in any dimension: barycentric coordinates with a bound on their errors, and
// gradients, rounded.
#pragma once

#include <span>
#include <vector>

namespace delone::queries {

/// The largest error of any barycentric coordinate that users see; see LocatedPoint.
inline constexpr double largest_weight_error = 0x1p-36;

/// The barycentric coordinates of q in the simplex of k+1 points, on the k axes. `on_face` marks the vertices
/// of the smallest face that contains q: their coordinates are positive (the smallest normal number where
/// rounding says otherwise), all others are zero. No coordinate is off by more than largest_weight_error;
/// where binary64 cannot promise that, exact arithmetic computes them. O(k³).
void barycentric(std::span<const double* const> points, std::span<const unsigned char> on_face,
                 std::span<const int> axes, const double* q, std::vector<double>& weights);

/// The gradients of the affine functions with the given values (`columns` functions, row-major by vertex) at
/// k+1 points of R^d, tangent to the flat of the points: columns×d numbers.
void gradients(std::span<const double* const> points, std::span<const double> values, int columns,
               int dimension, std::vector<double>& result);

}  // namespace delone::queries
