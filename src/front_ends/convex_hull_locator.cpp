// SPDX-License-Identifier: BSD-3-Clause
#include "front_ends/convex_hull_locator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

namespace delone::front_ends {

HullLocator::HullLocator(const HullSites& sites, const SimplicialHull& hull)
    : sites_(sites), hull_(hull), certified_(hull.dimension, difference_scale(sites)), fan_(sites.ambient, certified_.scale()) {
  const std::size_t m = hull.num_cells();
  normals_.resize(m * certified_.stride());
  for (std::size_t c = 0; c < m; ++c)
    certified_.compute(sites, hull.cell(c), hull.dimension == 1 && c == 0, normals_.data() + c * certified_.stride());
  if (hull.dimension == 1) return;
  std::vector<const double*> scratch;
  const bool has_center = fan_.choose_center(sites, hull.cells, [&](const double* point, const kernel::Grid& grid) {
    for (std::size_t c = 0; c < m; ++c)
      if (side(c, point, grid, scratch) != Sign::positive) return false;
    return true;
  });
  if (!has_center) return;
  fan_.resize(m, hull.corners());
  for (std::size_t c = 0; c < m; ++c) fan_.update(sites, hull, c, normals_.data() + c * certified_.stride());
}

Sign HullLocator::side(std::size_t cell, const double* q, const kernel::Grid& grid, std::vector<const double*>& scratch) const {
  const Sign sign = certified_.side(sites_, normals_.data() + cell * certified_.stride(), sites_.point(hull_.cell(cell)[0]), q);
  return sign != Sign::zero ? sign : side_of_cell(sites_, hull_, cell, q, grid, scratch);
}

HullLocator::Result HullLocator::locate(const double* q, const kernel::Grid& grid) const {
  if (!fan_.has_center()) return search_all(q, grid);
  // Start from the best of a sample, so that the way is short in large hulls.
  const std::size_t m = hull_.num_cells();
  const auto sample = static_cast<std::size_t>(std::sqrt(static_cast<double>(m)) / 4) + 1;
  std::size_t start = 0;
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sample; ++i)
    if (const double h = fan_.value(sites_, i * (m / sample), q, hull_.corners()); h > largest) {
      largest = h;
      start = i * (m / sample);
    }
  const std::size_t c = fan_.walk(sites_, hull_, q, fan_.descend(sites_, hull_, q, start), grid);
  std::vector<const double*> scratch;
  return {c, side(c, q, grid, scratch)};
}

/// Without a center: any cell beyond whose hyperplane q is, else any whose hyperplane q is on, else any.
HullLocator::Result HullLocator::search_all(const double* q, const kernel::Grid& grid) const {
  Result result{0, Sign::positive};
  std::vector<const double*> scratch;
  for (std::size_t c = 0; c < hull_.num_cells() && result.side != Sign::negative; ++c)
    if (const Sign sign = side(c, q, grid, scratch); static_cast<int>(sign) < static_cast<int>(result.side)) result = {c, sign};
  return result;
}

std::vector<Index> HullLocator::cells_on_side(std::size_t first, Sign wanted, const double* q, const kernel::Grid& grid) const {
  std::vector<Index> cells{static_cast<Index>(first)};
  std::unordered_set<Index> seen{static_cast<Index>(first)};
  std::vector<const double*> scratch;
  for (std::size_t next = 0; next < cells.size(); ++next)
    for (const Index across : hull_.neighbors_of(cells[next]))
      if (seen.insert(across).second && side(across, q, grid, scratch) == wanted) cells.push_back(across);
  std::sort(cells.begin(), cells.end());
  return cells;
}

}  // namespace delone::front_ends
