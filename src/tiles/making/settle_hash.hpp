// SPDX-License-Identifier: BSD-3-Clause
// The hash of a periodic set counts in units of the finest bit of all vertices. Parts are made with the
// finest bit of all points, which is known before the first tile. Hidden points may have a finer one than the
// vertices: then the shares of parts are summed again, from their files. Processes that share a folder do
// this for the parts of each.
#pragma once

#include "periodic/periodic_set.hpp"
#include "tiles/work_folder.hpp"

#include <cstddef>

namespace delone::tiles {

/// Of parts first … last − 1 of a folder, all of them finished.
bool has_hidden_points(const WorkFolder& folder, std::size_t first, std::size_t last);
/// Of the lattice and the vertices of these parts.
int finest_bit_of_vertices(const periodic::PeriodicSet& set, const WorkFolder& folder, std::size_t first,
                           std::size_t last);
/// From shares in units of 2^grid, to such of 2^finest. Part 0 gets the share of the lattice, too.
void settle_hashes(const periodic::PeriodicSet& set, int grid, int finest, WorkFolder& folder,
                   std::size_t first, std::size_t last);

}  // namespace delone::tiles
