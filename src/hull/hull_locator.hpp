// SPDX-License-Identifier: BSD-3-Clause
// Where a point lies with respect to a finished boundary: in which cone of its fan, and on which side of that
// cell. Where no double is inside the hull, all cells are asked.
#pragma once

#include "compiled/simplicial_hull.hpp"
#include "hull/hull_builder.hpp"

#include <cstddef>
#include <vector>

namespace delone::internal {

class HullLocator {
 public:
  /// Both must outlive this object, unchanged. O(1).
  HullLocator(const HullSites& sites, const ConvexHullBuilder& builder)
      : sites_(sites), builder_(builder), hull_(builder.hull()) {}

  struct Result {
    std::size_t cell;
    Sign side;  ///< of q: + inside the hull, 0 on its boundary and the cell's hyperplane, − beyond the cell's
                ///< hyperplane
  };
  /// REQUIRES q in the flat, k ≥ 1; `grid` is one for the sites and q.
  Result locate(const double* q, const kernel::Grid& grid) const;

  /// The cells whose hyperplane has q on the given side (zero or negative), one of them being `first`: they
  /// are connected by ridges if q is on the boundary or outside, respectively. Increasing.
  std::vector<Index> cells_on_side(std::size_t first, Sign side, const double* q,
                                   const kernel::Grid& grid) const;

 private:
  /// The exact side, with the filter.
  Sign side(std::size_t cell, const double* q, const kernel::Grid& grid,
            std::vector<const double*>& scratch) const;
  Result search_all(const double* q, const kernel::Grid& grid) const;

  const HullSites& sites_;
  const ConvexHullBuilder& builder_;
  const SimplicialHull& hull_;
};

}  // namespace delone::internal
