// SPDX-License-Identifier: BSD-3-Clause
#include "particles/neighbor_lists.hpp"

#include "base/parallel_parts.hpp"

#include <algorithm>

namespace delone::particles {

void join_lists(std::span<NeighborLists> parts, bool have_edges, unsigned threads, SiteCells& cells) {
  std::vector<std::int64_t>& offsets = cells.neighbor_offsets;
  offsets.assign(cells.num_rows() + 1, 0);
  for (const NeighborLists& lists : parts)
    for (std::size_t i = 0; i < lists.rows.size(); ++i)
      offsets[lists.rows[i] + 1] = static_cast<std::int64_t>(lists.lengths[i]);
  for (std::size_t row = 0; row < cells.num_rows(); ++row) offsets[row + 1] += offsets[row];
  const auto size = static_cast<std::size_t>(offsets.back()), rank = static_cast<std::size_t>(cells.rank);
  cells.neighbors.resize(size);
  cells.face_areas.resize(size);
  cells.distances.resize(size);
  if (have_edges) cells.num_edges.resize(size);
  cells.neighbor_lattice.resize(size * rank);
  internal::for_parts(threads, parts.size(), 1,
                      [&](std::size_t part, std::size_t, const internal::StopPoint& stop) {
                        stop();
                        NeighborLists& lists = parts[part];
                        std::size_t from = 0;
                        for (std::size_t i = 0; i < lists.rows.size(); ++i) {
                          const auto to = static_cast<std::size_t>(offsets[lists.rows[i]]);
                          const std::size_t length = lists.lengths[i];
                          const auto copy = [&](const auto& items, auto& all, std::size_t width = 1) {
                            std::copy_n(items.data() + from * width, length * width, all.data() + to * width);
                          };
                          copy(lists.neighbors, cells.neighbors);
                          copy(lists.areas, cells.face_areas);
                          copy(lists.distances, cells.distances);
                          if (have_edges) copy(lists.num_edges, cells.num_edges);
                          copy(lists.lattice, cells.neighbor_lattice, rank);
                          from += length;
                        }
                        lists = {};
                      });
}

}  // namespace delone::particles
