// SPDX-License-Identifier: BSD-3-Clause
// delone.LinearInterpolator, for real and complex values of any shape.
#include "docs_interpolation.hpp"
#include "docstring.hpp"
#include "held_function.hpp"
#include "module.hpp"
#include "pickling.hpp"

#include <limits>
#include <string>

namespace delone::python {
namespace {

using namespace py::literals;

class HeldInterpolator : public HeldFunction<LinearInterpolator> {
 public:
  HeldInterpolator(const py::object& points, const py::object& values, const std::string& outside,
                   const py::object& fill, double tolerance)
      : HeldFunction(points, values, outside, fill, tolerance) {
    make_function([](const Triangulation& engine, std::span<const double> numbers, std::size_t columns) {
      return std::make_unique<LinearInterpolator>(engine, numbers, columns);
    });
  }

  std::string repr() const {
    return "<delone.LinearInterpolator: values " + std::string(py::str(values().dtype())) + " " +
           std::string(py::str(values().attr("shape"))) + " on " + std::string(py::repr(source())) + ">";
  }
  py::tuple state() const { return py::make_tuple(source(), values(), outside(), fill(), tolerance()); }
};

}  // namespace

void bind_interpolator(py::module_& module) {
  py::class_<HeldInterpolator> bound(module, "LinearInterpolator", text(docs::interpolation::linear));
  bind_function(bound);
  bound
      .def(py::init([](const py::object& points, const py::object& values, const std::string& outside,
                       const py::object& fill, double tolerance) {
             return std::make_unique<HeldInterpolator>(points, values, outside, fill, tolerance);
           }),
           "points"_a, "values"_a, py::kw_only(), "outside"_a = "fill",
           "fill_value"_a = std::numeric_limits<double>::quiet_NaN(), "tolerance"_a = 0.0)
      .def("gradient", &HeldInterpolator::gradient, "queries"_a, text(docs::interpolation::gradient))
      .def(py::pickle([](const HeldInterpolator& held) { return held.state(); },
                      [](const py::tuple& given) {
                        return from_state(given, 5, "an interpolator", [](const py::tuple& state) {
                          return std::make_unique<HeldInterpolator>(state[0], state[1],
                                                                    state[2].cast<std::string>(), state[3],
                                                                    state[4].cast<double>());
                        });
                      }));
}

}  // namespace delone::python
