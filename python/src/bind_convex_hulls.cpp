// SPDX-License-Identifier: BSD-3-Clause
// The compiled part of delone.convex_hulls: its arrays, and the volumes of intersections.
#include "arrays.hpp"
#include "exact_numbers.hpp"
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
  return py::make_tuple(
      read_only(py::module_::import("numpy").attr("array")(rows)), list_view(hulls->affine_dimensions, hulls),
      offsets_view(hulls->vertex_offsets), list_view(hulls->vertices, hulls),
      offsets_view(hulls->cell_offsets), rows_view(hulls->cells, cells, d, hulls),
      rows_view(hulls->neighbors, cells, d, hulls), rows_view(hulls->equations, cells, d + 1, hulls),
      list_view(hulls->volumes, hulls), list_view(hulls->areas, hulls));
}

template <class T>
std::vector<T> as_list(const py::object& array) {
  const auto numbers = array.cast<py::array_t<T, py::array::c_style | py::array::forcecast>>();
  return {numbers.data(), numbers.data() + numbers.size()};
}

std::vector<std::size_t> as_offsets(const py::object& array) {
  const auto numbers = as_list<std::int64_t>(array);
  return {numbers.begin(), numbers.end()};
}

bool are_offsets(const std::vector<std::size_t>& offsets, std::size_t hulls, std::size_t items) {
  return offsets.size() == hulls + 1 && offsets.front() == 0 && offsets.back() == items &&
         std::is_sorted(offsets.begin(), offsets.end());
}

/// What intersection_volumes() reads. Raises ValueError for arrays that are not those of hulls, as in a
/// pickle that was changed.
ConvexHulls as_hulls(const py::object& held, int dimension, std::size_t num_points) {
  ConvexHulls hulls;
  hulls.dimension = dimension;
  hulls.affine_dimensions = as_list<int>(held.attr("affine_dimensions"));
  hulls.vertex_offsets = as_offsets(held.attr("vertex_offsets"));
  hulls.vertices = as_list<SignedIndex>(held.attr("vertices"));
  hulls.cell_offsets = as_offsets(held.attr("cell_offsets"));
  hulls.equations = as_list<double>(held.attr("equations"));
  hulls.volumes = as_list<double>(held.attr("volumes"));
  const std::size_t h = hulls.size(), width = static_cast<std::size_t>(dimension) + 1;
  bool is_sound = hulls.volumes.size() == h && hulls.equations.size() % width == 0 &&
                  are_offsets(hulls.vertex_offsets, h, hulls.vertices.size()) &&
                  are_offsets(hulls.cell_offsets, h, hulls.equations.size() / width) &&
                  std::ranges::all_of(hulls.vertices, [&](SignedIndex row) {
                    return row >= 0 && static_cast<std::size_t>(row) < num_points;
                  });
  for (std::size_t i = 0; is_sound && i < h; ++i)
    is_sound =
        hulls.affine_dimensions[i] < dimension || (hulls.vertex_offsets[i] < hulls.vertex_offsets[i + 1] &&
                                                   hulls.cell_offsets[i] < hulls.cell_offsets[i + 1]);
  if (!is_sound) throw py::value_error("not the arrays of convex hulls");
  return hulls;
}

py::array volumes_of_intersections(const py::object& held, const Offsets& pairs, int threads,
                                   const py::object& progress) {
  const auto rows = as_points(held.attr("points"), "points");
  const ConvexHulls hulls =
      as_hulls(held, static_cast<int>(rows.shape(1)), static_cast<std::size_t>(rows.shape(0)));
  std::vector<std::size_t> wanted;
  wanted.reserve(static_cast<std::size_t>(pairs.size()));
  for (py::ssize_t i = 0; i < pairs.size(); ++i) wanted.push_back(static_cast<std::size_t>(pairs.data()[i]));
  const Execution how{.threads = as_threads(threads)};
  Supervisor supervisor(progress);
  return list_view(
      supervisor.run([&, x = numbers(rows)] { return intersection_volumes(x, hulls, wanted, how); }));
}

}  // namespace

void bind_convex_hulls(py::module_& module) {
  module.def("_convex_hulls", &convex_hulls_of, "points"_a, "offsets"_a, py::kw_only(), "seed"_a = 0,
             "order"_a = "automatic", "threads"_a = 0, "progress"_a = py::none(),
             "memory_limit"_a = py::none(), "time_limit"_a = py::none(),
             "The arrays of delone.ConvexHulls, in the order of its arguments, without the offsets.");
  module.def("_intersection_volumes", &volumes_of_intersections, "hulls"_a, "pairs"_a, "threads"_a,
             "progress"_a, "The volumes for pairs of numbers of hulls of a delone.ConvexHulls.");
  module.def(
      "_doubles", &as_doubles, "object"_a, "name"_a,
      "An array-like of real numbers as C-contiguous float64, by the rules for all arguments; `name` is for "
      "messages.");
}

}  // namespace delone::python
