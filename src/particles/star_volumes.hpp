// SPDX-License-Identifier: BSD-3-Clause
// The volume of the star of each vertex: the sum of its finite cells.
#pragma once

#include "particles/stars.hpp"

#include <delone/triangulation.hpp>

#include <vector>

namespace delone::particles {

/// By vertex id; 0 for vertices whose stars are not wanted. Volumes of dimension k ≥ 1, those of the flat of
/// the sites. Each cell is off by at most 2⁻⁵⁰ of the volume of the star. The order of cells and of their
/// vertices does not matter, to the last bit.
std::vector<double> star_volumes(const Triangulation& triangulation, const Stars& stars, unsigned threads);

}  // namespace delone::particles
