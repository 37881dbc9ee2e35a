// SPDX-License-Identifier: BSD-3-Clause
// The centers of the spheres of cells of a triangulation, rounded as those of diagrams.
#pragma once

#include "sites/vertex_points.hpp"

#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <functional>

namespace delone::particles {

/// Calls `visit`, from up to `threads` threads, with each finite cell that is wanted and its center, d
/// correctly rounded coordinates.
void for_each_center(const Triangulation& triangulation, const sites::VertexPoints& points,
                     const std::function<bool(CellId cell)>& is_wanted,
                     const std::function<void(CellId cell, const double* center)>& visit, unsigned threads);

}  // namespace delone::particles
