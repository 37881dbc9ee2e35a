// SPDX-License-Identifier: BSD-3-Clause
// What is asked of the boundary of the cone of the rows of an intersection of halfspaces.
//
// Site 0 is the row at infinity (0, …, 0, −1), dual to the origin: cells on whose hyperplane it lies are
// directions to infinity.
#pragma once

#include "halfspaces/halfspace_dual.hpp"
#include "hull/boundary.hpp"

#include <optional>
#include <vector>

namespace delone::halfspaces {

using compiled::SimplicialHull;

/// A view of rows from strictly inside the cone of some sites, if a row of doubles is. It has no box.
geometry::CentralView view_from_inside(const sites::BoundarySites& sites, const std::vector<Index>& simplex,
                                       const InteriorPoint& p);

/// The exact side of cell c of the boundary's hull that a site is on: + inside, 0 on its hyperplane.
Sign side_of_cell(const hull::Boundary& boundary, const SimplicialHull& hull, std::size_t c, Index site);
/// For a site in no cell: a cell of the boundary's hull on whose hyperplane it is exactly, or nullopt if it
/// is strictly inside.
std::optional<Index> cell_through(const hull::Boundary& boundary, const SimplicialHull& hull, Index site);

}  // namespace delone::halfspaces
