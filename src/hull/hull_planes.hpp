// SPDX-License-Identifier: BSD-3-Clause
// The hyperplanes of cells as linear functions with two certified thresholds each.
#pragma once

#include "compiled/simplicial_hull.hpp"
#include "hull/sieve_kernel.hpp"

#include <span>
#include <vector>

namespace delone::internal {

/// A box by its centre and its half extents, rounded up.
struct CenteredBox {
  std::vector<double> center, reach;
};

/// Function i belongs to a cell. For all points of the box, a value below low[i] proves that the point is
/// strictly inside the hyperplane, one above high[i] that it is strictly beyond it. Where binary64 certifies
/// no normal, or numbers overflow, no value proves anything.
struct HullPlanes {
  LinearFunctions functions;
  std::vector<double> low, high;
};

/// The planes of some cells of a hull of full dimension, whose sites are in the box.
HullPlanes hull_planes(const HullSites& sites, const SimplicialHull& hull, std::span<const Index> cells,
                       const CenteredBox& box);

}  // namespace delone::internal
