// SPDX-License-Identifier: BSD-3-Clause
// delone.PeriodicLinearInterpolator and delone.PeriodicNaturalNeighborInterpolator, for real and complex
// values of any shape.
#include "arrays.hpp"
#include "docs_periodic.hpp"
#include "docstring.hpp"
#include "function_values.hpp"
#include "held_periodic.hpp"
#include "messages.hpp"
#include "messages/in_quotes.hpp"
#include "module.hpp"
#include "pickling.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;

Outside periodic_outside_of(const std::string& name) {
  if (name == "fill") return Outside::fill;
  if (name == "nearest") return Outside::nearest;
  if (name == "error") return Outside::error;
  throw py::value_error("outside: 'fill', 'nearest' or 'error', not " + messages::in_quotes(name));
}

/// `Function`: an interpolator of the library. Complex values are two columns of it.
template <class Function>
class HeldPeriodicFunction {
 public:
  HeldPeriodicFunction(const py::object& triangulation, const py::object& values, std::string outside,
                       const py::object& fill)
      : name_of_outside_(std::move(outside)),
        outside_(periodic_outside_of(name_of_outside_)),
        source_(checked(triangulation)),
        values_(values, fill, outside_, name_of_outside_) {
    const auto n = static_cast<py::ssize_t>(held().get().num_points());
    if (this->values().shape(0) != n)
      throw py::value_error("values: a row for each of " + std::to_string(n) +
                            " points, not an array of shape " + shown(this->values().attr("shape")));
    held().ask([&](const PeriodicTriangulation& t) {
      function_ = std::make_unique<Function>(t, values_.numbers(), values_.num_parts());
      return true;
    });
  }

  py::object evaluate(const py::object& object) const {
    const Queries queries(object, held().dimension());
    return values_.evaluate(queries, [&](std::span<double> out, std::span<const double> constants) {
      held().ask([&, x = queries.coordinates()](const PeriodicTriangulation&) {
        function_->evaluate(x, out, {.outside = outside_, .fill = constants}, {.threads = held().threads()});
        return true;
      });
    });
  }
  py::array gradient(const py::object& object) const {
    const Queries queries(object, held().dimension());
    auto shape = values_.shape_of(queries);
    shape.push_back(held().dimension());
    std::vector<double> parts(queries.coordinates().size() * values_.num_parts());
    held().ask([&, x = queries.coordinates()](const PeriodicTriangulation&) {
      function_->gradients(x, parts, {.outside = outside_}, {.threads = held().threads()});
      return true;
    });
    return values_.gradients_of_parts(parts, shape, static_cast<std::size_t>(held().dimension()));
  }
  py::tuple natural_neighbors(const py::object& object) const {
    const Queries queries(object, held().dimension());
    PeriodicNaturalNeighbors found;
    held().ask([&, x = queries.coordinates()](const PeriodicTriangulation&) {
      found = function_->coordinates().find(x, {.threads = held().threads()});
      return true;
    });
    const std::size_t count = found.rows.size();
    return py::make_tuple(
        list_view(std::move(found.starts)), list_view(std::move(found.rows)),
        rows_view(std::move(found.offsets), count, static_cast<std::size_t>(held().get().rank())),
        list_view(std::move(found.weights)));
  }

  const py::object& source() const { return source_; }
  const py::array& values() const { return values_.array(); }
  py::tuple state() const { return py::make_tuple(source_, values(), name_of_outside_, values_.fill()); }
  std::string repr(const char* name) const {
    return std::string("<delone.") + name + ": values " + std::string(py::str(values().dtype())) + " " +
           std::string(py::str(values().attr("shape"))) + " on " + std::string(py::repr(source_)) + ">";
  }

 private:
  const HeldPeriodic& held() const { return source_.cast<const HeldPeriodic&>(); }

  static const py::object& checked(const py::object& triangulation) {
    if (!py::isinstance<HeldPeriodic>(triangulation))
      throw py::type_error("triangulation: a PeriodicDelaunay or PeriodicRegular, not " +
                           type_name(triangulation));
    return triangulation;
  }

  std::string name_of_outside_;
  Outside outside_;
  py::object source_;
  FunctionValues values_;
  std::unique_ptr<Function> function_;
};

template <class Held>
py::class_<Held> bind_periodic_function(py::module_& module, const char* name, const char* documentation) {
  py::class_<Held> bound(module, name, text(documentation));
  bound
      .def(py::init<const py::object&, const py::object&, std::string, const py::object&>(),
           "triangulation"_a, "values"_a, py::kw_only(), "outside"_a = "fill",
           "fill_value"_a = std::numeric_limits<double>::quiet_NaN())
      .def("__call__", &Held::evaluate, "queries"_a, text(docs::periodic::call))
      .def_property_readonly("triangulation", &Held::source, "The triangulation of the points.")
      .def_property_readonly("values", &Held::values,
                             "The values, (n, ...) float64 or complex128, read-only.")
      .def("__repr__", [name](const Held& held) { return held.repr(name); })
      .def(py::pickle([](const Held& held) { return held.state(); },
                      [](const py::tuple& given) {
                        return from_state(given, 4, "an interpolator", [](const py::tuple& state) {
                          return std::make_unique<Held>(state[0], state[1], state[2].cast<std::string>(),
                                                        state[3]);
                        });
                      }));
  return bound;
}

}  // namespace

void bind_periodic_queries(py::module_& module) {
  using Linear = HeldPeriodicFunction<PeriodicLinearInterpolator>;
  using Natural = HeldPeriodicFunction<PeriodicNaturalNeighborInterpolator>;
  bind_periodic_function<Linear>(module, "PeriodicLinearInterpolator", docs::periodic::linear)
      .def("gradient", &Linear::gradient, "queries"_a, text(docs::periodic::gradient));
  bind_periodic_function<Natural>(module, "PeriodicNaturalNeighborInterpolator", docs::periodic::natural)
      .def("gradient", &Natural::gradient, "queries"_a, text(docs::periodic::natural_gradient))
      .def("natural_neighbors", &Natural::natural_neighbors, "queries"_a,
           text(docs::periodic::natural_neighbors));
}

}  // namespace delone::python
