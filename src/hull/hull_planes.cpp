// SPDX-License-Identifier: BSD-3-Clause
#include "hull/hull_planes.hpp"

#include "base/compiled_dimension.hpp"
#include "base/infinity.hpp"
#include "hull/hull_normal.hpp"

#include <cmath>

namespace delone::hull {

/// Let o be the centre and w the reach of the box, b a vertex of the cell, n the computed normal and N an
/// exact one with |N − n| ≤ e. For x in the box
///   N·(x − b) = n·(x − o) − n·(b − o) + (N − n)·(x − b).
/// The computed s = n·(x − o) is off by at most γ_(k+1)·M, M = Σ|n_j|·w_j: one rounding of a difference, one
/// of a product, at most k − 1 of sums. So is n·(b − o). The last term is at most 2e·Σw_j. Changing each x_j
/// by 2·error_j changes N·x by at most 2·Σ(|n_j| + e)·error_j. The slack covers
/// the rounding of M, of the thresholds (their terms are at most M), and products that underflow.
HullPlanes hull_planes(const BoundarySites& sites, const compiled::SimplicialHull& hull,
                       std::span<const Index> cells, const CenteredBox& box) {
  const std::size_t d = box.center.size();
  HullPlanes planes;
  planes.functions.origin = box.center;
  planes.functions.normals.resize(cells.size() * d);
  internal::with_compiled_dimension<2, 4>(d, [&](auto dimension) {
    HullNormalsIn<dimension()> normals(hull.dimension);
    std::vector<double> record(normals.stride());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto cell = hull.cell(cells[i]);
      normals.compute(sites, cell, false, record.data());
      double* const normal = planes.functions.normals.data() + i * d;
      if (!(record[d] < internal::infinity)) {
        planes.low.push_back(-internal::infinity);
        planes.high.push_back(internal::infinity);
        continue;
      }
      const double* const base = sites.point(cell[0]);
      double at_base = 0, magnitude = 0, length = 0, moved = 0;
      for (std::size_t j = 0; j < d; ++j) {
        normal[j] = record[j];
        at_base += normal[j] * (base[j] - box.center[j]);
        magnitude += std::fabs(normal[j]) * box.reach[j];
        length += box.reach[j];
        if (!box.error.empty()) moved += (std::fabs(normal[j]) + record[d]) * box.error[j];
      }
      const double slack = 1.01 * (2 * static_cast<double>(d + 4) * kernel::unit_roundoff * magnitude +
                                   2 * record[d] * length + 2 * moved) +
                           2 * kernel::underflow_allowance;
      planes.low.push_back(at_base - slack);
      planes.high.push_back(at_base + slack);
    }
  });
  return planes;
}

}  // namespace delone::hull
