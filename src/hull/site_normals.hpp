// SPDX-License-Identifier: BSD-3-Clause
// Directions in which the sites of a hull are farther than the others.
#pragma once

#include "hull/hull_state.hpp"

#include <vector>

namespace delone::hull {

/// For each site the sum of the outward unit normals of its cells, in binary64 and without a bound; 0 for a
/// site of no cell. Cells are left out whose normals are hardly known. All hyperplanes of cells at a vertex
/// support the hull, so in this direction it is farther than all points that are not on all those of the
/// cells that count. Empty if the hull is flat, or of one dimension.
std::vector<double> sums_of_normals(const HullState& state);

}  // namespace delone::hull
