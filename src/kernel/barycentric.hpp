// SPDX-License-Identifier: BSD-3-Clause
// Barycentric coordinates in a simplex: in binary64 with a proven bound on their errors, and exactly.
#pragma once

#include "kernel/fractions.hpp"

#include <span>
#include <vector>

namespace delone::kernel {

/// e such that 2^e scales a number of this magnitude to between 1/8 and 1/4.
int exponent_to_a_quarter(double largest);

/// The barycentric coordinates of q in the simplex of k+1 points, on the k axes. Returns a bound on the error
/// of each of them; infinity if binary64 does not prove one, and then `weights` is unspecified. REQUIRES
/// points that are affinely independent on these axes, and a q in their convex hull. O(k³).
double certified_barycentric(std::span<const double* const> points, std::span<const int> axes,
                             const double* q, std::vector<double>& weights);

/// The same exactly: numerators of all k+1 coordinates, and their denominator. q may be anywhere.
Fractions exact_barycentric(std::span<const double* const> points, std::span<const int> axes,
                            const double* q);

}  // namespace delone::kernel
