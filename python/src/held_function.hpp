// SPDX-License-Identifier: BSD-3-Clause
// What interpolators share in Python: values of any shape, real or complex, on a triangulation, what queries
// outside get, and the calls of the library.
#pragma once

#include "arrays.hpp"
#include "docs_interpolation.hpp"
#include "docstring.hpp"
#include "function_values.hpp"
#include "messages.hpp"
#include "messages/in_quotes.hpp"
#include "triangulation.hpp"

#include <delone/interpolation.hpp>

#include <cmath>
#include <cstdint>
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
    return values_.evaluate(queries, [&](std::span<double> out, std::span<const double> constants) {
      run([&, x = queries.coordinates()](const Triangulation&) {
        function_->evaluate(x, out, options(constants), how());
      });
    });
  }

  py::array gradient(const py::object& object) const {
    const Queries queries(object, triangulation());
    auto shape = values_.shape_of(queries);
    shape.push_back(triangulation().dimension());
    std::vector<double> parts(queries.coordinates().size() * values_.num_parts());
    run([&, x = queries.coordinates()](const Triangulation&) {
      function_->gradients(x, parts, options(), how());
    });
    return gradients_of_parts(parts, shape);
  }

  const py::object& source() const { return source_; }
  const py::array& values() const { return values_.array(); }
  const char* outside() const { return outside_names[static_cast<int>(outside_)]; }
  const py::object& fill() const { return values_.fill(); }
  double tolerance() const { return tolerance_; }
  LocateOptions how_to_locate() const {
    return {.tolerance = tolerance_, .project = outside_ == Outside::project};
  }

 protected:
  HeldFunction(const py::object& points, const py::object& values, const std::string& outside,
               const py::object& fill, double tolerance)
      : outside_(outside_of(outside)),
        tolerance_(checked_tolerance(tolerance)),
        source_(triangulation_of(points)),
        values_(indexed_as_rows(values), fill, outside_, outside) {}

  /// Calls make(engine, numbers, columns) without the GIL, which returns the interpolator.
  template <class Make>
  void make_function(Make make) {
    const std::span<const double> numbers = values_.numbers();
    const std::size_t parts = values_.num_parts();
    Supervisor supervisor;
    supervisor.run([&] {
      triangulation().with_engine([&](const Triangulation& engine) {
        if (numbers.size() != engine.num_rows() * parts)
          throw Error(Errc::bad_dimension, "values: " + std::to_string(numbers.size() / parts) +
                                               " rows, not one for each of " +
                                               std::to_string(engine.num_rows()) + " points");
        function_ = make(engine, numbers, parts);
        version_ = triangulation().version();
      });
    });
  }

  const HeldTriangulation& triangulation() const { return source_.cast<const HeldTriangulation&>(); }
  const Function& function() const { return *function_; }
  bool is_complex() const { return values_.is_complex(); }
  /// Real numbers per point.
  std::size_t num_parts() const { return values_.num_parts(); }

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

  /// As FunctionValues::gradients_of_parts().
  py::array gradients_of_parts(const std::vector<double>& parts,
                               const std::vector<py::ssize_t>& shape) const {
    return values_.gradients_of_parts(parts, shape, static_cast<std::size_t>(triangulation().dimension()));
  }

 private:
  /// The values, if their index is that of the points.
  const py::object& indexed_as_rows(const py::object& values) const {
    require_index(values, triangulation().row_index(), "values");
    return values;
  }
  Execution how() const { return {.threads = triangulation().threads()}; }
  EvaluateOptions options(std::span<const double> fill = {}) const {
    return {.outside = outside_, .fill = fill, .tolerance = tolerance_};
  }

  Outside outside_;
  double tolerance_;
  py::object source_;
  FunctionValues values_;
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
