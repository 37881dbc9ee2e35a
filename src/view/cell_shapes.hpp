// SPDX-License-Identifier: BSD-3-Clause
// The circumradius and the quality of simplices, in double precision, for pictures.
#pragma once

#include <delone/types.hpp>

#include <span>
#include <vector>

namespace delone::view {

/// Of each simplex: the radius of the sphere through its corners, and k times its inradius over that, which
/// is 1 for a regular simplex and 0 for a flat one. NaN where rounding leaves none.
struct CellShapes {
  std::vector<double> radius, quality;
};

/// REQUIRES cells of k+1 ≥ 2 rows of points with d coordinates each.
CellShapes cell_shapes(std::span<const double> points, int dimension, std::span<const SignedIndex> cells,
                       int corners);

}  // namespace delone::view
