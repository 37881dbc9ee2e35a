// SPDX-License-Identifier: BSD-3-Clause
// The order in which the sites of an intersection are inserted.
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
      rounds;  ///< where about stretches of the order end that cover all sites, ascending
};

/// The sites from `first` on, whose dual points are known. REQUIRES a rank of at least 1.
SitesToInsert sites_to_insert(const IntersectionParts& parts, Index first, const Options& options);

}  // namespace delone::halfspaces
