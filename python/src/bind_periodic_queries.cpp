// SPDX-License-Identifier: BSD-3-Clause
// delone.PeriodicLinearInterpolator and delone.PeriodicNaturalNeighborInterpolator, for real and complex
// values of any shape.
#include "arrays.hpp"
#include "docs_periodic.hpp"
#include "docstring.hpp"
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
      : name_of_outside_(std::move(outside)), outside_(periodic_outside_of(name_of_outside_)), fill_(fill) {
    if (!py::isinstance<HeldPeriodic>(triangulation))
      throw py::type_error("triangulation: a PeriodicDelaunay or PeriodicRegular, not " +
                           type_name(triangulation));
    source_ = triangulation;
    const py::array given = as_numbers(values, "values");
    is_complex_ = given.dtype().kind() == 'c';
    require_fill();
    const py::object copied = is_complex_ ? py::object(given.attr("astype")("complex128", "order"_a = "C"))
                                          : as_doubles(given, "values").attr("copy")("order"_a = "C");
    copied.attr("flags").attr("writeable") = false;
    values_ = copied;
    const auto n = static_cast<py::ssize_t>(held().get().num_points());
    if (values_.ndim() < 1 || values_.shape(0) != n)
      throw py::value_error("values: a row for each of " + std::to_string(n) +
                            " points, not an array of shape " + shown(values_.attr("shape")));
    parts_ = is_complex_ ? 2 : 1;
    for (py::ssize_t axis = 1; axis < values_.ndim(); ++axis)
      parts_ *= static_cast<std::size_t>(values_.shape(axis));
    const std::span<const double> numbers{static_cast<const double*>(values_.data()),
                                          static_cast<std::size_t>(n) * parts_};
    held().ask([&](const PeriodicTriangulation& t) {
      function_ = std::make_unique<Function>(t, numbers, parts_);
      return true;
    });
  }

  py::object evaluate(const py::object& object) const {
    const Queries queries(object, held().dimension());
    return is_complex_ ? evaluate_as<std::complex<double>>(queries) : evaluate_as<double>(queries);
  }
  py::array gradient(const py::object& object) const {
    const Queries queries(object, held().dimension());
    return is_complex_ ? gradient_as<std::complex<double>>(queries) : gradient_as<double>(queries);
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
  const py::array& values() const { return values_; }
  py::tuple state() const { return py::make_tuple(source_, values_, name_of_outside_, fill_); }
  std::string repr(const char* name) const {
    return std::string("<delone.") + name + ": values " + std::string(py::str(values_.dtype())) + " " +
           std::string(py::str(values_.attr("shape"))) + " on " + std::string(py::repr(source_)) + ">";
  }

 private:
  const HeldPeriodic& held() const { return source_.cast<const HeldPeriodic&>(); }

  void require_fill() const {
    const Py_complex number = PyComplex_AsCComplex(fill_.ptr());
    if (PyErr_Occurred() != nullptr || (!is_complex_ && PyComplex_Check(fill_.ptr()) != 0)) {
      PyErr_Clear();
      throw py::type_error("fill_value: a " + std::string(is_complex_ ? "" : "real ") + "number, not " +
                           represented(fill_));
    }
    if (outside_ != Outside::fill && !std::isnan(number.real))
      throw py::value_error("fill_value: only with outside='fill', not with " +
                            messages::in_quotes(name_of_outside_));
  }

  std::vector<py::ssize_t> shape_of(const Queries& queries) const {
    const auto like = queries.answers<char>();
    std::vector<py::ssize_t> shape(like.shape(), like.shape() + like.ndim());
    shape.insert(shape.end(), values_.shape() + 1, values_.shape() + values_.ndim());
    return shape;
  }

  template <class T>
  py::object evaluate_as(const Queries& queries) const {
    py::array_t<T> result(shape_of(queries));
    const std::span<double> out{reinterpret_cast<double*>(result.mutable_data()), queries.size() * parts_};
    const auto fill = fill_.cast<T>();
    std::vector<double> constants(parts_);
    for (std::size_t i = 0; i < parts_; i += sizeof(T) / sizeof(double))
      std::memcpy(constants.data() + i, &fill, sizeof(T));
    held().ask([&, x = queries.coordinates()](const PeriodicTriangulation&) {
      function_->evaluate(x, out, {.outside = outside_, .fill = constants}, {.threads = held().threads()});
      return true;
    });
    return Queries::scalar_if_single(result);
  }

  template <class T>
  py::array gradient_as(const Queries& queries) const {
    const auto d = static_cast<std::size_t>(held().dimension());
    auto shape = shape_of(queries);
    shape.push_back(held().dimension());
    py::array_t<T> result(shape);
    std::vector<double> gradients(queries.coordinates().size() * parts_);
    held().ask([&, x = queries.coordinates()](const PeriodicTriangulation&) {
      function_->gradients(x, gradients, {.outside = outside_}, {.threads = held().threads()});
      return true;
    });
    T* const out = result.mutable_data();
    if constexpr (std::is_same_v<T, double>)
      std::copy(gradients.begin(), gradients.end(), out);
    else  // those of real and imaginary parts one after the other
      for (std::size_t i = 0; i < gradients.size() / 2; ++i)
        out[i] = {gradients[i / d * 2 * d + i % d], gradients[(i / d * 2 + 1) * d + i % d]};
    return result;
  }

  std::string name_of_outside_;
  Outside outside_;
  py::object fill_, source_;
  py::array values_;
  bool is_complex_ = false;
  std::size_t parts_ = 1;
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
      .def("natural_neighbors", &Natural::natural_neighbors, "queries"_a,
           text(docs::periodic::natural_neighbors));
}

}  // namespace delone::python
