// SPDX-License-Identifier: BSD-3-Clause
// Which sites of an intersection are inserted, and in what order.
#pragma once

#include "halfspaces/intersection_arrays.hpp"

#include <delone/options.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <vector>

namespace delone::halfspaces {

struct SitesToInsert {
  std::vector<Index> order;
  std::vector<std::size_t>
      rounds;                ///< where about stretches of the order end that cover all sites, ascending
  std::vector<Index> inner;  ///< left out: their dual points are certainly interior to the hull of the others
};

/// The sites from `first` on, whose dual points are known. Of many that begin a cone in automatic order,
/// those that are redundant by a margin are left out: dual points are sieved as points of a hull are
/// (hull/point_sieve.hpp), as what they are, rounded. REQUIRES a rank of at least 1.
SitesToInsert sites_to_insert(const IntersectionParts& parts, Index first, const Options& options);

}  // namespace delone::halfspaces
