// SPDX-License-Identifier: BSD-3-Clause
// The members of Functionals that use the edges between points (geometry/near_kernel.hpp).
#pragma once

#include "geometry/functionals.hpp"
#include "geometry/near_kernel.hpp"

#include <algorithm>

namespace delone::geometry {

template <int K, bool Lifted>
NearTask Functionals<K, Lifted>::near_task(std::span<const Index> cells, const VertexRows& rows,
                                           const double* row) const {
  const auto records = std::as_const(memory_).records();
  return {k(),
          cells,
          records.functional(0),
          records.certificate(0),
          std::as_const(memory_).links(0),
          memory_.layout().vertex_ids(),
          rows,
          row,
          evaluation_error_,
          largest_lift_,
          edge_error_,
          bend_,
          lift_weight_.data()};
}

template <int K, bool Lifted>
void Functionals<K, Lifted>::thresholds_at(std::span<const Index> cells, const VertexRows& rows,
                                           const double* row, double* thresholds) const requires(Lifted) {
  for (std::size_t first = 0; first < cells.size(); first += near_lanes) {
    const auto some = cells.subspan(first, std::min(near_lanes, cells.size() - first));
    if (can_find_thresholds(k()))
      find_thresholds(near_task(some, rows, row), thresholds + first);
    else
      std::transform(some.begin(), some.end(), thresholds + first,
                     [&](Index cell) { return threshold(cell); });
  }
}

template <int K, bool Lifted>
std::size_t Functionals<K, Lifted>::certify_by_edges(std::span<const HorizonFacet> facets,
                                                     std::span<std::uint32_t> weak, const VertexRows& rows,
                                                     const double* query_row) requires(Lifted) {
  std::size_t num_left = 0;
  Index cells[near_lanes];
  EdgeCertificate certificates[near_lanes];
  for (std::size_t first = 0; first < weak.size(); first += near_lanes) {
    const auto some = weak.subspan(first, std::min(near_lanes, weak.size() - first));
    for (std::size_t i = 0; i < some.size(); ++i) cells[i] = facets[some[i]].created;
    const HorizonFacet& any = facets[some[0]];
    geometry::certify_by_edges(near_task({cells, some.size()}, rows, query_row),
                               memory_.layout().vertex(memory_.links(any.created), any.slot), certificates);
    for (std::size_t i = 0; i < some.size(); ++i) {
      const EdgeCertificate& proved = certificates[i];
      if (proved.is_final)
        certify(cells[i], proved.threshold, proved.error, proved.determinant, is_infinite(cells[i]));
      else
        weak[num_left++] = some[i];
    }
  }
  return num_left;
}

}  // namespace delone::geometry
