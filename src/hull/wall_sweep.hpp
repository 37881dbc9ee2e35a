// SPDX-License-Identifier: BSD-3-Clause
// The cells of one wall of a convex hull, where many sites are on it.
#pragma once

#include "sites/boundary_sites.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace delone::hull {

using sites::BoundarySites;

/// The cells of a wall, of `corners` sites each: for x on one side of the wall, x and the vertices of any
/// cell are positively oriented. `neighbors`: across the ridge opposite each vertex; invalid_index at the
/// border.
struct SweptWall {
  std::size_t corners = 0;
  std::vector<Index> cells, neighbors;

  std::size_t num_cells() const { return corners == 0 ? 0 : cells.size() / corners; }
};

/// The triangulation of sites in a hyperplane of the flat that the perturbation of hulls selects: each site
/// is joined to the faces of the hull of its lexicographic predecessors that it sees
/// (docs/decisions/0043-walls-are-swept.md). `sites_of_wall`: distinct, lexicographically increasing, and
/// they span the hyperplane. `tick` is told often how many of them are done, and may throw. O(1) and some
/// exact orientations of one dimension less per cell.
SweptWall sweep_wall(const BoundarySites& sites, std::span<const Index> sites_of_wall,
                     const std::function<void(std::size_t)>& tick);

}  // namespace delone::hull
