// SPDX-License-Identifier: BSD-3-Clause
// The rays of a cone by inserting its rows as points or halfspaces, one after the other.
#pragma once

#include "polyhedra/double_description.hpp"

#include <cstddef>
#include <optional>

namespace delone::polyhedra {

/// The largest dimension of a cone that is tried.
inline constexpr std::size_t most_dimensions_of_insertion = 7;

/// The rays, or how far the insertion came.
struct InsertedRays {
  std::optional<PointedRays> rays;  ///< of which `zeros` have at least the rows that are facets
  bool can_go_on = false;           ///< with more time; if not, insertion does not suit the cone
  double fraction = 0;              ///< of the rows that were inserted
};

/// The same rays as find_rays_of_pointed(), within this many seconds. None if entries of rows are no doubles,
/// or if the cone is flat. Fast for simple polyhedra in few dimensions; a vertex on many facets makes many
/// simplices.
InsertedRays find_rays_by_insertion(const PointedCone& cone, double seconds);

}  // namespace delone::polyhedra
