// SPDX-License-Identifier: BSD-3-Clause
// The fan of a boundary: seen from a point o strictly inside, the cells are cones that cover space. A query q
// leaves the hull, if at all, through the cell whose cone it is in, so q is inside, on the boundary or
// outside as it is inside, on or beyond the hyperplane of that cell. Where the descent of the engine ends
// uncertain, a visibility walk finds the cone, exactly: leave a cone by a wall that has q on its other side.
// Boundaries of convex polytopes have no cycles of cells as seen along rays (Edelsbrunner 1990,
// doi:10.1007/BF02122779). Where cells share a hyperplane, the perturbation moves vertices on their rays,
// which makes the boundary convex at all ridges and leaves the fan as it is.
#pragma once

#include "compiled/simplicial_hull.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace delone::internal {

/// Sets `point` to one near the mean of some sites (rounded to few bits if possible, as that keeps
/// determinants of lattices exact) that `is_inside(point, grid of all sites and it)` accepts. False if there
/// is none.
template <class IsInside>
bool choose_interior_point(const HullSites& sites, const std::vector<Index>& around,
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

/// A cell whose closed cone contains q, seen from `center`, exactly. `grid` is one for the sites and q.
std::size_t walk_cones(const HullSites& sites, const SimplicialHull& hull, const std::vector<double>& center,
                       const double* q, std::size_t start, const kernel::Grid& grid);

}  // namespace delone::internal
