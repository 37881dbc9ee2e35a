// SPDX-License-Identifier: BSD-3-Clause
// Linear functions of many points at once, one point per SIMD lane: the extremes of the functions, and the
// points below all thresholds. Compiled for several instruction sets; the best one of the machine is chosen
// at run time.
#pragma once

#include <delone/types.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone::hull {

/// f_i(x) = Σ_j normals[i·d + j]·(x_j − origin_j). Computed with d rounded differences, and products and sums
/// that are rounded at most as often as without fused operations. The result for a point depends on the point
/// alone.
struct LinearFunctions {
  std::vector<double> origin;   ///< d
  std::vector<double> normals;  ///< d per function

  std::size_t size() const { return origin.empty() ? 0 : normals.size() / origin.size(); }
};

/// Where a function is greatest.
struct Extreme {
  static constexpr auto nowhere = static_cast<std::size_t>(-1);
  double value;
  std::size_t at = nowhere;  ///< the number of a point
};

/// For each function, a point where the computed value is greatest, if that exceeds `extremes[i].value`; else
/// the entry stays. Points with values that are not numbers may be passed over. `points`: d numbers each.
/// `threads`: as Options::threads; the result does not depend on it. A cancellation point.
void find_extremes(std::span<const double> points, const LinearFunctions& functions,
                   std::span<Extreme> extremes, unsigned threads = 1);

/// Sets is_below[p] to 1 if the computed value of each function at point p is below its threshold, else to 0.
/// `threads`: the same. A cancellation point.
void find_below(std::span<const double> points, const LinearFunctions& functions,
                std::span<const double> thresholds, std::span<char> is_below, unsigned threads = 1);

}  // namespace delone::hull
