// SPDX-License-Identifier: BSD-3-Clause
// Locates a point with respect to a finished boundary: the cone of the fan that contains it, and the side of
// that cell's hyperplane. Where no double is strictly inside the hull there is no fan, and all cells are
// tested.
#pragma once

#include "compiled/simplicial_hull.hpp"
#include "hull/boundary.hpp"

#include <cstddef>
#include <vector>

namespace delone::hull {

class HullLocator {
 public:
  /// Both arguments must outlive this object and must not change. O(1).
  HullLocator(const BoundarySites& sites, const Boundary& boundary)
      : sites_(sites), boundary_(boundary), hull_(boundary.hull()) {}

  struct Result {
    std::size_t cell;
    /// Of q: + inside the hull, 0 on the boundary and on the hyperplane of the cell, − beyond that
    /// hyperplane.
    Sign side;
  };
  /// REQUIRES q in the flat of the hull and k ≥ 1. `grid` covers the sites and q.
  Result locate(const double* q, const kernel::Grid& grid) const;
  /// The same from a cell near that of q. REQUIRES has_fan(); `grid` covers the center, too.
  Result locate_from(std::size_t start, const double* q, const kernel::Grid& grid) const;
  /// Whether there are a boundary of an engine, and a point inside.
  bool has_fan() const;
  /// The side alone, which is faster.
  Sign side_of_hull(const double* q, const kernel::Grid& grid) const;
  /// Whether q is in the interior of the hull. Faster still for points of the boundary.
  bool is_in_interior(const double* q, const kernel::Grid& grid) const;

  /// All cells whose hyperplane has q on the side `side` (zero or negative), in increasing order. `first`
  /// must be one of them. Searches across ridges: for q on the boundary the cells with side zero are
  /// connected, for q outside those with side negative.
  std::vector<Index> cells_on_side(std::size_t first, Sign side, const double* q,
                                   const kernel::Grid& grid) const;

 private:
  /// The exact side, filtered first.
  Sign side(std::size_t cell, const double* q, const kernel::Grid& grid,
            std::vector<const double*>& scratch) const;
  Result approach(const double* q) const;
  Result search_all(const double* q, const kernel::Grid& grid) const;

  const BoundarySites& sites_;
  const Boundary& boundary_;
  const SimplicialHull& hull_;
};

}  // namespace delone::hull
