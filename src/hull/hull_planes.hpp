// SPDX-License-Identifier: BSD-3-Clause
// The hyperplanes of cells as linear functions with two certified thresholds each.
#pragma once

#include "compiled/simplicial_hull.hpp"
#include "hull/sieve_kernel.hpp"

#include <span>
#include <vector>

namespace delone::hull {

/// A box by its centre and its half extents, rounded up. Its points may be rounded: then coordinate j of each
/// is off by at most error[j]. Without errors they are exact.
struct CenteredBox {
  std::vector<double> center, reach, error = {};
};

/// Function i belongs to a cell. For all points of the box, a value below low[i] proves that the point is
/// strictly inside the hyperplane, one above high[i] that it is strictly beyond it. Both hold even if
/// coordinates j of the point are changed by up to 2·error[j]. Where binary64 certifies no normal, or numbers
/// overflow, no value proves anything.
///
/// If points are rounded, a point whose values are below all thresholds of a hull is strictly inside the hull
/// of the exact points, too. Otherwise there is a direction n in which no exact vertex s of that hull is
/// beyond the exact point y: n·y ≥ n·s. The rounded ones satisfy n·y ≥ n·s − 2·Σ|n_j|·error_j, so the rounded
/// y, moved by 2·error_j in each coordinate, is not strictly inside the hull of the rounded points. But the
/// thresholds say that it is.
struct HullPlanes {
  LinearFunctions functions;
  std::vector<double> low, high;
};

/// The planes of some cells of a hull of full dimension, whose sites are in the box.
HullPlanes hull_planes(const sites::BoundarySites& sites, const compiled::SimplicialHull& hull,
                       std::span<const Index> cells, const CenteredBox& box);

}  // namespace delone::hull
