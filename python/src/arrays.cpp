// SPDX-License-Identifier: BSD-3-Clause
// Conversions of inputs; see arrays.hpp.
#include "arrays.hpp"

#include <delone/error.hpp>

#include <cstdint>
#include <limits>

namespace delone::python {
namespace {

/// The value as Python shows it, cut where it is long; its type if Python has no text for it, as for integers
/// of thousands of digits.
std::string shown(const py::handle& value) {
  constexpr std::size_t longest = 40;
  std::string text;
  try {
    text = py::str(value);
  } catch (py::error_already_set&) {
    text = "a huge " + std::string(py::str(py::type::handle_of(value).attr("__name__")));
  }
  return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

/// Raises InputError for entry `index` of the array, naming its row.
[[noreturn]] void refuse_entry(const std::string& name, py::ssize_t index, const py::array& array,
                               const std::string& why) {
  py::ssize_t per_row = 1;
  for (py::ssize_t axis = 1; axis < array.ndim(); ++axis) per_row *= array.shape(axis);
  const auto row = static_cast<std::size_t>(per_row > 0 ? index / per_row : index);
  throw Error(Errc::invalid_argument, name + ": row " + std::to_string(row) + ": " + why, {row});
}

/// Raises InputError for the first object that is no number, or one beyond the range of float64.
void refuse_objects(const std::string& name, const py::array& array) {
  const py::object flat = array.attr("ravel")();
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    const py::object value = flat[py::int_(i)];
    const bool is_text = PyUnicode_Check(value.ptr()) != 0 || PyBytes_Check(value.ptr()) != 0;
    const auto number = py::reinterpret_steal<py::object>(is_text ? nullptr : PyNumber_Float(value.ptr()));
    if (number) continue;
    const bool is_large = !is_text && PyErr_ExceptionMatches(PyExc_OverflowError) != 0;
    PyErr_Clear();
    if (value.is_none()) refuse_entry(name, i, array, "None is not a number");
    if (is_large) refuse_entry(name, i, array, shown(value) + " is beyond the range of double precision");
    refuse_entry(name, i, array, "a " + shown(py::type::of(value).attr("__name__")) + " is not a number");
  }
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
  if (kind == 'O') refuse_objects(name, array);
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
  if (inexact >= 0)
    refuse_entry(name, inexact, array,
                 shown(array.attr("ravel")()[py::int_(inexact)]) + " is not exact in double precision");
  return doubles;
}

py::array_t<double> as_points(const py::object& object, const std::string& name) {
  auto points = as_doubles(object, name);
  if (points.ndim() != 2 || points.shape(1) < 1)
    throw py::value_error(name + ": an array of shape (n, d), d at least 1, not " +
                          std::string(py::str(points.attr("shape"))));
  if (points.shape(1) > std::numeric_limits<int>::max() - 1)
    throw Error(Errc::bad_dimension, name + ": " + std::to_string(points.shape(1)) + " columns are too many");
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
