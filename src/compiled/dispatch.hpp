// SPDX-License-Identifier: BSD-3-Clause
// The engine compiled for a dimension known at run time.
#pragma once

#include "base/compiled_dimension.hpp"
#include "compiled/triangulation_engine.hpp"

namespace delone::compiled {

/// The engine compiled for axes.size() dimensions, or the one for run-time dimensions beyond 8 and when asked
/// for.
std::unique_ptr<TriangulationEngine> make_triangulation_engine(const std::vector<int>& axes,
                                                               VertexPoints& points,
                                                               const geometry::Frame& frame,
                                                               const engine::Effort& effort,
                                                               bool force_runtime_dimension);

}  // namespace delone::compiled
