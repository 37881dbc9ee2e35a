// SPDX-License-Identifier: BSD-3-Clause
#include "exact_numbers.hpp"

#include "arrays.hpp"
#include "messages.hpp"
#include "running.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

namespace delone::python {
namespace {

/// How messages name the entries of an array.
class Places {
 public:
  Places(const std::string& name, const std::vector<py::ssize_t>& shape) : name_(name), shape_(shape) {}

  [[noreturn]] void refuse(Errc code, py::ssize_t index, const std::string& why) const {
    const py::ssize_t width = shape_.size() > 1 ? std::max<py::ssize_t>(shape_.back(), 1) : 1;
    const auto row = static_cast<std::size_t>(index / width);
    std::string place = name_ + ": row " + std::to_string(row);
    if (shape_.size() > 1) place += ", column " + std::to_string(index % width);
    throw Error(code, place + ": " + why, {row});
  }

 private:
  const std::string& name_;
  const std::vector<py::ssize_t>& shape_;
};

py::object taken(PyObject* object) {
  if (object == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(object);
}

/// An int of Python, of any size.
Rational of_int(const py::object& integer) {
  int overflow = 0;
  const long long small = PyLong_AsLongLongAndOverflow(integer.ptr(), &overflow);
  if (overflow == 0) {
    if (small == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
    return {static_cast<std::int64_t>(small)};
  }
  const py::object magnitude = taken(PyNumber_Absolute(integer.ptr()));
  const auto num_words = magnitude.attr("bit_length")().cast<std::size_t>() / 64 + 1;
  const py::bytes bytes = magnitude.attr("to_bytes")(8 * num_words, "little");
  const auto text = static_cast<std::string_view>(bytes);
  std::vector<std::uint64_t> words(num_words, 0);
  for (std::size_t i = 0; i < text.size(); ++i)
    words[i / 8] |= static_cast<std::uint64_t>(static_cast<unsigned char>(text[i])) << (8 * (i % 8));
  return Rational::from_words(words, overflow < 0);
}

Rational of_ints(const py::object& numerator, const py::object& denominator) {
  return {of_int(taken(PyNumber_Index(numerator.ptr()))), of_int(taken(PyNumber_Index(denominator.ptr())))};
}

/// Any number of Python. Raises InputError for anything else.
class NumberReader {
 public:
  explicit NumberReader(const Places& places) : places_(places) {}

  Rational operator()(const py::object& value, py::ssize_t index) const {
    if (PyFloat_Check(value.ptr()) != 0) return of_double(PyFloat_AS_DOUBLE(value.ptr()), index);
    if (PyLong_Check(value.ptr()) != 0) return of_int(value);
    if (PyUnicode_Check(value.ptr()) != 0) return of_text(value, index);
    try {
      if (PyIndex_Check(value.ptr()) != 0) return of_int(taken(PyNumber_Index(value.ptr())));
      if (py::hasattr(value, "numerator") && py::hasattr(value, "denominator"))
        return of_ints(value.attr("numerator"), value.attr("denominator"));
      if (py::hasattr(value, "as_integer_ratio")) {
        const auto ratio = value.attr("as_integer_ratio")().cast<py::tuple>();
        return of_ints(ratio[0], ratio[1]);
      }
    } catch (const Error&) {
      places_.refuse(Errc::invalid_argument, index, "the denominator is 0");
    } catch (const py::cast_error&) {
    } catch (py::error_already_set& error) {
      if (!error.matches(PyExc_Exception)) throw;
      if (error.matches(PyExc_OverflowError) || error.matches(PyExc_ValueError))  // Decimal("inf"), "nan"
        places_.refuse(Errc::not_finite, index, shown(value) + " is not finite");
    }
    places_.refuse(
        Errc::invalid_argument, index,
        value.is_none() ? "None is not a number" : type_with_article(value) + " is not a rational number");
  }

  Rational of_double(double value, py::ssize_t index) const {
    if (!std::isfinite(value))
      places_.refuse(Errc::not_finite, index,
                     (std::isnan(value) ? "nan"
                      : value < 0       ? "-inf"
                                        : "inf") +
                         std::string(" is not finite"));
    return {value};
  }

 private:
  Rational of_text(const py::object& text, py::ssize_t index) const {
    Py_ssize_t size = 0;
    const char* const begin = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
    if (begin == nullptr) {  // lone surrogates
      PyErr_Clear();
      places_.refuse(Errc::bad_format, index, represented(text) + " is not a rational number");
    }
    try {
      return Rational(std::string_view(begin, static_cast<std::size_t>(size)));
    } catch (const Error& error) {
      if (error.code() != Errc::bad_format) throw;
      const bool has_zero = std::string_view(error.what()).find("denominator") != std::string_view::npos;
      places_.refuse(Errc::bad_format, index,
                     represented(text) + (has_zero ? " has the denominator 0" : " is not a rational number"));
    }
  }

  const Places& places_;
};

py::object numpy() { return py::module_::import("numpy"); }

/// An array as it is; of lists, DataFrames and the like an array of objects, which NumPy has rounded nothing
/// of.
py::array as_unrounded(const py::object& object, const std::string& name) {
  const py::object ma = numpy().attr("ma");
  if (py::isinstance(object, ma.attr("MaskedArray")) && py::bool_(ma.attr("is_masked")(object)))
    throw py::value_error(name + ": masked values are not numbers");
  if (PyUnicode_Check(object.ptr()) != 0 || PyBytes_Check(object.ptr()) != 0)
    throw py::type_error(name + ": an array, not a " + type_name(object));
  try {
    return py::isinstance<py::array>(object) ? py::array(numpy().attr("asarray")(object))
                                             : py::array(numpy().attr("asarray")(object, py::dtype("O")));
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    throw py::value_error(name + ": rows of different lengths");
  }
}

std::vector<py::ssize_t> shape_of(const py::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

/// Reads an array of numbers without the GIL.
template <class T, class Of>
std::vector<Rational> read_numbers(const py::array& array, Of of) {
  const auto numbers = py::array_t<T, py::array::c_style | py::array::forcecast>(array);
  const T* const begin = numbers.data();
  const auto size = static_cast<std::size_t>(numbers.size());
  Supervisor supervisor;
  return supervisor.run([&] {
    std::vector<Rational> entries;
    entries.reserve(size);
    for (std::size_t i = 0; i < size; ++i) {
      if (i % 1024 == 0) cancellation_point();
      entries.push_back(of(begin[i], static_cast<py::ssize_t>(i)));
    }
    return entries;
  });
}

std::vector<Rational> read_objects(const py::array& array, const NumberReader& read) {
  std::vector<Rational> entries;
  entries.reserve(static_cast<std::size_t>(array.size()));
  py::ssize_t index = 0;
  for (const py::handle item : array.attr("ravel")().attr("tolist")()) {
    let_signals_through(index);
    entries.push_back(read(py::reinterpret_borrow<py::object>(item), index));
    ++index;
  }
  return entries;
}

ExactArray read_array(const py::array& array, const std::string& name) {
  ExactArray result{shape_of(array), {}};
  const Places places(name, result.shape);
  const NumberReader read(places);
  const char kind = array.dtype().kind();
  const py::ssize_t size = array.dtype().itemsize();
  if (kind == 'f' && size <= 8)
    result.entries =
        read_numbers<double>(array, [&](double x, py::ssize_t index) { return read.of_double(x, index); });
  else if (kind == 'b' || kind == 'i' || (kind == 'u' && size < 8))
    result.entries =
        read_numbers<std::int64_t>(array, [](std::int64_t x, py::ssize_t) { return Rational(x); });
  else if (kind == 'u')
    result.entries = read_numbers<std::uint64_t>(array, [](std::uint64_t x, py::ssize_t) {
      return Rational::from_words({&x, 1});
    });
  else if (kind == 'O' || kind == 'U' || kind == 'f')
    result.entries = read_objects(kind == 'f' ? py::array(array.attr("astype")("O")) : array, read);
  else
    throw py::value_error(name + ": an array of numbers, not of " + shown(array.dtype()));
  return result;
}

/// (numerators, denominators), if the object is such a pair of arrays of this many axes.
std::optional<py::tuple> as_pair(const py::object& object, const std::string& name, std::size_t num_axes) {
  if (!PyTuple_CheckExact(object.ptr()) || PyTuple_GET_SIZE(object.ptr()) != 2) return std::nullopt;
  const auto pair = py::reinterpret_borrow<py::tuple>(object);
  if (PyUnicode_Check(py::object(pair[0]).ptr()) != 0) return std::nullopt;
  const py::array numerators = as_unrounded(pair[0], name);
  if (static_cast<std::size_t>(numerators.ndim()) != num_axes) return std::nullopt;
  return pair;
}

ExactArray read_pair(const py::tuple& pair, const std::string& name) {
  const py::array numerators = as_unrounded(pair[0], name + ": numerators"),
                  denominators = as_unrounded(pair[1], name + ": denominators");
  ExactArray result = read_array(numerators, name + ": numerators");
  py::array all;
  try {
    all = numpy().attr("broadcast_to")(denominators, numerators.attr("shape"));
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    throw py::value_error(name + ": denominators of shape " + shown(denominators.attr("shape")) +
                          " for numerators of shape " + shown(numerators.attr("shape")));
  }
  const ExactArray divisors = read_array(all, name + ": denominators");
  const Places places(name, result.shape);
  for (std::size_t i = 0; i < result.entries.size(); ++i) {
    const auto index = static_cast<py::ssize_t>(i);
    let_signals_through(index);
    if (!result.entries[i].is_integer() || !divisors.entries[i].is_integer())
      places.refuse(Errc::invalid_argument, index, "numerators and denominators are integers");
    if (divisors.entries[i] == Rational())
      places.refuse(Errc::invalid_argument, index, "the denominator is 0");
    result.entries[i] = Rational(result.entries[i], divisors.entries[i]);
  }
  return result;
}

/// An array of objects with what make(number) returns.
template <class Make>
py::array object_array(const RationalRows& rows, std::size_t width, Make make) {
  py::list objects(static_cast<py::ssize_t>(rows.entries().size()));
  py::ssize_t index = 0;
  for (const Rational& x : rows.entries()) {
    let_signals_through(index);
    objects[static_cast<std::size_t>(index++)] = make(x);
  }
  py::array flat = numpy().attr("empty")(index, "O");
  flat[py::ellipsis()] = objects;
  return read_only(flat.attr("reshape")(rows.size(), width));
}

/// An array of what to_numbers() returns, without the GIL.
template <class ToNumbers>
py::array number_array(const RationalRows& rows, std::size_t width, ToNumbers to_numbers) {
  Supervisor supervisor;
  return rows_view(supervisor.run(to_numbers), rows.size(), width);
}

}  // namespace

ExactArray as_exact(const py::object& object, const std::string& name, std::size_t num_axes) {
  if (const std::optional<py::tuple> pair = as_pair(object, name, num_axes)) return read_pair(*pair, name);
  const py::array array = as_unrounded(object, name);
  if (static_cast<std::size_t>(array.ndim()) != num_axes) {
    const char* const shape = num_axes == 1 ? "(n,)" : "(n, d)";
    const bool is_ragged = array.ndim() == 1 && array.size() > 0 && array.dtype().kind() == 'O' &&
                           PySequence_Check(py::object(array[py::int_(0)]).ptr()) != 0 &&
                           PyUnicode_Check(py::object(array[py::int_(0)]).ptr()) == 0;
    throw py::value_error(name + (is_ragged ? ": rows of different lengths"
                                            : ": an array of shape " + std::string(shape) + ", not " +
                                                  shown(array.attr("shape"))));
  }
  return read_array(array, name);
}

ExactArray as_exact_queries(const py::object& object, const std::string& name) {
  const py::array array = as_unrounded(object, name);
  if (array.ndim() == 0)
    throw py::value_error(name + ": an array of shape (d,) or (..., d), not a " + type_name(object));
  return read_array(array, name);
}

std::vector<Rational> as_exact_vector(const py::object& object, const std::string& name, std::size_t size) {
  ExactArray vector = as_exact(object, name, 1);
  if (vector.entries.size() != size)
    throw py::value_error(name + ": an array of shape (" + std::to_string(size) + ",), not (" +
                          std::to_string(vector.entries.size()) + ",)");
  return std::move(vector.entries);
}

RationalRows to_rows(ExactArray matrix) {
  const std::size_t width = matrix.length(1);
  if (width > 0) return {std::move(matrix.entries), width};
  RationalRows rows;
  for (std::size_t i = 0; i < matrix.length(0); ++i) rows.push_back({});
  return rows;
}

py::array integer_array(const RationalRows& rows, std::size_t width) {
  const bool are_small = std::all_of(rows.entries().begin(), rows.entries().end(),
                                     [](const Rational& x) { return x.to_int64().has_value(); });
  if (!are_small) return object_array(rows, width, to_int);
  py::array_t<std::int64_t> array({static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(width)});
  std::transform(rows.entries().begin(), rows.entries().end(), array.mutable_data(),
                 [](const Rational& x) { return *x.to_int64(); });
  return read_only(array);
}

py::array fraction_array(const RationalRows& rows, std::size_t width) {
  return object_array(rows, width, to_fraction);
}

py::array double_array(const RationalRows& rows, std::size_t width) {
  return number_array(rows, width, [&] { return rows.to_doubles(); });
}

py::array scaled_double_array(const RationalRows& rows, std::size_t width, std::size_t leading) {
  return number_array(rows, width, [&] { return rows.to_scaled_doubles(leading); });
}

py::object to_int(const Rational& x) {
  if (const auto small = x.to_int64()) return py::int_(*small);
  const std::vector<std::uint64_t> words = x.to_words();
  std::string bytes;
  for (std::uint64_t word : words)
    for (int i = 0; i < 8; ++i, word >>= 8) bytes += static_cast<char>(word & 0xff);
  const auto type = py::reinterpret_borrow<py::object>(reinterpret_cast<PyObject*>(&PyLong_Type));
  const py::object magnitude = type.attr("from_bytes")(py::bytes(bytes), "little");
  return x.is_negative() ? taken(PyNumber_Negative(magnitude.ptr())) : magnitude;
}

py::object to_fraction(const Rational& x) {
  static auto* const type = new py::object(py::module_::import("fractions").attr("Fraction"));
  return (*type)(to_int(x.numerator()), to_int(x.denominator()));
}

py::array read_only(py::array array) {
  array.attr("flags").attr("writeable") = false;
  return array;
}

}  // namespace delone::python
