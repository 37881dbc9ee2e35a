// SPDX-License-Identifier: BSD-3-Clause
// Cells of sites of a Triangulation: the arrays of a delone.SiteCells.
#include "arrays.hpp"
#include "module.hpp"
#include "triangulation.hpp"

#include <delone/site_cells.hpp>

#include <cstddef>
#include <utility>

namespace delone::python {
namespace {

using namespace py::literals;
using Held = HeldTriangulation;

py::tuple site_cells_of(const Held& held, bool neighbors, bool proper, const py::object& box,
                        const py::object& halfspaces) {
  SiteCellsOptions options{.faces = proper ? CellFaces::proper : CellFaces::triangulated,
                           .neighbors = neighbors};
  options.box = as_box(box);
  if (!halfspaces.is_none()) {
    const auto rows = as_doubles(halfspaces, "halfspaces");
    const auto of_rows = numbers(rows);
    options.halfspaces.assign(of_rows.begin(), of_rows.end());
  }
  // Whatever numbers cells have, so they need none.
  SiteCells cells = count(
      held, [&](const Triangulation& t) { return site_cells(t, options, {.threads = held.threads()}); });
  const std::size_t n = cells.num_rows(), d = static_cast<std::size_t>(cells.dimension);
  const bool has_edges = !cells.num_edges.empty();
  return py::make_tuple(
      list_view(std::move(cells.volumes)), rows_view(std::move(cells.centroids), n, d),
      list_view(std::move(cells.areas)), list_view(std::move(cells.num_faces)),
      list_view(std::move(cells.neighbor_offsets)), list_view(std::move(cells.neighbors)),
      list_view(std::move(cells.face_areas)), list_view(std::move(cells.distances)),
      has_edges ? py::object(list_view(std::move(cells.num_edges))) : py::object(py::none()));
}

}  // namespace

void bind_site_cells(py::module_&) {
  py::type triangulation = py::type::of<Held>();
  triangulation.attr("_site_cells") =
      py::cpp_function(&site_cells_of, py::name("_site_cells"), py::is_method(triangulation), "neighbors"_a,
                       "proper"_a, "box"_a, "halfspaces"_a);
}

}  // namespace delone::python
