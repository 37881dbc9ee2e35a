// SPDX-License-Identifier: BSD-3-Clause
// The surroundings of a tile of a periodic set: translates of all points, and the points of other tiles as
// they are. Why a tile that asks for them has the stars of its points: periodic/ghost_triangulation.hpp, and
// tiles/tile_triangulation.hpp.
#pragma once

#include "periodic/extent.hpp"
#include "periodic/periodic_set.hpp"
#include "tiles/surroundings.hpp"

#include <memory>

namespace delone::tiles {

/// Throws Errc::unsupported if the lattice has too many translations that have to be looked at.
void require_few_shifts(const periodic::PeriodicSet& set);

/// All references outlive the result. REQUIRES few shifts.
std::unique_ptr<Surroundings> periodic_surroundings(const periodic::PeriodicSet& set,
                                                    const periodic::Extent& extent, const Survey& survey,
                                                    const PageTree& tree, PageSource& source,
                                                    std::size_t tile);

}  // namespace delone::tiles
