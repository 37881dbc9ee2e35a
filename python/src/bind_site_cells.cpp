// SPDX-License-Identifier: BSD-3-Clause
// Cells of sites of a Triangulation: the arrays of a delone.SiteCells.
#include "arrays.hpp"
#include "module.hpp"
#include "site_cells.hpp"
#include "triangulation.hpp"

#include <delone/site_cells.hpp>

namespace delone::python {
namespace {

using namespace py::literals;
using Held = HeldTriangulation;

py::tuple site_cells_of(const Held& held, bool neighbors, bool vertices, bool proper, const py::object& box,
                        const py::object& halfspaces) {
  SiteCellsOptions options{.faces = proper ? CellFaces::proper : CellFaces::triangulated,
                           .neighbors = neighbors,
                           .vertices = vertices};
  options.box = as_box(box);
  if (!halfspaces.is_none()) {
    const auto rows = as_doubles(halfspaces, "halfspaces");
    const auto of_rows = numbers(rows);
    options.halfspaces.assign(of_rows.begin(), of_rows.end());
  }
  // Whatever numbers cells have, so they need none.
  return as_tuple(count(
      held, [&](const Triangulation& t) { return site_cells(t, options, {.threads = held.threads()}); }));
}

}  // namespace

void bind_site_cells(py::module_&) {
  py::type triangulation = py::type::of<Held>();
  triangulation.attr("_site_cells") =
      py::cpp_function(&site_cells_of, py::name("_site_cells"), py::is_method(triangulation), "neighbors"_a,
                       "vertices"_a, "proper"_a, "box"_a, "halfspaces"_a);
}

}  // namespace delone::python
