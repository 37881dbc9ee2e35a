// SPDX-License-Identifier: BSD-3-Clause
// The fan of a boundary: seen from a point strictly inside, the cells span cones that cover space. A query
// lies in the cone of some cell. It is inside the hull, on its boundary or outside exactly as it is inside,
// on or beyond the hyperplane of that cell.
//
// Where the engine's filtered descent ends in doubt, an exact visibility walk finds the cone: leave a cone
// through any wall that has the query on its other side. The walk ends, because the cells of the boundary of
// a convex polytope have no cycle in front-to-back order (Edelsbrunner 1990, doi:10.1007/BF02122779). Where
// cells share a hyperplane, the perturbation moves vertices along their rays. That makes the boundary
// strictly convex at every ridge and does not change the fan.
#pragma once

#include "compiled/boundary_engine.hpp"
#include "compiled/simplicial_hull.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace delone::hull {

using sites::BoundarySites;

/// Looks for a point near the mean of the sites `around` for which `is_inside(point, grid)` holds, where
/// `grid` covers all sites and the point. Tries the mean rounded to a few bits first, which keeps
/// determinants of lattices exact, then the mean itself. Returns false if neither is inside.
template <class IsInside>
bool choose_interior_point(const BoundarySites& sites, const std::vector<Index>& around,
                           std::vector<double>& point, IsInside is_inside) {
  const std::size_t d = point.size();
  std::vector<double> mean(d, 0.0), extent(d, 0.0);
  for (const Index site : around)
    for (std::size_t j = 0; j < d; ++j) mean[j] += sites.point(site)[j] / static_cast<double>(around.size());
  for (const Index site : around)
    for (std::size_t j = 0; j < d; ++j)
      extent[j] = std::max(extent[j], std::fabs(sites.point(site)[j] - mean[j]));
  for (const bool coarse : {true, false}) {
    point = mean;
    for (std::size_t j = 0; coarse && j < d; ++j) {
      if (!(extent[j] > 0x1p-900 && extent[j] < 0x1p900)) continue;
      const double unit = std::ldexp(1.0, std::ilogb(extent[j]) - 7);
      if (std::fabs(mean[j] / unit) < 0x1p52) point[j] = std::nearbyint(mean[j] / unit) * unit;
    }
    kernel::Grid grid = sites.grid;
    grid.include(point.data());
    const bool found = std::all_of(point.begin(), point.end(), [](double x) { return std::isfinite(x); }) &&
                       is_inside(point.data(), grid);
    if (found) return true;
  }
  return false;
}

/// A view of points from strictly inside the simplex of some sites, if a double is. It has no box.
geometry::CentralView view_from_inside(const BoundarySites& sites, const std::vector<Index>& simplex);

/// A cell whose closed cone, seen from `center`, contains q. Exact. `grid` covers the sites, q and the
/// center.
std::size_t walk_cones(const BoundarySites& sites, const compiled::SimplicialHull& hull,
                       const std::vector<double>& center, const double* q, std::size_t start,
                       const kernel::Grid& grid);

}  // namespace delone::hull
