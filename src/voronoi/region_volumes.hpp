// SPDX-License-Identifier: BSD-3-Clause
// The volumes of bounded regions from the cells of the triangulation: sums of signed pieces. These use
// differences of sites, and not the vertices, which are rounded.
#pragma once

#include <delone/types.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace delone::voronoi {

/// More dimensions of regions would take too much memory.
inline constexpr std::size_t most_dimension_of_pieces = 12;

struct SitesAndCells {
  std::size_t k, d;
  std::span<const double> sites;              ///< d per region
  std::span<const double> weights;            ///< by region; empty if there are none
  std::span<const SignedIndex> cell_regions;  ///< k + 1 per finite cell, distinct
};

/// By region, the k-volume of those that are wanted, and 0 for others. Does not depend on threads or the
/// order of cells. REQUIRES 1 ≤ k ≤ most_dimension_of_pieces, and that regions that are wanted are bounded.
std::vector<double> measure_regions(const SitesAndCells& diagram, const std::vector<unsigned char>& wanted,
                                    unsigned threads);

}  // namespace delone::voronoi
