// SPDX-License-Identifier: BSD-3-Clause
#include "hull/site_normals.hpp"

#include "base/infinity.hpp"

#include <cmath>
#include <numeric>

namespace delone::hull {

std::vector<double> sums_of_normals(const HullState& state) {
  const auto d = static_cast<std::size_t>(state.sites().ambient);
  const Boundary* const boundary = state.boundary();
  if (state.affine_hull().dimension() != static_cast<int>(d) || boundary == nullptr ||
      boundary->engine() == nullptr)
    return {};
  const SimplicialHull& hull = boundary->hull();
  std::vector<double> sums(state.sites().size() * d, 0.0), normal(d);
  for (std::size_t c = 0; c < hull.num_cells(); ++c) {
    const double threshold = compiled::hyperplane(*boundary->engine(), hull.slots[c], normal.data());
    const double length = std::sqrt(std::inner_product(normal.begin(), normal.end(), normal.begin(), 0.0));
    if (!(threshold < 0x1p-20 && length > 0 && length < internal::infinity)) continue;
    for (const Index site : hull.cell(c))
      for (std::size_t j = 0; j < d; ++j) sums[site * d + j] += normal[j] / length;
  }
  return sums;
}

}  // namespace delone::hull
