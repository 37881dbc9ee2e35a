// SPDX-License-Identifier: BSD-3-Clause
#include "hull/hull_locator.hpp"

#include "base/compiled_dimension.hpp"
#include "base/progress_meter.hpp"
#include "hull/hull_fan.hpp"
#include "kernel/coordinate_plane.hpp"
#include "kernel/hull_stages.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace delone::hull {

Sign HullLocator::side(std::size_t cell, const double* q, const kernel::Grid& grid,
                       std::vector<const double*>& scratch) const {
  internal::cancellation_point();
  const auto corners = hull_.cell(cell);
  if (kernel::common_axis(sites_.flat(), q, [&](int i) {
        return sites_.point(corners[static_cast<std::size_t>(i)]);
      }) != kernel::no_axis)
    return Sign::zero;
  if (const compiled::BoundaryEngine* const engine = boundary_.engine())
    if (const Sign sign = compiled::certain_side(*engine, hull_.slots[cell], q); sign != Sign::zero)
      return sign;
  if (hull_.dimension == 1) return compiled::side_of_cell(sites_, hull_, cell, q, grid, scratch);
  scratch.clear();
  for (const Index site : corners) scratch.push_back(sites_.point(site));
  internal::StageCounts uncounted;
  return internal::with_compiled_dimension<1, 6>(hull_.corners(), [&](auto k) {
    return kernel::hull_side<k()>(sites_.flat(), scratch.data(), q, grid, uncounted);
  });
}

HullLocator::Result HullLocator::locate(const double* q, const kernel::Grid& grid) const {
  internal::cancellation_point();
  if (!has_fan()) return search_all(q, grid);
  const auto [near, sign] = approach(q);
  if (sign == Sign::negative) return {near, sign};
  // Where cells share a hyperplane, the approach may have ended at another cell than that of the cone.
  kernel::Grid grid_of_all = grid;
  grid_of_all.include(boundary_.center().data());
  const std::size_t c = walk_cones(sites_, hull_, boundary_.center(), q, near, grid_of_all);
  std::vector<const double*> scratch;
  return {c, sign == Sign::positive ? sign : side(c, q, grid, scratch)};
}

Sign HullLocator::side_of_hull(const double* q, const kernel::Grid& grid) const {
  if (has_fan())
    if (const Sign sign = approach(q).side; sign != Sign::zero) return sign;
  return locate(q, grid).side;
}

bool HullLocator::is_in_interior(const double* q, const kernel::Grid& grid) const {
  if (has_fan()) {
    const auto [near, sign] = approach(q);
    if (sign != Sign::zero) return sign == Sign::positive;
    // One hyperplane that q is on or beyond is enough.
    std::vector<const double*> scratch;
    if (side(near, q, grid, scratch) != Sign::positive) return false;
  }
  return locate(q, grid).side == Sign::positive;
}

HullLocator::Result HullLocator::locate_from(std::size_t start, const double* q,
                                             const kernel::Grid& grid) const {
  const std::size_t c = walk_cones(sites_, hull_, boundary_.center(), q, start, grid);
  std::vector<const double*> scratch;
  return {c, side(c, q, grid, scratch)};
}

bool HullLocator::has_fan() const { return boundary_.engine() != nullptr && boundary_.has_center(); }

/// A cell near the ray from the center through q, and what is certain of q: as descend().
HullLocator::Result HullLocator::approach(const double* q) const {
  // Start at the best of a sample of cells, which keeps the walk short in large hulls.
  const std::size_t m = hull_.num_cells();
  const auto sample = static_cast<std::size_t>(std::sqrt(static_cast<double>(m)) / 4) + 1;
  std::vector<Index> candidates;
  for (std::size_t i = 0; i < sample; ++i) candidates.push_back(hull_.slots[i * (m / sample)]);
  const auto [slot, sign] = compiled::descend(*boundary_.engine(), q, candidates);
  const auto at = std::lower_bound(hull_.slots.begin(), hull_.slots.end(), slot);
  return {static_cast<std::size_t>(at - hull_.slots.begin()), sign};
}

/// Without a center: a cell with q beyond its hyperplane; else one with q on it; else any cell.
HullLocator::Result HullLocator::search_all(const double* q, const kernel::Grid& grid) const {
  Result result{0, Sign::positive};
  std::vector<const double*> scratch;
  for (std::size_t c = 0; c < hull_.num_cells() && result.side != Sign::negative; ++c)
    if (const Sign sign = side(c, q, grid, scratch); static_cast<int>(sign) < static_cast<int>(result.side))
      result = {c, sign};
  return result;
}

std::vector<Index> HullLocator::cells_on_side(std::size_t first, Sign wanted, const double* q,
                                              const kernel::Grid& grid) const {
  std::vector<Index> cells{static_cast<Index>(first)};
  std::unordered_set<Index> seen{static_cast<Index>(first)};
  std::vector<const double*> scratch;
  for (std::size_t next = 0; next < cells.size(); ++next)
    for (const Index across : hull_.neighbors_of(cells[next]))
      if (seen.insert(across).second && side(across, q, grid, scratch) == wanted) cells.push_back(across);
  std::sort(cells.begin(), cells.end());
  return cells;
}

}  // namespace delone::hull
