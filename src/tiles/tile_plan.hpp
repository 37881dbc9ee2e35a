// SPDX-License-Identifier: BSD-3-Clause
// Into how many tiles a set is cut, and what they will cost: a model whose only unknown, the number of cells
// per point, is measured on a sample.
#pragma once

#include "tiles/pages.hpp"

#include <delone/tiles.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace delone::tiles {

/// Cells per point, finite and infinite, of the triangulation of some of the sample.
double cells_per_point(std::span<const double> sample, const Survey& survey);

/// The points of other tiles that a tile of n points of dimension k has to insert, divided by n:
/// c_k · (inner faces) · n^(−1/k), measured for uniform points (docs/tiles.md). `num_tiles`: of all.
double expected_foreign_share(int k, double n, std::size_t num_tiles);

/// Memory of one tile at its peak, in bytes: the triangulation of n points, and the arrays of its part.
double expected_tile_bytes(int d, int k, double n, double cells_of_point);

/// As few tiles as fit into `memory` bytes, or as many as options ask for.
TilesForecast plan_tiles(const Survey& survey, double cells_of_point, const TilesOptions& options,
                         std::uint64_t memory);

}  // namespace delone::tiles
