// SPDX-License-Identifier: BSD-3-Clause
// What interpolators share in Python: values of any shape, real or complex, on a triangulation, what queries
// outside get, and the calls of the library.
#pragma once

#include "arrays.hpp"
#include "docs_interpolation.hpp"
#include "docstring.hpp"
#include "messages.hpp"
#include "messages/in_quotes.hpp"
#include "triangulation.hpp"

#include <delone/interpolation.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace delone::python {

inline constexpr const char* outside_names[] = {"fill", "nearest", "error", "project"};

inline Outside outside_of(const std::string& name) {
  for (std::size_t i = 0; i < std::size(outside_names); ++i)
    if (name == outside_names[i]) return static_cast<Outside>(i);
  throw py::value_error("outside: 'fill', 'nearest', 'error' or 'project', not " + messages::in_quotes(name));
}

inline double checked_tolerance(double tolerance) {
  if (!(tolerance >= 0) || std::isinf(tolerance))
    throw py::value_error("tolerance: a finite distance >= 0, not " +
                          std::string(py::str(py::float_(tolerance))));
  return tolerance;
}

/// The triangulation itself, or the Delaunay triangulation of points.
inline py::object triangulation_of(const py::object& points) {
  return py::isinstance<HeldTriangulation>(points) ? points
                                                   : py::module_::import("delone").attr("Delaunay")(points);
}

/// `Function`: an interpolator of the library, with evaluate() and gradients(). Complex values are two
/// columns of it.
template <class Function>
class HeldFunction {
 public:
  py::object evaluate(const py::object& object) const {
    const Queries queries(object, triangulation());
    return is_complex_ ? evaluate_as<std::complex<double>>(queries) : evaluate_as<double>(queries);
  }

  py::array gradient(const py::object& object) const {
    const Queries queries(object, triangulation());
    auto shape = shape_of(queries);
    shape.push_back(triangulation().dimension());
    std::vector<double> parts(queries.coordinates().size() * parts_);
    run([&, x = queries.coordinates()](const Triangulation&) {
      function_->gradients(x, parts, options(), how());
    });
    return gradients_of_parts(parts, shape);
  }

  const py::object& source() const { return source_; }
  const py::array& values() const { return values_; }
  const char* outside() const { return outside_names[static_cast<int>(outside_)]; }
  const py::object& fill() const { return fill_; }
  double tolerance() const { return tolerance_; }
  LocateOptions how_to_locate() const {
    return {.tolerance = tolerance_, .project = outside_ == Outside::project};
  }

 protected:
  HeldFunction(const py::object& points, const py::object& values, const std::string& outside,
               const py::object& fill, double tolerance)
      : outside_(outside_of(outside)), fill_(fill), tolerance_(checked_tolerance(tolerance)) {
    source_ = triangulation_of(points);
    require_index(values, triangulation().row_index(), "values");
    values_ = as_numbers(values, "values");
    is_complex_ = values_.dtype().kind() == 'c';
    require_fill();
    values_ = own_copy(values_, "values");
    if (values_.ndim() < 1) throw py::value_error("values: an array of shape (n, ...)");
    parts_ = is_complex_ ? 2 : 1;
    for (py::ssize_t axis = 1; axis < values_.ndim(); ++axis)
      parts_ *= static_cast<std::size_t>(values_.shape(axis));
  }

  /// Calls make(engine, numbers, columns) without the GIL, which returns the interpolator.
  template <class Make>
  void make_function(Make make) {
    const std::span<const double> numbers{static_cast<const double*>(values_.data()),
                                          static_cast<std::size_t>(values_.size()) * (is_complex_ ? 2 : 1)};
    Supervisor supervisor;
    supervisor.run([&] {
      triangulation().with_engine([&](const Triangulation& engine) {
        if (numbers.size() != engine.num_rows() * parts_)
          throw Error(Errc::bad_dimension, "values: " + std::to_string(numbers.size() / parts_) +
                                               " rows, not one for each of " +
                                               std::to_string(engine.num_rows()) + " points");
        function_ = make(engine, numbers, parts_);
        version_ = triangulation().version();
      });
    });
  }

