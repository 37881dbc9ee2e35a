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
                    f = cells.neighbors.size(), r = static_cast<std::size_t>(cells.rank);
  py::object num_edges = py::none(), lattice = py::none();
  if (!cells.num_edges.empty()) num_edges = list_view(std::move(cells.num_edges));
  if (r > 0) lattice = rows_view(std::move(cells.neighbor_lattice), f, r);
  return py::make_tuple(list_view(std::move(cells.volumes)), rows_view(std::move(cells.centroids), n, d),
                        list_view(std::move(cells.areas)), list_view(std::move(cells.num_faces)),
                        list_view(std::move(cells.neighbor_offsets)), list_view(std::move(cells.neighbors)),
                        list_view(std::move(cells.face_areas)), list_view(std::move(cells.distances)),
                        num_edges, lattice);
}

}  // namespace delone::python
