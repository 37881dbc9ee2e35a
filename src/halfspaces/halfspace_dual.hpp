// SPDX-License-Identifier: BSD-3-Clause
// Interior points and dual points. A dual point is a quotient; it is kept as a pair of doubles, for the
// filter alone.
#pragma once

#include "kernel/fractions.hpp"

#include <span>
#include <vector>

namespace delone::internal {

/// A point strictly inside. Where `numerators` are given, the exact one:
/// numerators[j]/denominator·2^exponent.
struct InteriorPoint {
  std::vector<double> rounded;
  std::vector<kernel::Integer> numerators;
  kernel::Integer denominator = 1;
  int exponent = 0;
  bool is_exact() const { return numerators.empty(); }
};

/// A row divided by a power of two: integers.
std::vector<kernel::Integer> integer_row(const double* row, std::size_t size);

/// n_j/−(n·p + c) for the `axes` of a row (n, c) of d+1 doubles, strictly negative at p: first each rounded
/// to the nearest double or its neighbor, then what that leaves over. Together they are off by at most 2⁻⁶⁸
/// of the entry, barring underflow; infinite where the exact entry is beyond the doubles. In pairs of doubles
/// if cancellation allows, otherwise in integers.
void dual_point(const double* row, const InteriorPoint& p, std::span<const int> axes, double* dual);

}  // namespace delone::internal
