// SPDX-License-Identifier: BSD-3-Clause
#include "hull/wall_order.hpp"

#include "hull/hull_analysis.hpp"
#include "kernel/stages.hpp"

#include <algorithm>
#include <vector>

namespace delone::hull {
namespace {

class Walls {
 public:
  explicit Walls(const HullState& hull) : hull_(hull), analysis_(hull), grid_(hull.sites().grid) {
    grid_.include(hull.boundary()->center().data());
    const Lists& cells_of_facet = analysis_.faces().cells_of_facet;
    for (std::size_t f = 0; f < cells_of_facet.size(); ++f) {
      const auto cell = hull.hull().cell(cells_of_facet[f][0]);
      for (std::size_t axis = 0; axis < cell.size(); ++axis) {
        const double value = hull.sites().point(cell[0])[axis];
        if (std::all_of(cell.begin(), cell.end(),
                        [&](Index site) { return hull.sites().point(site)[axis] == value; }))
          axis_parallel_.push_back({axis, value, f});
      }
    }
  }

  /// 0 for a site in the interior, and a number for each facet. A site of the hull that is on the hyperplane
  /// of a facet is on the facet.
  std::size_t wall(Index site) {
    for (const auto& [axis, value, facet] : axis_parallel_)
      if (hull_.sites().point(site)[axis] == value) return 1 + facet;
    const HullLocator::Result found =
        analysis_.locator()->locate_from(cell_, hull_.sites().point(site), grid_);
    cell_ = found.cell;
    return found.side == Sign::positive ? 0 : 1 + std::size_t{analysis_.faces().facet_of_cell[cell_]};
  }

  /// Whether at least a quarter of some sites are on facets.
  bool are_many(const std::vector<Index>& sites) {
    constexpr std::size_t sample = 64;
    if (sites.size() < 2 * sample) return false;
    std::size_t on_walls = 0;
    for (std::size_t i = 0; i < sample; ++i) on_walls += wall(sites[i * (sites.size() / sample)]) > 0 ? 1 : 0;
    return on_walls >= sample / 4;
  }

 private:
  /// A facet in the hyperplane of a coordinate with this value.
  struct AxisParallel {
    std::size_t axis;
    double value;
    std::size_t facet;
  };

  const HullState& hull_;
  HullAnalysis analysis_;
  std::vector<AxisParallel> axis_parallel_;
  kernel::Grid grid_;
  std::size_t cell_ = 0;
};

}  // namespace

bool order_by_walls(const HullState& hull, std::vector<Index>& sites) {
  const Boundary* const boundary = hull.boundary();
  if (!boundary || !HullLocator(hull.sites(), *boundary).has_fan()) return false;
  Walls walls(hull);
  if (!walls.are_many(sites)) return false;
  struct Place {
    std::size_t wall;
    double first;  ///< the first coordinate, which mostly decides
    Index site;
  };
  std::vector<Place> order;
  order.reserve(sites.size());
  for (const Index site : sites) order.push_back({walls.wall(site), hull.sites().point(site)[0], site});
  const int d = hull.sites().ambient;
  std::sort(order.begin(), order.end(), [&](const Place& a, const Place& b) {
    if (a.wall != b.wall) return a.wall < b.wall;
    if (a.first != b.first) return a.first < b.first;
    return kernel::lexicographically_less(hull.sites().point(a.site), hull.sites().point(b.site), d);
  });
  std::transform(order.begin(), order.end(), sites.begin(), [](const Place& place) { return place.site; });
  return true;
}

}  // namespace delone::hull
