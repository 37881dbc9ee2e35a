// SPDX-License-Identifier: BSD-3-Clause
// Conversions of inputs; see arrays.hpp.
#include "arrays.hpp"

#include "messages.hpp"

#include <delone/arithmetic.hpp>
#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace delone::python {
namespace {

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
    let_signals_through(i);
    const py::object value = flat[py::int_(i)];
    const bool is_text = PyUnicode_Check(value.ptr()) != 0 || PyBytes_Check(value.ptr()) != 0;
    const auto number = py::reinterpret_steal<py::object>(is_text ? nullptr : PyNumber_Float(value.ptr()));
    if (number) continue;
    const bool is_large = !is_text && PyErr_ExceptionMatches(PyExc_OverflowError) != 0;
    if (!is_text && PyErr_ExceptionMatches(PyExc_Exception) == 0) throw py::error_already_set();  // Ctrl-C
    PyErr_Clear();
    if (value.is_none()) refuse_entry(name, i, array, "None is not a number");
    if (is_large) refuse_entry(name, i, array, shown(value) + " is beyond the range of double precision");
    if (is_text) refuse_entry(name, i, array, represented(value) + " is not a number");
    refuse_entry(name, i, array, type_with_article(value) + " is not a number");
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

/// Whether the object is an array, of no subclass.
bool is_array(const py::object& object) {
  const auto& api = py::detail::npy_api::get();
  return static_cast<void*>(Py_TYPE(object.ptr())) == static_cast<void*>(api.PyArray_Type_);
}

/// Whether it is an array, of no subclass, that is C-contiguous and aligned float64 with an axis.
bool is_plain(const py::object& object) {
  if (!is_array(object)) return false;
  if (!py::array_t<double, py::array::c_style>::check_(object)) return false;
  const auto array = py::reinterpret_borrow<py::array>(object);
  return array.ndim() > 0 && (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
}

/// a == b as Python has it, also for one object that is not equal to itself.
bool are_equal(const py::object& a, const py::object& b) {
  const auto result = py::reinterpret_steal<py::object>(PyObject_RichCompare(a.ptr(), b.ptr(), Py_EQ));
  const int is_true = result ? PyObject_IsTrue(result.ptr()) : -1;
  if (is_true < 0) throw py::error_already_set();
  return is_true > 0;
}

/// The first entry that is not what it was before its conversion to float64 or complex128, or −1. NaN is.
py::ssize_t find_changed(const py::array& converted, const py::array& original) {
  if (original.dtype().kind() != 'O') {
    const py::module_ numpy = py::module_::import("numpy");
    const py::array differs(
        numpy.attr("flatnonzero")(converted.attr("__ne__")(original) & original.attr("__eq__")(original)));
    return differs.size() > 0 ? differs[py::int_(0)].cast<py::ssize_t>() : -1;
  }
  const py::object numbers = converted.attr("ravel")(), objects = original.attr("ravel")();
  for (py::ssize_t i = 0; i < original.size(); ++i) {
    let_signals_through(i);
    const py::object number = numbers[py::int_(i)].attr("item")();
    py::object object = objects[py::int_(i)];
    // Python compares its integers with floats exactly; NumPy rounds its own.
    if (py::hasattr(object, "item")) object = object.attr("item")();
    if (!are_equal(number, object) && are_equal(object, object)) return i;
  }
  return -1;
}

[[noreturn]] void refuse_inexact(const std::string& name, py::ssize_t index, const py::array& array) {
  refuse_entry(name, index, array,
               shown(array.attr("ravel")()[py::int_(index)]) + " is not exact in double precision");
}

/// NumPy makes floats of lists that have floats and integers, and rounds large integers. Raises InputError
/// for the first that it has rounded. `converted`: what it made of the object.
void refuse_rounded(const py::object& object, const py::array& converted, const std::string& name) {
  const py::module_ numpy = py::module_::import("numpy");
  if (py::isinstance<py::array>(object) ||
      !py::bool_(numpy.attr("any")(numpy.attr("absolute")(converted).attr("__ge__")(0x1p53))))
    return;
  py::array original;
  try {
    original = numpy.attr("asarray")(object, py::dtype("O"));
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_Exception)) throw;
    return;  // an object with an array of its own, of floats only
  }
  if (!original.attr("shape").equal(converted.attr("shape"))) return;
  if (const py::ssize_t index = find_changed(converted, original); index >= 0)
    refuse_inexact(name, index, original);
}

