// SPDX-License-Identifier: BSD-3-Clause
// Cells of sites as the arguments of a delone.SiteCells.
#pragma once

#include "arrays.hpp"

#include <delone/site_cells.hpp>

#include <cstddef>
#include <utility>

namespace delone::python {

inline py::tuple as_tuple(SiteCells cells) {
  const std::size_t n = cells.num_rows(), d = static_cast<std::size_t>(cells.dimension),
                    f = cells.neighbors.size(), r = static_cast<std::size_t>(cells.rank),
                    v = cells.vertices.size() / d;
  py::object num_edges = py::none(), lattice = py::none(), vertices = py::none(), vertex_offsets = py::none(),
             face_vertices = py::none(), face_vertex_offsets = py::none();
  if (!cells.num_edges.empty()) num_edges = list_view(std::move(cells.num_edges));
  if (r > 0) lattice = rows_view(std::move(cells.neighbor_lattice), f, r);
  if (!cells.vertex_offsets.empty()) {
    vertices = rows_view(std::move(cells.vertices), v, d);
    vertex_offsets = list_view(std::move(cells.vertex_offsets));
    face_vertices = list_view(std::move(cells.face_vertices));
    face_vertex_offsets = list_view(std::move(cells.face_vertex_offsets));
  }
  return py::make_tuple(list_view(std::move(cells.volumes)), rows_view(std::move(cells.centroids), n, d),
                        list_view(std::move(cells.areas)), list_view(std::move(cells.num_faces)),
                        list_view(std::move(cells.neighbor_offsets)), list_view(std::move(cells.neighbors)),
                        list_view(std::move(cells.face_areas)), list_view(std::move(cells.distances)),
                        num_edges, lattice, vertex_offsets, vertices, face_vertex_offsets, face_vertices);
}

}  // namespace delone::python
