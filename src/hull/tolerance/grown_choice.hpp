// SPDX-License-Identifier: BSD-3-Clause
// A first choice of vertices for a hull with a tolerance, all over the set at once.
#pragma once

#include <delone/types.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace delone::hull {

struct GrownChoice {
  std::vector<Index> kept;  ///< in the order in which they came, those that were required first
  /// n×d: for each point the corners of the cell whose cone it is in, up to rounding; empty if the kept
  /// points are flat.
  std::vector<Index> corners;
};

/// Points, which are named by their numbers, are kept as in Quickhull (Barber, Dobkin, Huhdanpaa 1996,
/// doi:10.1145/235815.235821): in rounds, in each cell of the hull of those kept the one farthest beyond its
/// hyperplane, if that is farther than the tolerance. Rounds that add few end it. All is decided in binary64
/// but the hull: points may be left that are not within the tolerance. A function of the sequence of points.
/// REQUIRES distinct points that span R^dimension. Cost: a walk of a few cells for each point and round, of
/// which there are O(log h) for h vertices.
GrownChoice grow_choice(std::span<const double* const> points, int dimension, double tolerance,
                        std::span<const Index> required, const std::function<void()>& alive);

}  // namespace delone::hull