/// pandas is never imported for this: whoever has a DataFrame or a Series has imported it.
bool is_of_pandas(const py::object& object, const char* type_name) {
  if (is_array(object)) return false;
  const py::object modules = py::module_::import("sys").attr("modules");
  const py::object pandas = modules.attr("get")("pandas");
  if (pandas.is_none()) return false;
  const py::object type = py::getattr(pandas, type_name, py::none());
  return !type.is_none() && py::isinstance(object, type);
}
bool is_frame(const py::object& object) { return is_of_pandas(object, "DataFrame"); }
bool is_series(const py::object& object) { return is_of_pandas(object, "Series"); }

py::array_t<double> frame_as_doubles(const py::object& frame, const std::string& name, bool is_finite) {
  return py::array_t<double>(py::module_::import("delone._frames").attr("numbers")(frame, name, is_finite));
}

void refuse_masked(const py::object& object, const std::string& name) {
  const py::object ma = py::module_::import("numpy").attr("ma");
  if (py::isinstance(object, ma.attr("MaskedArray")) && py::bool_(ma.attr("is_masked")(object)))
    throw py::value_error(name + ": masked values are not numbers");
}

/// numpy.asarray(), whose own errors name no argument.
py::array as_array(const py::object& object, const std::string& name) {
  if (PyUnicode_Check(object.ptr()) != 0 || PyBytes_Check(object.ptr()) != 0 ||
      py::hasattr(object, "__fspath__"))
    throw py::type_error(name + ": an array, not a " + type_name(object) + "; delone.read() reads files");
  try {
    return py::module_::import("numpy").attr("asarray")(object);
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    const std::string text = shown(error.value());
    throw py::value_error(
        name + ": " +
        (text.find("with a sequence") != std::string::npos ? "rows of different lengths" : text));
  }
}

/// Raises InputError if a number is not finite, naming its row and its column.
void require_finite(const py::array_t<double>& points, const std::string& name) {
  const std::span<const double> all = numbers(points);
  const auto is_bad = [](double x) { return !std::isfinite(x); };
  const auto first = std::find_if(all.begin(), all.end(), is_bad);
  if (first == all.end()) return;
  const auto width = static_cast<std::size_t>(points.shape(1));
  std::vector<std::size_t> rows;
  for (std::size_t i = static_cast<std::size_t>(first - all.begin()); i < all.size(); ++i)
    if (is_bad(all[i]) && (rows.empty() || rows.back() != i / width)) rows.push_back(i / width);
  const std::size_t column = static_cast<std::size_t>(first - all.begin()) % width, more = rows.size() - 1;
  const std::string text = name + ": row " + std::to_string(rows[0]) + ", column " + std::to_string(column) +
                           ": " + shown(py::float_(*first)) + " is not finite" +
                           (more == 0 ? "" : " (and " + std::to_string(more) + " more rows)");
  throw Error(Errc::not_finite, text, std::move(rows));
}

}  // namespace

py::object columns_of(const py::object& object) {
  return is_frame(object) ? py::object(py::module_::import("delone._frames").attr("columns")(object))
                          : py::object(py::none());
}

py::object as_columns(const py::object& object, int count) {
  if (!object.is_none() &&
      (!py::isinstance<py::tuple>(object) || py::len(object) != static_cast<std::size_t>(count)))
    throw py::value_error("columns: None, or a tuple of " + std::to_string(count));
  return object;
}

void require_columns(const py::object& object, const py::object& columns, const std::string& name) {
  if (!columns.is_none() && (is_frame(object) || is_series(object)))
    py::module_::import("delone._frames").attr("require_columns")(object, columns, name);
}

py::object index_of(const py::object& object) {
  return is_frame(object) ? py::object(py::module_::import("delone._frames").attr("index")(object))
                          : py::object(py::none());
}

void require_index(const py::object& object, const py::object& index, const std::string& name) {
  if (!index.is_none() && (is_frame(object) || is_series(object)))
    py::module_::import("delone._frames").attr("require_index")(object, index, name);
}

