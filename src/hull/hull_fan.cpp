// SPDX-License-Identifier: BSD-3-Clause
#include "hull/hull_fan.hpp"

#include "base/compiled_dimension.hpp"
#include "base/progress_meter.hpp"
#include "kernel/coordinate_plane.hpp"

#include <utility>

namespace delone::hull {

using compiled::SimplicialHull;
using geometry::CentralView;

namespace {

/// K is the dimension of the flat, or 0.
template <int K>
std::size_t walk(const BoundarySites& sites, const SimplicialHull& hull, const double* center,
                 const double* q, std::size_t start, const kernel::Grid& grid) {
  const std::size_t k = hull.corners();
  std::vector<const double*> simplex(k + 1, center);
  const kernel::Flat flat = sites.flat();
  for (std::size_t c = start;;) {
    internal::cancellation_point();
    for (std::size_t i = 0; i < k; ++i) simplex[i + 1] = sites.point(hull.cell(c)[i]);
    const int r =
        kernel::common_axis(flat, q, [&](int i) { return simplex[static_cast<std::size_t>(i) + 1]; });
    std::size_t out = k;
    for (std::size_t i = 0; i < k && out == k; ++i) {
      const double* vertex = simplex[i + 1];
      simplex[i + 1] = q;
      const Sign side = r == kernel::no_axis
                            ? kernel::orientation<K>(flat, simplex.data(), grid)
                            : kernel::side_off_coordinate_plane<K>(flat, simplex.data() + 1, r, center, grid);
      if (side == Sign::negative) out = i;
      simplex[i + 1] = vertex;
    }
    if (out == k) return c;
    c = hull.neighbors_of(c)[out];
  }
}

}  // namespace

CentralView view_from_inside(const BoundarySites& sites, const std::vector<Index>& simplex) {
  CentralView view(sites.grid);
  view.center.assign(static_cast<std::size_t>(sites.ambient), 0.0);
  std::vector<const double*> points;
  for (const Index site : simplex) points.push_back(sites.point(site));
  const auto orientation_of = [flat = sites.flat()](const double* const* of, const kernel::Grid& grid) {
    return internal::with_compiled_dimension<1, 6>(
        flat.axes.size(), [&](auto k) { return kernel::orientation<k()>(flat, of, grid); });
  };
  const Sign orientation = orientation_of(points.data(), sites.grid);
  view.is_inside =
      choose_interior_point(sites, simplex, view.center, [&](const double* point, const kernel::Grid& grid) {
        for (std::size_t i = 0; i < points.size(); ++i) {
          const double* const vertex = std::exchange(points[i], point);
          const Sign side = orientation_of(points.data(), grid);
          points[i] = vertex;
          if (side != orientation) return false;
        }
        return true;
      });
  view.grid.include(view.center.data());
  return view;
}

std::size_t walk_cones(const BoundarySites& sites, const SimplicialHull& hull,
                       const std::vector<double>& center, const double* q, std::size_t start,
                       const kernel::Grid& grid) {
  return internal::with_compiled_dimension<1, 6>(
      hull.corners(), [&](auto k) { return walk<k()>(sites, hull, center.data(), q, start, grid); });
}

}  // namespace delone::hull
