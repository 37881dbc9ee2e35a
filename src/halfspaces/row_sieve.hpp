// SPDX-License-Identifier: BSD-3-Clause
// Which halfspaces are certainly redundant, before any work is spent on them.
#pragma once

#include "halfspaces/halfspace_dual.hpp"

#include <delone/options.hpp>
#include <delone/types.hpp>

#include <span>
#include <vector>

namespace delone::halfspaces {

/// Of many rows that begin a cone in automatic order, removes those that are redundant by a margin from a
/// list of rows with normals, increasing, and returns them, increasing. Dual points are sieved as points of a
/// hull are (hull/point_sieve.hpp), as what they are, rounded. The first rows that span all normals stay.
std::vector<Index> remove_redundant(std::span<const double> rows, const InteriorPoint& p,
                                    const Options& options, std::vector<Index>& list);

}  // namespace delone::halfspaces
