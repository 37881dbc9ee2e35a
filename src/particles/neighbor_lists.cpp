// SPDX-License-Identifier: BSD-3-Clause
#include "particles/neighbor_lists.hpp"

#include "base/large_vector.hpp"
#include "base/parallel_parts.hpp"

#include <algorithm>
#include <numeric>

namespace delone::particles {
namespace {

/// REQUIRES that neighbor_offsets are made.
void join_vertices(std::span<const NeighborLists> parts, unsigned threads, SiteCells& cells) {
  const auto d = static_cast<std::size_t>(cells.dimension);
  std::vector<std::int64_t>&of_cells = cells.vertex_offsets, &of_faces = cells.face_vertex_offsets;
  of_cells.assign(cells.num_rows() + 1, 0);
  of_faces.assign(static_cast<std::size_t>(cells.neighbor_offsets.back()) + 1, 0);
  for (const NeighborLists& lists : parts) {
    const std::uint32_t* length = lists.face_lengths.data();
    for (std::size_t i = 0; i < lists.rows.size(); ++i) {
      of_cells[lists.rows[i] + 1] = lists.num_vertices[i];
      std::copy_n(length, lists.lengths[i], of_faces.data() + cells.neighbor_offsets[lists.rows[i]] + 1);
      length += lists.lengths[i];
    }
  }
  std::partial_sum(of_cells.begin(), of_cells.end(), of_cells.begin());
  std::partial_sum(of_faces.begin(), of_faces.end(), of_faces.begin());
  cells.vertices.resize(static_cast<std::size_t>(of_cells.back()) * d);
  cells.face_vertices.resize(static_cast<std::size_t>(of_faces.back()));
  internal::for_parts(
      threads, parts.size(), 1, [&](std::size_t part, std::size_t, const internal::StopPoint& stop) {
        stop();
        const NeighborLists& lists = parts[part];
        const double* vertex = lists.vertices.data();
        const SignedIndex* of_face = lists.face_vertices.data();
        for (const Index row : lists.rows) {
          const auto first = static_cast<std::size_t>(of_cells[row]),
                     last = static_cast<std::size_t>(of_cells[row + 1]);
          std::copy_n(vertex, (last - first) * d, cells.vertices.data() + first * d);
          vertex += (last - first) * d;
          const std::int64_t begin = of_faces[static_cast<std::size_t>(cells.neighbor_offsets[row])],
                             end = of_faces[static_cast<std::size_t>(cells.neighbor_offsets[row + 1])];
          std::copy_n(of_face, end - begin, cells.face_vertices.data() + begin);
          of_face += end - begin;
        }
      });
}

}  // namespace

void lay_out_lists(bool have_edges, unsigned threads, SiteCells& cells) {
  std::vector<std::int64_t>& offsets = cells.neighbor_offsets;
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  const auto size = static_cast<std::size_t>(offsets.back()), rank = static_cast<std::size_t>(cells.rank);
  // Most of the time goes into pages of memory, so arrays share threads.
  constexpr std::size_t num_arrays = 5;
  internal::for_parts(threads, num_arrays, 1,
                      [&](std::size_t array, std::size_t, const internal::StopPoint& stop) {
                        stop();
                        if (array == 0) internal::resize_large(cells.neighbor_lattice, size * rank);
                        if (array == 1) internal::resize_large(cells.face_areas, size);
                        if (array == 2) internal::resize_large(cells.distances, size);
                        if (array == 3) internal::resize_large(cells.neighbors, size);
                        if (array == 4 && have_edges) internal::resize_large(cells.num_edges, size);
                      });
}

void join_lists(std::span<NeighborLists> parts, bool have_edges, bool have_vertices, unsigned threads,
                SiteCells& cells) {
  std::vector<std::int64_t>& offsets = cells.neighbor_offsets;
  offsets.assign(cells.num_rows() + 1, 0);
  for (const NeighborLists& lists : parts)
    for (std::size_t i = 0; i < lists.rows.size(); ++i)
      offsets[lists.rows[i] + 1] = static_cast<std::int64_t>(lists.lengths[i]);
  lay_out_lists(have_edges, threads, cells);
  if (have_vertices) join_vertices(parts, threads, cells);
  const auto rank = static_cast<std::size_t>(cells.rank);
  internal::for_parts(
      threads, parts.size(), 1, [&](std::size_t part, std::size_t, const internal::StopPoint& stop) {
        stop();
        NeighborLists& lists = parts[part];
        const ListedNeighbor* neighbor = lists.neighbors.data();
        const std::int32_t* lattice = lists.lattice.data();
        for (std::size_t i = 0; i < lists.rows.size(); ++i) {
          const auto to = static_cast<std::size_t>(offsets[lists.rows[i]]);
          for (std::size_t at = to; at < to + lists.lengths[i]; ++at, ++neighbor, lattice += rank)
            put_neighbor(cells, at, *neighbor, lattice);
        }
        lists = {};
      });
}

}  // namespace delone::particles
