// SPDX-License-Identifier: BSD-3-Clause
// From homogeneous rows to coordinates: the common point of k hyperplanes, correctly rounded, and directions,
// rounded.
#pragma once

#include "kernel/fractions.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace delone::halfspaces {

/// Solves n_i·x + c_i = 0, i < k, for k homogeneous rows, where the first k of the given columns are n_i and
/// the last is c_i. Each coordinate is the nearest double, ties to even, ±infinity beyond the range of
/// doubles. Tries pairs of doubles with a certified bound first, and integers where that does not settle the
/// rounding. REQUIRES independent normals.
void meeting_point(std::span<const double* const> rows, std::span<const int> columns, double* x);

/// The same for many points at once, of k rows each: their coordinates, point by point. In few dimensions
/// SIMD, one point per lane.
std::vector<double> meeting_points(std::span<const double* const> rows, std::span<const int> columns);

/// A normal of the linear hyperplane spanned by k rows on k+1 columns: the integers z_j, j ≤ k, with
/// det(rows, q) = λ·Σ q_j·z_j for every row q and one factor λ > 0. All zero if the rows are dependent.
std::vector<kernel::Integer> cone_normal(std::span<const double* const> rows, std::span<const int> columns);

/// The unit vector of R^d along integers, not all zero, on the given axes; zero on the other axes. Each
/// coordinate is off by a few roundings.
std::vector<double> unit_vector(std::span<const kernel::Integer> entries, std::span<const int> axes,
                                std::size_t d);

/// A basis of the solutions of n_i·x = 0, for k rows whose normals are independent on the axes. It has one
/// unit vector for each other axis: positive on that axis and zero on the remaining ones.
std::vector<double> lineality_basis(std::span<const double* const> rows, std::span<const int> axes,
                                    std::size_t d);

}  // namespace delone::halfspaces
