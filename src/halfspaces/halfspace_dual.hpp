// SPDX-License-Identifier: BSD-3-Clause
// Interior points and dual points. A dual point is a quotient. It is kept as a pair of doubles, and only
// filters use it.
#pragma once

#include "kernel/fractions.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace delone::halfspaces {

/// A point strictly inside, and its rounding. If `numerators` is empty, `rounded` is the point itself; else
/// its coordinates are numerators[j]/denominator·2^exponent.
struct InteriorPoint {
  std::vector<double> rounded;
  std::vector<kernel::Integer> numerators;
  kernel::Integer denominator = 1;
  int exponent = 0;
  bool is_exact() const { return numerators.empty(); }
};

/// The largest e for which all numbers are integer multiples of 2^e; 0 if all are 0.
int common_exponent(std::span<const double> numbers);

/// The row divided by a power of two that makes all its entries integers.
std::vector<kernel::Integer> integer_row(const double* row, std::size_t size);

/// The coordinates n_j/−(n·p + c) on the `axes`, for a row (n, c) of d+1 doubles that is strictly negative at
/// p. Writes one leading part per axis, the nearest double or a neighbor of it, and then one remainder per
/// axis. The sum of both is off by at most 2⁻⁶⁸ of the exact coordinate, barring underflow, and infinite
/// beyond the range of doubles. Computed in pairs of doubles if cancellation allows, otherwise in integers.
void dual_point(const double* row, const InteriorPoint& p, std::span<const int> axes, double* dual);

/// The same for many rows, one after the other: blocks of them by SIMD, one row per lane.
void dual_points(const double* rows, std::size_t count, const InteriorPoint& p, std::span<const int> axes,
                 double* duals);

}  // namespace delone::halfspaces
