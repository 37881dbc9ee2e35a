// SPDX-License-Identifier: BSD-3-Clause
// Radii and qualities of cells that are plain arrays, as of files: these can be flat.
#pragma once

#include <delone/types.hpp>

#include <span>
#include <vector>

namespace delone::internal {

/// Of each cell circumradii() and QualityMeasure::radius_ratio; both NaN where its vertices are affinely
/// dependent, which is decided exactly.
struct ShapesOfCells {
  std::vector<double> radius, ratio;
};

/// REQUIRES cells of `corners` ≥ 2 rows of points with d finite coordinates each. `threads`: as
/// Execution::threads.
ShapesOfCells shapes_of_cells(std::span<const double> points, int dimension,
                              std::span<const SignedIndex> cells, int corners, unsigned threads = 1);

}  // namespace delone::internal