py::array as_numbers(const py::object& object, const std::string& name) {
  const ArithmeticScope arithmetic;
  const py::module_ numpy = py::module_::import("numpy");
  refuse_masked(object, name);
  if (is_frame(object)) return as_doubles(object, name);
  const py::array array = as_array(object, name);
  if (array.dtype().kind() != 'c') return as_doubles(object, name);
  const py::array numbers = numpy.attr("asarray")(array, "complex128", py::arg("order") = "C");
  refuse_rounded(object, numbers, name);
  if (const py::ssize_t index = array.itemsize() > 16 ? find_changed(numbers, array) : -1; index >= 0)
    refuse_inexact(name, index, array);
  return numbers;
}

py::array_t<double> as_doubles(const py::object& object, const std::string& name) {
  const ArithmeticScope arithmetic;
  if (is_plain(object)) return py::reinterpret_borrow<py::array_t<double>>(object);
  if (is_frame(object)) return frame_as_doubles(object, name, false);
  const py::module_ numpy = py::module_::import("numpy");
  refuse_masked(object, name);
  const py::array array = as_array(object, name);
  const char kind = array.dtype().kind();
  if (kind == 'c') throw py::value_error(name + ": complex numbers are not real");
  if (kind != 'f' && kind != 'i' && kind != 'u' && kind != 'b' && kind != 'O')
    throw py::value_error(name + ": not numbers, but " + shown(array.dtype()));
  if (kind == 'O') refuse_objects(name, array);
  py::array_t<double> doubles(numpy.attr("ascontiguousarray")(array, py::dtype::of<double>()));
  if (array.ndim() == 0) doubles = py::array_t<double>(doubles.attr("reshape")(py::tuple()));
  if (kind == 'f') refuse_rounded(object, doubles, name);
  py::ssize_t inexact = -1;
  if ((kind == 'i' || kind == 'u') && array.itemsize() == 8)
    inexact = kind == 'i' ? find_inexact<std::int64_t>(array) : find_inexact<std::uint64_t>(array);
  else if (kind == 'O' || (kind == 'f' && array.itemsize() > 8))
    inexact = find_changed(doubles, array);
  if (inexact >= 0) refuse_inexact(name, inexact, array);
  return doubles;
}

py::array_t<double> as_points(const py::object& object, const std::string& name) {
  const ArithmeticScope arithmetic;
  auto points = is_frame(object) ? frame_as_doubles(object, name, true) : as_doubles(object, name);
  if (points.ndim() != 2 || points.shape(1) < 1)
    throw py::value_error(name + ": an array of shape (n, d), d at least 1, not " +
                          shown(points.attr("shape")));
  if (points.shape(1) > std::numeric_limits<int>::max() - 1)
    throw Error(Errc::bad_dimension, name + ": " + std::to_string(points.shape(1)) + " columns are too many");
  require_finite(points, name);
  return points;
}

py::array_t<double> as_more_points(const py::object& object, int dimension, const std::string& name) {
  py::array_t<double> points = is_frame(object) ? as_points(object, name) : as_doubles(object, name);
  if (points.ndim() == 1 && points.shape(0) == dimension)
    points = py::array_t<double>(points.attr("reshape")(1, dimension));
  points = as_points(points, name);
  if (points.shape(1) != dimension)
    throw py::value_error(name + ": an array of shape (n, " + std::to_string(dimension) + "), not " +
                          shown(points.attr("shape")));
  return points;
}

std::string place_in(const std::string& list, std::size_t size, std::size_t place) {
  return size == 1 ? list : list + "[" + std::to_string(place) + "]";
}

Tolerances as_tolerances(const py::object& object, int dimension) {
  Tolerances result;
  const bool is_list =
      is_array(object) || (!py::isinstance<py::str>(object) && !py::isinstance<py::bytes>(object) &&
                           (py::isinstance<py::sequence>(object) || py::hasattr(object, "__array__")));
  const auto array = is_list ? as_doubles(object, "tolerance") : py::array_t<double>(0);
  if (is_list && array.ndim() > 0) {
    if (array.ndim() != 1 || array.shape(0) != dimension)
      throw py::value_error("tolerance: a number, or one for each of the " + std::to_string(dimension) +
                            " axes, not an array of shape " + shown(array.attr("shape")));
    const auto all = numbers(array);
    result.of_axes.assign(all.begin(), all.end());
    return result;
  }
  result.tolerance = PyFloat_AsDouble(object.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    throw py::type_error("tolerance: a number was expected, not " + represented(object));
  }
  return result;
}

