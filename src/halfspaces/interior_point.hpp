// SPDX-License-Identifier: BSD-3-Clause
// An interior point of an intersection of halfspaces, or the proof that there is none: an exact linear
// program.
#pragma once

#include "halfspaces/halfspace_dual.hpp"

#include <delone/halfspaces.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone::internal {

struct InteriorSearch {
  IntersectionState state = IntersectionState::full;
  InteriorPoint point;  ///< if full
  std::vector<std::size_t>
      witness;  ///< otherwise: at most d+1 rows that have no interior point in common, increasing
};

/// The point x with the largest t ≤ T for which n·x + c + w·t ≤ 0 holds for all rows (n, c); w is the power
/// of two above the largest entry of n, T one that is large for the data. There are interior points iff t >
/// 0, and none but points of a hyperplane if t = 0. `rows`: which rows of `halfspaces` to take; their normals
/// are not zero.
///
/// The dual simplex method (Lemke 1954, doi:10.1002/nav.3800010107): a basis of d+1 rows, whose common point
/// is feasible for more and more rows. Points, multipliers and ratios are fractions of integers. Rows are
/// compared with the point in binary64 first, in integers where that is not certain. The most violated row
/// enters the basis, and after some steps the first violated one with ties of ratios broken alike (Bland
/// 1977, doi:10.1287/moor.2.2.103), which cannot cycle.
InteriorSearch find_interior_point(std::span<const double> halfspaces, int dimension,
                                   std::span<const std::size_t> rows);

}  // namespace delone::internal
