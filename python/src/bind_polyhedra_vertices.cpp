// SPDX-License-Identifier: BSD-3-Clause
// The compiled part of delone.polyhedra_vertices: its arrays.
#include "arrays.hpp"
#include "held_polyhedron.hpp"
#include "module.hpp"

#include <delone/polyhedra_vertices.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

py::array offsets_array(const std::vector<std::size_t>& offsets) {
  return list_view(std::vector<std::int64_t>(offsets.begin(), offsets.end()));
}

py::tuple find_polyhedra_vertices(const Doubles& matrices, const Doubles& bounds, int threads,
                                  const py::object& progress, const py::object& memory_limit,
                                  const py::object& time_limit) {
  if (matrices.ndim() != 3 || bounds.ndim() != 2) throw py::value_error("A: (n, m, d); b: (n, m)");
  const auto num_rows = static_cast<std::size_t>(bounds.shape(1));
  const auto dimension = static_cast<int>(matrices.shape(2));
  const CallArguments call{threads, progress, memory_limit, time_limit};
  const auto found = std::make_shared<const PolyhedraVertices>(
      call.run([&, a = numbers(matrices), b = numbers(bounds)](const Options& options) {
        return polyhedra_vertices(a, b, num_rows, dimension, options);
      }));
  const auto d = static_cast<std::size_t>(dimension);
  const auto rows = [&](const std::vector<double>& items) {
    return rows_view(items, items.size() / d, d, found);
  };
  return py::make_tuple(list_view(found->affine_dimensions, found), offsets_array(found->vertex_offsets),
                        rows(found->vertices), offsets_array(found->ray_offsets), rows(found->rays),
                        offsets_array(found->line_offsets), rows(found->lines));
}

}  // namespace

void bind_polyhedra_vertices(py::module_& module) {
  module.def("_polyhedra_vertices", &find_polyhedra_vertices, "A"_a, "b"_a, py::kw_only(), "threads"_a = 0,
             "progress"_a = py::none(), "memory_limit"_a = py::none(), "time_limit"_a = py::none(),
             "The arrays of delone.PolyhedraVertices, in the order of its arguments.");
}

}  // namespace delone::python
