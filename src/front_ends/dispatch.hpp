// SPDX-License-Identifier: BSD-3-Clause
// The only place where a dimension known at run time picks a compiled one.
#pragma once

#include "front_ends/hull.hpp"

namespace delone {

inline constexpr int largest_compiled_dimension = 8;

/// The hull compiled for axes.size() dimensions, or the one for run-time dimensions beyond 8 and when asked for.
std::unique_ptr<Hull> make_hull(const std::vector<int>& axes, const VertexPoints& points, const geometry::Frame& frame,
                                const engine::Effort& effort, bool force_runtime_dimension);

}  // namespace delone
