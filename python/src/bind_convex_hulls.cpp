// SPDX-License-Identifier: BSD-3-Clause
// The compiled part of delone.convex_hulls: its arrays.
#include "arrays.hpp"
#include "module.hpp"
#include "running.hpp"

#include <delone/convex_hulls.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;

using Offsets = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

py::array offsets_view(const std::vector<std::size_t>& offsets) {
  return list_view(std::vector<std::int64_t>(offsets.begin(), offsets.end()));
}

py::tuple convex_hulls_of(const py::object& points, const Offsets& offsets, std::uint64_t seed,
                          std::string order, int threads, const py::object& progress,
                          const py::object& memory_limit, const py::object& time_limit) {
  const auto rows = as_points(points, "points");
  const BuildArguments arguments{seed, std::move(order), threads, as_memory_limit(memory_limit),
                                 as_time_limit(time_limit)};
  std::vector<std::size_t> bounds(static_cast<std::size_t>(offsets.size()));
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (offsets.data()[i] < 0) throw py::value_error("offsets: a negative number");
    bounds[i] = static_cast<std::size_t>(offsets.data()[i]);
  }
  const int dimension = static_cast<int>(rows.shape(1));
  Supervisor supervisor(progress);
  auto hulls = std::make_shared<ConvexHulls>(supervisor.run(
      [&, x = numbers(rows)] { return convex_hulls(x, dimension, bounds, arguments.to_options()); }));
  const auto d = static_cast<std::size_t>(dimension);
  const std::size_t cells = hulls->cells.size() / d;
  return py::make_tuple(list_view(hulls->affine_dimensions, hulls), offsets_view(hulls->vertex_offsets),
                        list_view(hulls->vertices, hulls), offsets_view(hulls->cell_offsets),
                        rows_view(hulls->cells, cells, d, hulls),
                        rows_view(hulls->neighbors, cells, d, hulls),
                        rows_view(hulls->equations, cells, d + 1, hulls), list_view(hulls->volumes, hulls),
                        list_view(hulls->areas, hulls));
}

}  // namespace

void bind_convex_hulls(py::module_& module) {
  module.def("_convex_hulls", &convex_hulls_of, "points"_a, "offsets"_a, py::kw_only(), "seed"_a = 0,
             "order"_a = "automatic", "threads"_a = 0, "progress"_a = py::none(),
             "memory_limit"_a = py::none(), "time_limit"_a = py::none(),
             "The arrays of delone.ConvexHulls, in the order of its arguments.");
  module.def(
      "_doubles", &as_doubles, "object"_a, "name"_a,
      "An array-like of real numbers as C-contiguous float64, by the rules for all arguments; `name` is for "
      "messages.");
}

}  // namespace delone::python
