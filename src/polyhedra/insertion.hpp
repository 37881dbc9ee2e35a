// SPDX-License-Identifier: BSD-3-Clause
// The rays of a cone by inserting its rows as points or halfspaces, one after the other.
#pragma once

#include "polyhedra/double_description.hpp"

#include <cstddef>
#include <optional>

namespace delone::polyhedra {

/// The largest dimension of a cone that is tried.
inline constexpr std::size_t most_dimensions_of_insertion = 7;

/// The same rays as find_rays_of_pointed(), of which `zeros` have at least the rows that are facets. Nothing
/// if it would take more than this many seconds, if entries of rows are no doubles, or if the cone is flat.
/// Fast for simple polyhedra in few dimensions; a vertex on many facets makes many simplices.
std::optional<PointedRays> find_rays_by_insertion(const PointedCone& cone, double seconds);

}  // namespace delone::polyhedra
