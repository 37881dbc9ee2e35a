// SPDX-License-Identifier: BSD-3-Clause
// delone.LinearInterpolator, for real and complex values of any shape. The library computes the sums.
#include "arrays.hpp"
#include "module.hpp"
#include "triangulation.hpp"

#include <delone/interpolation.hpp>

#include <cmath>
#include <complex>
#include <cstring>
#include <limits>
#include <string>

namespace delone::python {
namespace {

using namespace py::literals;
using Complex128 = std::complex<double>;

class HeldInterpolator {
 public:
  HeldInterpolator(const py::object& points, const py::object& values, const std::string& outside,
                   const py::object& fill, double tolerance)
      : outside_(outside_of(outside)), fill_(fill), tolerance_(tolerance) {
    if (!(tolerance >= 0) || std::isinf(tolerance))
      throw py::value_error("tolerance: a finite distance >= 0, not " +
                            std::string(py::str(py::float_(tolerance))));
    source_ = py::isinstance<HeldTriangulation>(points)
                  ? points
                  : py::module_::import("delone").attr("Delaunay")(points);
    values_ = py::module_::import("numpy").attr("asarray")(values);
    is_complex_ = values_.dtype().kind() == 'c';
    const py::object copied = is_complex_ ? py::object(values_.attr("astype")("complex128", "order"_a = "C"))
                                          : as_doubles(values_, "values").attr("copy")("order"_a = "C");
    copied.attr("flags").attr("writeable") = false;
    values_ = copied;
    if (values_.ndim() < 1) throw py::value_error("values: an array of shape (n, ...)");
    std::size_t columns = is_complex_ ? 2 : 1;
    for (py::ssize_t axis = 1; axis < values_.ndim(); ++axis)
      columns *= static_cast<std::size_t>(values_.shape(axis));
    parts_ = columns;
    const std::span<const double> numbers{static_cast<const double*>(values_.data()),
                                          static_cast<std::size_t>(values_.size()) * (is_complex_ ? 2 : 1)};
    Supervisor supervisor;
    supervisor.run([&] {
      triangulation().with_engine(supervisor, [&](const Triangulation& engine) {
        if (numbers.size() != engine.num_rows() * columns)
          throw Error(Errc::bad_dimension,
                      "values: not one row for each of " + std::to_string(engine.num_rows()) + " points");
        function_ = std::make_unique<LinearInterpolator>(engine, numbers, columns);
        version_ = triangulation().version();
      });
    });
  }

  py::object evaluate(const py::object& object) const {
    const Queries queries(object, triangulation().dimension());
    return is_complex_ ? evaluate_as<Complex128>(queries) : evaluate_as<double>(queries);
  }

  py::array gradient(const py::object& object) const {
    const Queries queries(object, triangulation().dimension());
    const auto d = static_cast<std::size_t>(triangulation().dimension());
    auto shape = shape_of(queries);
    shape.push_back(static_cast<py::ssize_t>(d));
    if (!is_complex_) {
      py::array_t<double> result(shape);
      gradients_into(queries, result.mutable_data());
      return result;
    }
    // The library returns the gradients of real and imaginary parts one after the other.
    py::array_t<Complex128> result(shape);
    std::vector<double> parts(static_cast<std::size_t>(result.size()) * 2);
    gradients_into(queries, parts.data());
    Complex128* const out = result.mutable_data();
    for (std::size_t i = 0; i < static_cast<std::size_t>(result.size()); ++i) {
      const std::size_t value = i / d, axis = i % d;
      out[i] = {parts[2 * value * d + axis], parts[(2 * value + 1) * d + axis]};
    }
    return result;
  }

  std::string repr() const {
    std::string shape = std::string(py::str(values_.attr("shape")));
    return "<delone.LinearInterpolator: values " + std::string(py::str(values_.dtype())) + " " + shape +
           " on " + std::string(py::repr(source_)) + ">";
  }
  py::tuple state() const {
    const char* const names[] = {"fill", "nearest", "error", "project"};
    return py::make_tuple(source_, values_, names[static_cast<int>(outside_)], fill_, tolerance_);
  }
  const py::object& source() const { return source_; }
  const py::array& values() const { return values_; }
  double tolerance() const { return tolerance_; }

