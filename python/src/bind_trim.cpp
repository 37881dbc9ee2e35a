// SPDX-License-Identifier: BSD-3-Clause
// Triangulation.trim and its result.
#include "arrays.hpp"
#include "module.hpp"
#include "triangulation.hpp"

#include <delone/trim.hpp>

#include <algorithm>
#include <memory>
#include <string>

namespace delone::python {
namespace {

using namespace py::literals;
using Held = std::shared_ptr<TrimResult>;

std::size_t width(const TrimResult& result) {
  return static_cast<std::size_t>(result.data.affine_dimension + 1);
}

constexpr const char* trim_doc = R"(
The cells without those at the border that are so thin that every point of them is within tolerance, a distance, of
what remains: a delone.TrimResult. The triangulation stays as it is.

The depth of a cell is its height over its exposed facets, away from all of them, plus the greatest depth of these: 0
on the hull, otherwise that of the cell that was removed there. The cell of least depth is removed, again and again,
while its depth is at most tolerance; ties by the coordinates of the vertices. The last cell stays, and so does a cell
all of whose facets are exposed. Heights are computed exactly and rounded up; the order of the rows does not matter.

InputError for a tolerance that is negative, not finite, or larger than the longest side of the bounding box. Cost:
O(m k d^2) for m cells, and integers for thin cells at the border.)";

}  // namespace

void bind_trim(py::module_& module) {
  py::class_<TrimResult, Held>(module, "TrimResult", "What trim() leaves of a triangulation. Read-only.")
      .def_property_readonly(
          "cells", [](const Held& r) { return rows_view(r->data.cells, r->data.num_cells(), width(*r), r); },
          "(m', k+1) input rows: the remaining cells, in their order.")
      .def_property_readonly(
          "neighbors",
          [](const Held& r) { return rows_view(r->data.neighbors, r->data.num_cells(), width(*r), r); },
          "(m', k+1) remaining cells: neighbor j is across the facet opposite vertex j; -1 beyond the "
          "border.")
      .def_property_readonly(
          "kept",
          [](const TrimResult& r) {
            py::array_t<bool> kept(static_cast<py::ssize_t>(r.kept.size()));
            std::transform(r.kept.begin(), r.kept.end(), kept.mutable_data(),
                           [](unsigned char k) { return k != 0; });
            kept.attr("setflags")("write"_a = false);
            return kept;
          },
          "(m,) bool: whether each cell of the triangulation remains.")
      .def_property_readonly(
          "num_removed", [](const TrimResult& r) { return r.num_removed; }, "How many cells were removed.")
      .def_property_readonly(
          "orphans", [](const Held& r) { return list_view(r->orphans, r); },
          "The rows of vertices that no remaining cell has, increasing; rows merged into them are not "
          "listed.")
      .def_property_readonly(
          "depth", [](const TrimResult& r) { return r.depth; },
          "The largest depth of a removed cell, rounded up: all removed points are within it of what "
          "remains.")
      .def_property_readonly(
          "lost_volume", [](const TrimResult& r) { return r.lost_volume; },
          "The k-volume of the removed cells, rounded up.")
      .def("__repr__", [](const TrimResult& r) {
        return "<delone.TrimResult: " + std::to_string(r.data.num_cells()) + " cells, " +
               std::to_string(r.num_removed) + " removed>";
      });
  py::type triangulation = py::type::of<HeldTriangulation>();
  triangulation.attr("trim") = py::cpp_function(
      [](const HeldTriangulation& held, double tolerance) {
        Supervisor supervisor;
        return supervisor.run([&] {
          return held.with_engine(supervisor, [tolerance](const Triangulation& engine) {
            return std::make_shared<TrimResult>(trim(engine, tolerance));
          });
        });
      },
      py::name("trim"), py::is_method(triangulation), trim_doc + 1, "tolerance"_a);
}

}  // namespace delone::python
