// SPDX-License-Identifier: BSD-3-Clause
// Triangulation.trim and its result.
#include "arrays.hpp"
#include "docs_trim.hpp"
#include "docstring.hpp"
#include "module.hpp"
#include "pickling.hpp"
#include "triangulation.hpp"

#include <delone/trim.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;
/// What trim() leaves, shared by the arrays that show it.
class HeldTrim {
 public:
  explicit HeldTrim(TrimResult result) : result_(std::make_shared<const TrimResult>(std::move(result))) {}

  const TrimResult& result() const { return *result_; }
  py::array rows(const std::vector<SignedIndex>& items) const {
    return rows_view(items, result_->data.num_cells(), width(), result_);
  }
  py::array cells() const { return rows(result_->data.cells); }
  py::array neighbors() const { return rows(result_->data.neighbors); }
  py::array orphans() const { return list_view(result_->orphans, result_); }
  py::array kept() const {
    py::array_t<bool> kept(static_cast<py::ssize_t>(result_->kept.size()));
    std::transform(result_->kept.begin(), result_->kept.end(), kept.mutable_data(),
                   [](unsigned char k) { return k != 0; });
    kept.attr("setflags")("write"_a = false);
    return kept;
  }
  std::string repr() const {
    return "<delone.TrimResult: " + std::to_string(result_->data.num_cells()) + " cells, " +
           std::to_string(result_->num_removed) + " removed>";
  }
  py::tuple state() const {
    return py::make_tuple(result_->data.affine_dimension, cells(), neighbors(), kept(), orphans(),
                          result_->depth, result_->lost_volume);
  }

 private:
  std::size_t width() const { return static_cast<std::size_t>(result_->data.affine_dimension + 1); }

  std::shared_ptr<const TrimResult> result_;
};

using Numbers = py::array_t<SignedIndex, py::array::c_style>;
using Flags = py::array_t<bool, py::array::c_style>;

/// The numbers of an array of this type and shape, each at least `least` and below `end`.
std::vector<SignedIndex> checked(const py::object& object, const std::vector<py::ssize_t>& shape,
                                 SignedIndex least, std::size_t end) {
  const auto array = object.cast<Numbers>();
  const SignedIndex *const first = array.data(), *const last = first + array.size();
  if (std::vector<py::ssize_t>(array.shape(), array.shape() + array.ndim()) != shape ||
      !std::all_of(first, last,
                   [&](SignedIndex x) { return x >= least && (x < 0 || static_cast<std::size_t>(x) < end); }))
    throw py::value_error("not the state of a trimmed triangulation");
  return {first, last};
}

HeldTrim restored_trim(const py::tuple& given) {
  return from_state(given, 7, "a trimmed triangulation", [](const py::tuple& state) {
    TrimResult result;
    result.data.affine_dimension = state[0].cast<int>();
    const auto kept = state[3].cast<Flags>();
    if (result.data.affine_dimension < -1 ||
        result.data.affine_dimension == std::numeric_limits<int>::max() || kept.ndim() != 1)
      throw py::value_error("not the state of a trimmed triangulation");
    for (const bool* flag = kept.data(); flag != kept.data() + kept.size(); ++flag)
      result.kept.push_back(*flag ? 1 : 0);
    const auto cells = std::count(result.kept.begin(), result.kept.end(), 1);
    const std::vector<py::ssize_t> shape{cells, py::ssize_t{result.data.affine_dimension} + 1};
    constexpr std::size_t any = max_index;
    result.data.cells = checked(state[1], shape, 0, any);
    result.data.neighbors = checked(state[2], shape, -1, static_cast<std::size_t>(cells));
    result.num_removed = result.kept.size() - static_cast<std::size_t>(cells);
    const auto num_orphans = state[4].cast<py::array>().size();
    result.orphans = checked(state[4], {num_orphans}, 0, any);
    result.depth = state[5].cast<double>();
    result.lost_volume = state[6].cast<double>();
    return HeldTrim(std::move(result));
  });
}

}  // namespace

void bind_trim(py::module_& module) {
  py::class_<HeldTrim>(module, "TrimResult", text(docs::trim::result))
      .def_property_readonly("cells", &HeldTrim::cells,
                             "The remaining cells, (m', k+1) input rows, in their order.")
      .def_property_readonly("neighbors", &HeldTrim::neighbors,
                             "The neighbors of each cell, (m', k+1) remaining cells: number j is opposite "
                             "vertex j, -1 at the border.")
      .def_property_readonly("kept", &HeldTrim::kept,
                             "Whether each cell of the triangulation remains, (m,) bool.")
      .def_property_readonly(
          "num_removed", [](const HeldTrim& r) { return r.result().num_removed; },
          "The number of removed cells.")
      .def_property_readonly(
          "orphans", &HeldTrim::orphans,
          "The rows of vertices without a remaining cell, increasing; rows merged into them are not listed.")
      .def_property_readonly(
          "depth", [](const HeldTrim& r) { return r.result().depth; },
          "The largest depth of a removed cell, rounded up: all removed points are within it of the "
          "remaining cells.")
      .def_property_readonly(
          "lost_volume", [](const HeldTrim& r) { return r.result().lost_volume; },
          "The k-volume of the removed cells, rounded up.")
      .def("__repr__", &HeldTrim::repr)
      .def(py::pickle([](const HeldTrim& held) { return held.state(); }, &restored_trim));
  py::type triangulation = py::type::of<HeldTriangulation>();
  triangulation.attr("trim") = py::cpp_function(
      [](const HeldTriangulation& held, double tolerance) {
        Supervisor supervisor;
        return supervisor.run([&] {
          return held.with_engine(
              [tolerance](const Triangulation& engine) { return HeldTrim(trim(engine, tolerance)); });
        });
      },
      py::name("trim"), py::is_method(triangulation), text(docs::trim::trim), "tolerance"_a);
}

}  // namespace delone::python
