// SPDX-License-Identifier: BSD-3-Clause
// From homogeneous rows to coordinates: the point where k hyperplanes meet, correctly rounded; directions,
// rounded.
#pragma once

#include "kernel/fractions.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace delone::internal {

/// The solution x of n_i·x + c_i = 0, i < k, for k homogeneous rows, n_i being the first k of the given
/// columns and c_i the last: each of the k coordinates is the nearest double, ties to even, ±infinity beyond
/// the range of doubles. First in pairs of doubles with a certified bound, and where that does not settle the
/// rounding in integers. REQUIRES independent normals.
void meeting_point(std::span<const double* const> rows, std::span<const int> columns, double* x);

/// The integers z_j, j ≤ k, with det(rows, q) = Σ q_j·z_j for every row q, up to one positive factor, on k+1
/// columns: a normal of the linear hyperplane of k rows. All 0 if the rows are dependent.
std::vector<kernel::Integer> cone_normal(std::span<const double* const> rows, std::span<const int> columns);

/// The unit vector along integers that are not all 0, `d` coordinates of which those in `axes` are given:
/// each is off by a few roundings of itself.
std::vector<double> unit_vector(std::span<const kernel::Integer> entries, std::span<const int> axes,
                                std::size_t d);

/// A basis of the x with n_i·x = 0 for k rows whose normals are independent on the axes: for each other axis
/// the vector that has 1 there and 0 in the remaining ones, made a unit vector.
std::vector<double> lineality_basis(std::span<const double* const> rows, std::span<const int> axes,
                                    std::size_t d);

}  // namespace delone::internal
