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

/// Keeps points, named by their numbers, as Quickhull does (Barber, Dobkin, Huhdanpaa 1996,
/// doi:10.1145/235815.235821). Each round adds, for each cell of the hull of the points kept, the point
/// farthest beyond the cell's hyperplane, if that is farther than the tolerance. A round that adds few is the
/// last. All but the hull is decided in binary64, so points that are not within the tolerance may be left.
/// The result is a function of the sequence of points. REQUIRES distinct points that span R^dimension. Cost:
/// a walk of a few cells for each point and round, of which there are O(log h) for h vertices.
GrownChoice grow_choice(std::span<const double* const> points, int dimension, double tolerance,
                        std::span<const Index> required, const std::function<void()>& alive);

}  // namespace delone::hull