 private:
  static Outside outside_of(const std::string& name) {
    if (name == "fill") return Outside::fill;
    if (name == "nearest") return Outside::nearest;
    if (name == "error") return Outside::error;
    if (name == "project") return Outside::project;
    throw py::value_error("outside: 'fill', 'nearest', 'error' or 'project', not '" + name + "'");
  }

  const HeldTriangulation& triangulation() const { return source_.cast<const HeldTriangulation&>(); }

  std::vector<py::ssize_t> shape_of(const Queries& queries) const {
    const auto like = queries.answers<char>();
    std::vector<py::ssize_t> shape(like.shape(), like.shape() + like.ndim());
    shape.insert(shape.end(), values_.shape() + 1, values_.shape() + values_.ndim());
    return shape;
  }

  template <class Work>
  void run(Work work) const {
    const HeldTriangulation& held = triangulation();
    Supervisor supervisor;
    supervisor.run([&] {
      held.with_engine(supervisor, [&](const Triangulation&) {
        if (held.version() != version_)
          throw std::runtime_error("points were added to the triangulation since the interpolator was made");
        work([&](std::size_t) { return supervisor.go_on(0); });
      });
    });
  }

  template <class T>
  py::object evaluate_as(const Queries& queries) const {
    py::array_t<T> result(shape_of(queries));
    const std::span<double> out{reinterpret_cast<double*>(result.mutable_data()), queries.size() * parts_};
    const auto fill = fill_.cast<T>();
    std::vector<double> constants(parts_);
    for (std::size_t i = 0; i < parts_; i += sizeof(T) / sizeof(double))
      std::memcpy(constants.data() + i, &fill, sizeof(T));
    run([&, x = queries.coordinates()](const LinearInterpolator::Progress& progress) {
      function_->evaluate(
          x, out, {.outside = outside_, .fill = constants, .tolerance = tolerance_, .progress = progress});
    });
    return Queries::scalar_if_single(result);
  }

  void gradients_into(const Queries& queries, double* out) const {
    const std::span<double> result{out, queries.coordinates().size() * parts_};
    run([&, x = queries.coordinates()](const LinearInterpolator::Progress& progress) {
      function_->gradients(x, result,
                           {.outside = outside_, .fill = {}, .tolerance = tolerance_, .progress = progress});
    });
  }

  Outside outside_;
  py::object fill_, source_;
  double tolerance_;
  py::array values_;
  bool is_complex_ = false;
  std::size_t parts_ = 1;  // real numbers per point
  std::uint64_t version_ = 0;
  std::unique_ptr<LinearInterpolator> function_;
};

}  // namespace

void bind_interpolator(py::module_& module) {
  py::class_<HeldInterpolator>(
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
      "is larger than the set of points.")
      .def(py::init([](const py::object& points, const py::object& values, const std::string& outside,
                       const py::object& fill, double tolerance) {
             return std::make_unique<HeldInterpolator>(points, values, outside, fill, tolerance);
           }),
           "points"_a, "values"_a, py::kw_only(), "outside"_a = "fill",
           "fill_value"_a = std::numeric_limits<double>::quiet_NaN(), "tolerance"_a = 0.0)
      .def("__call__", &HeldInterpolator::evaluate, "queries"_a,
           "The values at queries of shape (..., d), in the shape (...) followed by that of one value; "
           "float64 or complex128.")
      .def("gradient", &HeldInterpolator::gradient, "queries"_a,
           "The gradients at queries of shape (..., d): (...) + the shape of one value + (d,). Where cells "
           "meet that of one of\n"
           "them. Outside NaN, 0 for outside='nearest', and that of the cell of the nearest point for "
           "'project'. "
           "For flat points\n"
           "it is tangent to their flat.")
      .def_property_readonly("triangulation", &HeldInterpolator::source, "The triangulation.")
      .def_property_readonly("values", &HeldInterpolator::values,
                             "(n, ...) the values, float64 or complex128, read-only.")
      .def_property_readonly("tolerance", &HeldInterpolator::tolerance, "The tolerance.")
      .def("__repr__", &HeldInterpolator::repr)
      .def(py::pickle([](const HeldInterpolator& held) { return held.state(); },
                      [](const py::tuple& state) {
                        return std::make_unique<HeldInterpolator>(state[0], state[1],
                                                                  state[2].cast<std::string>(), state[3],
                                                                  state[4].cast<double>());
                      }));
}

}  // namespace delone::python
