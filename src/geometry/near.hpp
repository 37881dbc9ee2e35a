// SPDX-License-Identifier: BSD-3-Clause
// What Functionals asks of the edges between points (geometry/near_kernel.hpp).
#pragma once

#include "geometry/functionals.hpp"
#include "geometry/near_kernel.hpp"

#include <algorithm>

namespace delone::geometry {

template <int K, bool Lifted>
NearTask Functionals<K, Lifted>::near_task(std::span<const Index> cells, const VertexRows& rows, const double* row) const {
  const auto records = std::as_const(memory_).records();
  return {k(),
          cells,
          records.functional(0),
          records.certificate(0),
          std::as_const(memory_).links(0),
          rows,
          row,
          evaluation_error_,
          largest_lift_,
          edge_error_,
          lift_weight_.data()};
}

template <int K, bool Lifted>
void Functionals<K, Lifted>::thresholds_at(std::span<const Index> cells, const VertexRows& rows, const double* row,
                                           double* thresholds) const requires(Lifted) {
  for (std::size_t first = 0; first < cells.size(); first += near_lanes) {
    const auto some = cells.subspan(first, std::min(near_lanes, cells.size() - first));
    if (can_find_thresholds(k()))
      find_thresholds(near_task(some, rows, row), thresholds + first);
    else
      std::transform(some.begin(), some.end(), thresholds + first, [&](Index cell) { return threshold(cell); });
  }
}

template <int K, bool Lifted>
std::size_t Functionals<K, Lifted>::certify_by_edges(std::span<const HorizonFacet> facets, std::span<std::uint32_t> weak,
                                                     const VertexRows& rows, const double* query_row) requires(Lifted) {
  std::size_t num_left = 0, num_cells = 0;
  std::uint32_t of_cell[near_lanes];
  Index cells[near_lanes];
  EdgeCertificate certificates[near_lanes];
  for (std::size_t i = 0; i < weak.size(); ++i) {
    const Index created = facets[weak[i]].created;
    if (is_infinite(created)) {
      weak[num_left++] = weak[i];
    } else {
      of_cell[num_cells] = weak[i];
      cells[num_cells++] = created;
    }
    if (num_cells == 0 || (num_cells < near_lanes && i + 1 < weak.size())) continue;
    const HorizonFacet& any = facets[of_cell[0]];
    geometry::certify_by_edges(near_task({cells, num_cells}, rows, query_row), memory_.links(any.created)[any.slot],
                               certificates);
    for (std::size_t c = 0; c < num_cells; ++c) {
      const EdgeCertificate& proved = certificates[c];
      if (proved.determinant > 0)
        certify(cells[c], proved.threshold, proved.error, proved.determinant, false);
      else
        weak[num_left++] = of_cell[c];
    }
    num_cells = 0;
  }
  return num_left;
}

}  // namespace delone::geometry
