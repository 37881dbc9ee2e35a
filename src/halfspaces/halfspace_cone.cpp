// SPDX-License-Identifier: BSD-3-Clause
#include "halfspaces/halfspace_cone.hpp"

#include "kernel/hull_stages.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace delone::halfspaces {

using geometry::CentralView;
using sites::BoundarySites;

namespace {

Sign orientation_of(const BoundarySites& sites, const std::vector<const double*>& rows) {
  internal::StageCounts uncounted;
  return kernel::homogeneous_orientation<0>(sites.flat(), rows.data(), uncounted);
}

}  // namespace

/// The sum of the simplex' rows, each times a power of two near 1/s: dual points count alike. Sums of few
/// bits are tried first, as they keep determinants of lattices exact.
CentralView view_from_inside(const BoundarySites& sites, const std::vector<Index>& simplex,
                             const InteriorPoint& p) {
  CentralView view(sites.grid);
  const auto row_size = static_cast<std::size_t>(sites.ambient);
  std::vector<const double*> rows;
  for (const Index site : simplex) rows.push_back(sites.point(site));
  const Sign orientation = orientation_of(sites, rows);
  std::vector<int> axes(sites.axes.begin(), sites.axes.end() - 1);
  view.dual_of_center.assign(2 * axes.size(), 0.0);
  for (const bool coarse : {true, false}) {
    view.center.assign(row_size, 0.0);
    for (const double* row : rows) {
      double s = -row[row_size - 1];
      for (std::size_t j = 0; j + 1 < row_size; ++j) s -= row[j] * p.rounded[j];
      if (!(s > 0 && std::isfinite(s))) s = *std::max_element(row, row + row_size);
      if (!(s > 0)) s = 1;
      for (std::size_t j = 0; j < row_size; ++j) view.center[j] += std::ldexp(row[j], -std::ilogb(s));
    }
    for (double& x : view.center)
      if (const double unit = coarse && std::isfinite(x) && x != 0 ? std::ldexp(1.0, std::ilogb(x) - 10) : 0;
          unit > 0)
        x = std::nearbyint(x / unit) * unit;
    if (!std::all_of(view.center.begin(), view.center.end(), [](double x) { return std::isfinite(x); }))
      continue;
    view.is_inside = true;
    for (std::size_t i = 0; i < rows.size() && view.is_inside; ++i) {
      const double* const row = std::exchange(rows[i], view.center.data());
      view.is_inside = orientation_of(sites, rows) == orientation;
      rows[i] = row;
    }
    if (!view.is_inside) continue;
    dual_point(view.center.data(), p, axes, view.dual_of_center.data());
    break;
  }
  return view;
}

Sign side_of_cell(const hull::Boundary& boundary, const SimplicialHull& hull, std::size_t c, Index site) {
  if (boundary.engine() == nullptr) return boundary.side_of_end(c, site);
  return compiled::side_of_slot(*boundary.engine(), hull.slots[c], site);
}

std::optional<Index> cell_through(const hull::Boundary& boundary, const SimplicialHull& hull, Index site) {
  // For k = 1 a site in no cell is a ray between two others.
  if (boundary.engine() == nullptr || boundary.is_surely_interior(site)) return std::nullopt;
  const auto slot = compiled::slot_through(*boundary.engine(), site);
  if (!slot) return std::nullopt;
  return static_cast<Index>(std::lower_bound(hull.slots.begin(), hull.slots.end(), *slot) -
                            hull.slots.begin());
}

}  // namespace delone::halfspaces
