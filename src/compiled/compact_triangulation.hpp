// SPDX-License-Identifier: BSD-3-Clause
// A triangulation without what only insertions need: 8(k + 1) bytes per cell. Queries are exact and slower,
// as nothing is cached: every test is a determinant.
#pragma once

#include "compiled/triangulation_engine.hpp"

#include <memory>

namespace delone {

/// The cells of `complex`, numbered anew without gaps; the rest is taken from `hull`, which may go.
std::unique_ptr<HullQueries> make_compact_hull(const std::vector<int>& axes, const VertexPoints& points,
                                               const Hull& hull, const Complex& complex);

}  // namespace delone