py::object as_argument(double tolerance, std::span<const double> of_axes) {
  if (std::ranges::adjacent_find(of_axes, std::ranges::not_equal_to()) == of_axes.end())
    return py::float_(tolerance);
  return py::tuple(py::cast(std::vector<double>(of_axes.begin(), of_axes.end())));
}

RowNumbers as_rows(const py::object& object, const std::string& name, const std::string& list,
                   const std::function<std::size_t()>& num_rows) {
  refuse_masked(object, name);
  const py::array array = as_array(object, name);
  if (array.ndim() > 1)
    throw py::value_error(name + ": a row, or an array of shape (m,), not " + shown(array.attr("shape")));
  RowNumbers result{{}, array.ndim() == 0};
  if (array.size() == 0) return result;  // of any type, as NumPy makes an array of floats of []
  const char kind = array.dtype().kind();
  if (kind == 'b' && array.ndim() == 1) {
    if (const std::size_t count = num_rows(); static_cast<std::size_t>(array.size()) != count)
      throw py::value_error(name + ": a mask of shape (" + std::to_string(count) + ",), not " +
                            shown(array.attr("shape")));
    const py::array_t<bool, py::array::c_style> mask(array);
    for (std::size_t row = 0; row < static_cast<std::size_t>(mask.size()); ++row)
      if (mask.data()[row]) result.rows.push_back(row);
    return result;
  }
  if (kind != 'i' && kind != 'u')
    throw py::type_error(name + ": integers, or a mask, not " + shown(array.dtype()));
  const auto append =
      [&]<class T>(const py::array_t<T, py::array::c_style | py::array::forcecast>& integers) {
        const T* const first = integers.data();
        const auto count = static_cast<std::size_t>(integers.size());
        for (std::size_t i = 0; i < count; ++i)
          if (first[i] < T{0})
            throw Error(
                Errc::invalid_argument,
                place_in(list, count, i) + ": row " + std::to_string(first[i]) + " is not a row of the input",
                {i});
        result.rows.assign(first, first + count);
      };
  using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
  using Naturals = py::array_t<std::uint64_t, py::array::c_style | py::array::forcecast>;
  if (kind == 'i')
    append(Integers(array));
  else
    append(Naturals(array));
  return result;
}

Queries::Queries(const py::object& object, int dimension, const py::object& columns, const std::string& name)
    : array_(is_frame(object) ? frame_as_doubles(object, name, true) : as_doubles(object, name)) {
  require_columns(object, columns, name);
  if (array_.ndim() < 1 || array_.shape(array_.ndim() - 1) != dimension)
    throw py::value_error(name + ": an array of shape (..., " + std::to_string(dimension) + "), not " +
                          shown(array_.attr("shape")));
  shape_.assign(array_.shape(), array_.shape() + array_.ndim() - 1);
  size_ = static_cast<std::size_t>(array_.size()) / static_cast<std::size_t>(dimension);
}

std::span<const double> as_vector(const py::object& object, int dimension) {
  if (!is_plain(object)) return {};
  const auto* const array = py::detail::array_proxy(object.ptr());
  if (array->nd != 1 || array->dimensions[0] != dimension) return {};
  const std::span<const double> all(reinterpret_cast<const double*>(array->data),
                                    static_cast<std::size_t>(dimension));
  const bool are_moderate =
      std::all_of(all.begin(), all.end(), [](double x) { return std::fabs(x) < 0x1p900; });
  return are_moderate ? all : std::span<const double>();
}

std::optional<Box> as_box(const py::object& object) {
  if (object.is_none()) return std::nullopt;
  const auto corners = as_doubles(object, "box");
  if (corners.ndim() != 2 || corners.shape(0) != 2)
    throw py::value_error("box: (low, high), each of d numbers");
  const auto numbers_of_both = numbers(corners);
  const std::size_t d = numbers_of_both.size() / 2;
  return Box{{numbers_of_both.begin(), numbers_of_both.begin() + static_cast<std::ptrdiff_t>(d)},
             {numbers_of_both.begin() + static_cast<std::ptrdiff_t>(d), numbers_of_both.end()}};
}

}  // namespace delone::python