  const HeldTriangulation& triangulation() const { return source_.cast<const HeldTriangulation&>(); }
  const Function& function() const { return *function_; }
  bool is_complex() const { return is_complex_; }
  /// Real numbers per point.
  std::size_t num_parts() const { return parts_; }

  /// Calls work(engine) without the GIL.
  template <class Work>
  void run(Work work) const {
    const HeldTriangulation& held = triangulation();
    Supervisor supervisor;
    supervisor.run([&] {
      held.with_engine([&](const Triangulation& engine) {
        if (held.version() != version_)
          throw std::runtime_error("the triangulation has changed since the interpolator was made");
        work(engine);
      });
    });
  }

  /// A read-only copy of what as_numbers() returns, as float64 or complex128, as values are.
  py::array own_copy(const py::array& array, const char* name) const {
    using namespace py::literals;
    const py::object copied = is_complex_ ? py::object(array.attr("astype")("complex128", "order"_a = "C"))
                                          : as_doubles(array, name).attr("copy")("order"_a = "C");
    copied.attr("flags").attr("writeable") = false;
    return copied;
  }

  /// An array of gradients, float64 or complex128, from those of the library: of complex numbers it has those
  /// of real and imaginary parts one after the other.
  py::array gradients_of_parts(const std::vector<double>& parts,
                               const std::vector<py::ssize_t>& shape) const {
    const auto d = static_cast<std::size_t>(triangulation().dimension());
    if (!is_complex_) {
      py::array_t<double> result(shape);
      std::copy(parts.begin(), parts.end(), result.mutable_data());
      return result;
    }
    py::array_t<std::complex<double>> result(shape);
    std::complex<double>* const out = result.mutable_data();
    for (std::size_t i = 0; i < parts.size() / 2; ++i)
      out[i] = {parts[i / d * 2 * d + i % d], parts[(i / d * 2 + 1) * d + i % d]};
    return result;
  }

 private:
  /// Raises TypeError if the constant is no number of the kind of the values, ValueError if it is given where
  /// nothing gets it.
  void require_fill() const {
    const Py_complex number = PyComplex_AsCComplex(fill_.ptr());
    if (PyErr_Occurred() != nullptr || (!is_complex_ && PyComplex_Check(fill_.ptr()) != 0)) {
      PyErr_Clear();
      throw py::type_error("fill_value: a " + std::string(is_complex_ ? "" : "real ") + "number, not " +
                           represented(fill_));
    }
    if (outside_ != Outside::fill && !std::isnan(number.real))
      throw py::value_error("fill_value: only with outside='fill', not with " +
                            messages::in_quotes(outside_names[static_cast<int>(outside_)]));
  }

  Execution how() const { return {.threads = triangulation().threads()}; }
  EvaluateOptions options(std::span<const double> fill = {}) const {
    return {.outside = outside_, .fill = fill, .tolerance = tolerance_};
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
    run([&, x = queries.coordinates()](const Triangulation&) {
      function_->evaluate(x, out, options(constants), how());
    });
    return Queries::scalar_if_single(result);
  }

  Outside outside_;
  py::object fill_, source_;
  double tolerance_;
  py::array values_;
  bool is_complex_ = false;
  std::size_t parts_ = 1;
  std::uint64_t version_ = 0;
  std::unique_ptr<Function> function_;
};

/// The members that all interpolators have.
template <class Held>
void bind_function(py::class_<Held>& bound) {
  bound.def("__call__", &Held::evaluate, py::arg("queries"), text(docs::interpolation::call))
      .def_property_readonly("triangulation", &Held::source, "The triangulation of the points.")
      .def_property_readonly("values", &Held::values,
                             "The values, (n, ...) float64 or complex128, read-only.")
      .def_property_readonly("tolerance", &Held::tolerance, "The tolerance of the constructor.")
      .def("__repr__", &Held::repr);
}

}  // namespace delone::python
