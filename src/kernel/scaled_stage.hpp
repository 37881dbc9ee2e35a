// SPDX-License-Identifier: BSD-3-Clause
// The end of stage `direct_`, where differences from one point say too little: points in clusters, whose
// distances are of many magnitudes, and coordinates of many magnitudes. Rows are differences along the edges
// of a tree of short edges, or homogeneous; they are scaled optimally and eliminated in pairs of doubles,
// with a certified bound (docs/predicates.md, "Edges of a tree").
#pragma once

#include "kernel/flat.hpp"

#include <delone/types.hpp>

#include <optional>

namespace delone::kernel {

/// The sign of det(p_i − base), i < k, over the axes of the flat; nullopt if the sign is uncertain or k > 11.
std::optional<Sign> scaled_orientation(const Flat& flat, const double* const* points, const double* base);

/// The sign of det(p_i − q, |p_i − q|² − w_i + w_q), i = 0 … k, all weights 0 for points without; nullopt if
/// the sign is uncertain or k > 11.
std::optional<Sign> scaled_sphere(const Flat& flat, const double* const* points, const double* q);

}  // namespace delone::kernel
