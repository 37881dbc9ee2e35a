// SPDX-License-Identifier: BSD-3-Clause
// The values of an interpolator in Python, real or complex and of any shape, and the arrays that it answers
// with.
#pragma once

#include "arrays.hpp"
#include "messages.hpp"
#include "messages/in_quotes.hpp"

#include <delone/interpolation.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace delone::python {

/// A read-only copy of what as_numbers() returns, as float64 or complex128.
inline py::array read_only_copy(const py::array& array, bool is_complex, const char* name) {
  using namespace py::literals;
  const py::object copied = is_complex ? py::object(array.attr("astype")("complex128", "order"_a = "C"))
                                       : as_doubles(array, name).attr("copy")("order"_a = "C");
  copied.attr("flags").attr("writeable") = false;
  return copied;
}

/// Values (n, ...), float64 or complex128, and the constant that queries outside get. For the library complex
/// values are two columns.
class FunctionValues {
 public:
  /// Raises TypeError if the constant is no number of the kind of the values, ValueError if it is given where
  /// nothing gets it, or for values without a row.
  FunctionValues(const py::object& values, const py::object& fill, Outside outside,
                 const std::string& name_of_outside)
      : fill_(fill) {
    const py::array given = as_numbers(values, "values");
    is_complex_ = given.dtype().kind() == 'c';
    require_fill(outside, name_of_outside);
    array_ = read_only_copy(given, is_complex_, "values");
    if (array_.ndim() < 1) throw py::value_error("values: an array of shape (n, ...)");
    num_parts_ = is_complex_ ? 2 : 1;
    for (py::ssize_t axis = 1; axis < array_.ndim(); ++axis)
      num_parts_ *= static_cast<std::size_t>(array_.shape(axis));
  }

  const py::array& array() const { return array_; }
  const py::object& fill() const { return fill_; }
  bool is_complex() const { return is_complex_; }
  /// Real numbers per point.
  std::size_t num_parts() const { return num_parts_; }
  std::span<const double> numbers() const {
    return {static_cast<const double*>(array_.data()),
            static_cast<std::size_t>(array_.size()) * (is_complex_ ? 2 : 1)};
  }

  /// The shape of answers: that of the queries, and that of one value.
  std::vector<py::ssize_t> shape_of(const Queries& queries) const {
    const auto like = queries.answers<char>();
    std::vector<py::ssize_t> shape(like.shape(), like.shape() + like.ndim());
    shape.insert(shape.end(), array_.shape() + 1, array_.shape() + array_.ndim());
    return shape;
  }

  /// What evaluate(numbers, constants) writes: numbers for each query, given the constants outside.
  template <class Evaluate>
  py::object evaluate(const Queries& queries, Evaluate evaluate) const {
    return is_complex_ ? evaluate_as<std::complex<double>>(queries, evaluate)
                       : evaluate_as<double>(queries, evaluate);
  }

  /// An array of gradients in d dimensions, float64 or complex128, from those of the library: of complex
  /// numbers it has those of real and imaginary parts one after the other.
  py::array gradients_of_parts(const std::vector<double>& parts, const std::vector<py::ssize_t>& shape,
                               std::size_t d) const {
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
  void require_fill(Outside outside, const std::string& name_of_outside) const {
    const Py_complex number = PyComplex_AsCComplex(fill_.ptr());
    if (PyErr_Occurred() != nullptr || (!is_complex_ && PyComplex_Check(fill_.ptr()) != 0)) {
      PyErr_Clear();
      throw py::type_error("fill_value: a " + std::string(is_complex_ ? "" : "real ") + "number, not " +
                           represented(fill_));
    }
    if (outside != Outside::fill && !std::isnan(number.real))
      throw py::value_error("fill_value: only with outside='fill', not with " +
                            messages::in_quotes(name_of_outside));
  }

  template <class T, class Evaluate>
  py::object evaluate_as(const Queries& queries, Evaluate evaluate) const {
    py::array_t<T> result(shape_of(queries));
    const std::span<double> out{reinterpret_cast<double*>(result.mutable_data()),
                                queries.size() * num_parts_};
    const auto fill = fill_.cast<T>();
    std::vector<double> constants(num_parts_);
    for (std::size_t i = 0; i < num_parts_; i += sizeof(T) / sizeof(double))
      std::memcpy(constants.data() + i, &fill, sizeof(T));
    evaluate(out, std::span<const double>(constants));
    return Queries::scalar_if_single(result);
  }

  py::object fill_;
  py::array array_;
  bool is_complex_ = false;
  std::size_t num_parts_ = 1;
};

}  // namespace delone::python
