// SPDX-License-Identifier: BSD-3-Clause
// delone.LinearInterpolator, for real and complex values of any shape.
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
  py::class_<HeldInterpolator> bound(
      module, "LinearInterpolator",
      "LinearInterpolator(points, values, *, outside='fill', fill_value=nan, "
      "tolerance=0)\n\n"
      "The function that is linear in every cell of a triangulation and has the "
      "given values at its vertices.\n\n"
      "points: (n, d), or a Delaunay, Regular or FurthestSite triangulation of n "
      "points, to which no points may be added "
      "then.\n"
      "values: (n, ...) real or complex; of equal points that of the first counts. "
      "NaN spreads to the cells it is at.\n"
      "outside: what queries outside get, those that are not in the convex hull of "
      "the points (for flat points: nor in\n"
      "their flat), nor within the tolerance of it: fill_value ('fill'); the value at "
      "the nearest vertex ('nearest');\n"
      "an InputError that names one of them ('error'); or the value at the nearest "
      "point of the hull ('project'), which\n"
      "continues the function without a jump.\n"
      "tolerance: a distance t >= 0. Which cell a query is in, if any, is decided "
      "exactly, so with 0 the value at a point\n"
      "is the one given, and no query inside is missed. A positive tolerance gives "
      "the value at a point within t of the\n"
      "query, such that slivers made by rounding of the points do not count; see "
      "Delaunay.find_simplex. The value at a\n"
      "point is still the one given. ValueError if it is negative, NaN or infinite, and at "
      "the first query if it\n"
      "is larger than the set of points.");
  bind_function(bound);
  bound
      .def(py::init([](const py::object& points, const py::object& values, const std::string& outside,
                       const py::object& fill, double tolerance) {
             return std::make_unique<HeldInterpolator>(points, values, outside, fill, tolerance);
           }),
           "points"_a, "values"_a, py::kw_only(), "outside"_a = "fill",
           "fill_value"_a = std::numeric_limits<double>::quiet_NaN(), "tolerance"_a = 0.0)
      .def("gradient", &HeldInterpolator::gradient, "queries"_a,
           "The gradients at queries of shape (..., d): (...) + the shape of one value + (d,). Where cells "
           "meet that of one of\n"
           "them. Outside NaN, 0 for outside='nearest', and that of the cell of the nearest point for "
           "'project'. "
           "For flat points\n"
           "it is tangent to their flat.")
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
