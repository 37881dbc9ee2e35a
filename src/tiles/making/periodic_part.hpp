// SPDX-License-Identifier: BSD-3-Clause
// The part of a tile of a periodic set: from the numbers and the short vectors of the set to those of the
// caller, and its share of the hash.
#pragma once

#include "complex/canonical_hash.hpp"
#include "periodic/periodic_set.hpp"
#include "tiles/finished_tile.hpp"

#include <delone/tiles.hpp>

#include <cstdint>

namespace delone::tiles {

/// Of a tile as TileTriangulation::finish() leaves it. Also adds to its hashes, in units of 2^grid: see
/// hash_of_part(). Throws Errc::unsupported if offsets do not fit into 32 bits.
void finish_periodic_part(const periodic::PeriodicSet& set, int grid, FinishedTile& tile);

/// The share of a part in the hash of the whole: of its first `num_vertices` points, and of its cells. That
/// of the lattice is lattice_hash().
complex::HashAccumulator hash_of_part(const periodic::PeriodicSet& set, int grid, const TileData& part,
                                      std::int64_t num_vertices, bool with_weights);
complex::HashAccumulator lattice_hash(const periodic::PeriodicSet& set, int grid);

/// The finest bit of these points, or periodic::no_grid.
int finest_bit_of_part(const periodic::PeriodicSet& set, const TileData& part, std::int64_t num_vertices);

}  // namespace delone::tiles
