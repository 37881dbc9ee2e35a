// SPDX-License-Identifier: BSD-3-Clause
// Finds an interior point of an intersection of halfspaces, or proves that there is none, by an exact linear
// program.
#pragma once

#include "halfspaces/halfspace_dual.hpp"

#include <delone/halfspaces.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone::halfspaces {

struct InteriorSearch {
  IntersectionState state = IntersectionState::full;
  InteriorPoint point;  ///< if full
  /// Otherwise at most d+1 rows whose halfspaces have no interior point in common, in increasing order.
  std::vector<std::size_t> witness;
};

/// Maximizes t ≤ T subject to n·x + c + w·t ≤ 0 for all rows (n, c), where w is the power of two above the
/// largest entry of n and T is large for the data. The intersection has interior points iff the maximum is
/// positive. If it is zero, the intersection is not empty but lies in a hyperplane. `rows` selects rows of
/// `halfspaces`; their normals must not be zero.
///
/// The dual simplex method (Lemke 1954, doi:10.1002/nav.3800010107): a basis of d+1 rows, whose common point
/// satisfies more and more rows. Points, multipliers and ratios are exact fractions. Rows are compared with
/// the point in binary64 first, and in integers where that is not certain. The row with the largest violation
/// enters the basis. After a number of steps it is the first violated row instead, with the same order for
/// equal ratios: this rule cannot cycle (Bland 1977, doi:10.1287/moor.2.2.103).
InteriorSearch find_interior_point(std::span<const double> halfspaces, int dimension,
                                   std::span<const std::size_t> rows);

}  // namespace delone::halfspaces
