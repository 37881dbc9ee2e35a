// SPDX-License-Identifier: BSD-3-Clause
// Conversions of inputs; see arrays.hpp.
#include "arrays.hpp"

#include <cstdint>

namespace delone::python {
namespace {

[[noreturn]] void refuse_inexact(const std::string& name, py::ssize_t index, const py::array& array,
                                 const py::object& value) {
  py::ssize_t per_row = 1;
  for (py::ssize_t axis = 1; axis < array.ndim(); ++axis) per_row *= array.shape(axis);
  throw py::value_error(name + ": row " + std::to_string(per_row > 0 ? index / per_row : index) + ": " +
                        std::string(py::str(value)) + " is not exact in double precision");
}

/// The first integer that float64 would round, or −1. A number beyond 2^53 is exact if its low bits are zero.
template <class T>
py::ssize_t find_inexact(const py::array& array) {
  const auto integers = py::array_t<T, py::array::c_style | py::array::forcecast>(array);
  const T* const values = integers.data();
  for (py::ssize_t i = 0; i < integers.size(); ++i) {
    const T value = values[i];
    constexpr T limit = T{1} << 53;
    if (value <= limit && (std::is_unsigned_v<T> || value >= -limit)) continue;
    const auto rounded = static_cast<double>(value);
    constexpr double end = std::is_unsigned_v<T> ? 0x1p64 : 0x1p63;
    if (rounded >= end || static_cast<T>(rounded) != value) return i;
  }
  return -1;
}

/// Whether the object is an array, of no subclass, that is C-contiguous and aligned float64 with an axis.
bool is_plain(const py::object& object) {
  const auto& api = py::detail::npy_api::get();
  if (static_cast<void*>(Py_TYPE(object.ptr())) != static_cast<void*>(api.PyArray_Type_)) return false;
  if (!py::array_t<double, py::array::c_style>::check_(object)) return false;
  const auto array = py::reinterpret_borrow<py::array>(object);
  return array.ndim() > 0 && (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
}

}  // namespace

py::array_t<double> as_doubles(const py::object& object, const std::string& name) {
  if (is_plain(object)) return py::reinterpret_borrow<py::array_t<double>>(object);
  const py::module_ numpy = py::module_::import("numpy");
  if (py::isinstance(object, numpy.attr("ma").attr("MaskedArray")) &&
      py::bool_(numpy.attr("ma").attr("is_masked")(object)))
    throw py::value_error(name + ": masked values are not numbers");
  const py::array array = numpy.attr("asarray")(object);
  const char kind = array.dtype().kind();
  if (kind == 'c') throw py::value_error(name + ": complex numbers are not real");
  if (kind != 'f' && kind != 'i' && kind != 'u' && kind != 'b' && kind != 'O')
    throw py::value_error(name + ": not numbers, but " + std::string(py::str(array.dtype())));
  py::array_t<double> doubles(numpy.attr("ascontiguousarray")(array, py::dtype::of<double>()));
  if (array.ndim() == 0) doubles = py::array_t<double>(doubles.attr("reshape")(py::tuple()));
  py::ssize_t inexact = -1;
  if ((kind == 'i' || kind == 'u') && array.itemsize() == 8)
    inexact = kind == 'i' ? find_inexact<std::int64_t>(array) : find_inexact<std::uint64_t>(array);
  else if (kind == 'O' || (kind == 'f' && array.itemsize() > 8)) {
    const py::array differs =
        py::array(numpy.attr("flatnonzero")(doubles.attr("__ne__")(array) & array.attr("__eq__")(array)));
    if (differs.size() > 0) inexact = differs[py::int_(0)].cast<py::ssize_t>();
  }
  if (inexact >= 0) refuse_inexact(name, inexact, array, array.attr("ravel")()[py::int_(inexact)]);
  return doubles;
}

py::array_t<double> as_points(const py::object& object, const std::string& name) {
  auto points = as_doubles(object, name);
  if (points.ndim() != 2 || points.shape(1) < 1)
    throw py::value_error(name + ": an array of shape (n, d), d at least 1, not " +
                          std::string(py::str(points.attr("shape"))));
  return points;
}

Queries::Queries(const py::object& object, int dimension) : array_(as_doubles(object, "queries")) {
  if (array_.ndim() < 1 || array_.shape(array_.ndim() - 1) != dimension)
    throw py::value_error("queries: an array of shape (..., " + std::to_string(dimension) + "), not " +
                          std::string(py::str(array_.attr("shape"))));
  shape_.assign(array_.shape(), array_.shape() + array_.ndim() - 1);
  size_ = static_cast<std::size_t>(array_.size()) / static_cast<std::size_t>(dimension);
}

}  // namespace delone::python
