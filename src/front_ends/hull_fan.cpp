// SPDX-License-Identifier: BSD-3-Clause
#include "front_ends/hull_fan.hpp"

namespace delone::front_ends {

void HullFan::update(const HullSites& sites, const SimplicialHull& hull, std::size_t c, const double* normal) {
  const std::size_t k = hull.corners();
  const double* base = sites.point(hull.cell(c)[0]);
  double height = 0;
  for (std::size_t j = 0; j < k; ++j) {
    const auto axis = static_cast<std::size_t>(sites.axes[j]);
    height += normal[j] * ((base[axis] - center_[axis]) * scale_);
  }
  // Rounding may mislead the descent; the walk puts it right.
  for (std::size_t j = 0; j < k; ++j) gradient_[c * k + j] = height > 0 ? normal[j] / height : 0.0;
}

double HullFan::value(const HullSites& sites, std::size_t c, const double* q, std::size_t k) const {
  double h = 0;
  for (std::size_t j = 0; j < k; ++j) {
    const auto axis = static_cast<std::size_t>(sites.axes[j]);
    h += gradient_[c * k + j] * ((q[axis] - center_[axis]) * scale_);
  }
  return h;
}

std::size_t HullFan::descend(const HullSites& sites, const SimplicialHull& hull, const double* q, std::size_t start) const {
  const std::size_t k = hull.corners();
  std::size_t best = start;
  double largest = value(sites, start, q, k);
  for (;;) {
    std::size_t next = best;
    for (const Index across : hull.neighbors_of(best))
      if (const double h = value(sites, across, q, k); h > largest) largest = h, next = across;
    if (next == best) return best;
    best = next;
  }
}

std::size_t HullFan::walk(const HullSites& sites, const SimplicialHull& hull, const double* q, std::size_t start,
                          const kernel::Grid& grid) const {
  kernel::Grid grid_of_all = grid;
  grid_of_all.include(center_.data());
  const std::size_t k = hull.corners();
  std::vector<const double*> simplex(k + 1, center_.data());
  for (std::size_t c = start;;) {
    for (std::size_t i = 0; i < k; ++i) simplex[i + 1] = sites.point(hull.cell(c)[i]);
    std::size_t out = k;
    for (std::size_t i = 0; i < k && out == k; ++i) {
      const double* vertex = simplex[i + 1];
      simplex[i + 1] = q;
      if (kernel::orientation<0>(sites.flat(), simplex.data(), grid_of_all) == Sign::negative) out = i;
      simplex[i + 1] = vertex;
    }
    if (out == k) return c;
    c = hull.neighbors_of(c)[out];
  }
}

}  // namespace delone::front_ends
