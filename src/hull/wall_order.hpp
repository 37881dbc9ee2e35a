// SPDX-License-Identifier: BSD-3-Clause
// The order in which to insert points that lie on the facets of a hull.
#pragma once

#include "hull/hull_state.hpp"

#include <vector>

namespace delone::hull {

/// Sorts sites in the hull: first those in the interior, then facet by facet those on it, lexicographically.
/// Returns false, and does nothing, if a sample says that few are on facets.
///
/// Of points of one facet the lexicographically larger ones are moved inwards more. So the cells in the facet
/// are those of a sweep: long strips across its direction. A walk to a random point crosses about √n of them,
/// a walk from the lexicographic predecessor a few.
bool order_by_walls(const HullState& hull, std::vector<Index>& sites);

}  // namespace delone::hull
