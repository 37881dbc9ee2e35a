// SPDX-License-Identifier: BSD-3-Clause
// NumPy arrays in and out. Inputs become C-contiguous float64, without a copy if they are that already.
// Outputs are read-only views that keep their owner alive.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <delone/data.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace delone::python {

namespace py = pybind11;

/// Any array-like of real numbers, or a pandas DataFrame, as C-contiguous float64. Raises InputError for an
/// integer, long double or other number that float64 cannot represent exactly, and for objects that are no
/// numbers, naming the row; ValueError for masked, complex or ragged input. `name` is the name of the
/// argument. Values may be NaN or infinite.
py::array_t<double> as_doubles(const py::object& object, const std::string& name);

/// The labels of the columns of a pandas DataFrame, a tuple; None of anything else.
py::object columns_of(const py::object& object);

/// What a pickle has for columns. Raises ValueError unless it is None, or a tuple of so many.
py::object as_columns(const py::object& object, int count);

/// Raises ValueError if the object is a DataFrame with other columns than `columns`, a tuple or None, or a
/// Series, one row of such a one, with other labels.
void require_columns(const py::object& object, const py::object& columns, const std::string& name);

/// The index of a pandas DataFrame, the labels of its rows; None of anything else.
py::object index_of(const py::object& object);

/// Raises ValueError if the object is a Series or DataFrame that has another index than `index`, which is one
/// or None, and both tell rows apart.
void require_index(const py::object& object, const py::object& index, const std::string& name);

/// As as_doubles(); complex numbers as complex128.
py::array as_numbers(const py::object& object, const std::string& name);

/// For loops over objects: signal handlers of Python run now and then, and may raise.
inline void let_signals_through(py::ssize_t round) {
  if (round % 4096 == 0 && PyErr_CheckSignals() != 0) throw py::error_already_set();
}

inline std::span<const double> numbers(const py::array_t<double>& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

/// The numbers of an array, of no subclass, that is C-contiguous float64 of shape (dimension,), if all are
/// below 2^900 in magnitude; nothing for anything else.
std::span<const double> as_vector(const py::object& object, int dimension);

/// (low, high), or nothing for None.
std::optional<Box> as_box(const py::object& object);

/// An (n, d) array of points, d ≥ 1. Raises ValueError for any other shape, InputError for numbers that are
/// not finite.
py::array_t<double> as_points(const py::object& object, const std::string& name);

/// The same for points of this dimension, of which one may come as an array (d,).
py::array_t<double> as_more_points(const py::object& object, int dimension, const std::string& name);

/// A tolerance, or one for each axis in its place, as Options have them.
struct Tolerances {
  double tolerance = 0;
  std::vector<double> of_axes;
};

/// A number, or an array of `dimension` numbers. Raises TypeError for anything else, ValueError for another
/// shape.
Tolerances as_tolerances(const py::object& object, int dimension);

/// The same as an argument: a number if those of the axes are equal, or none; else a tuple of numbers.
py::object as_argument(double tolerance, std::span<const double> of_axes);

/// Rows of the input: one, or a list.
struct RowNumbers {
  std::vector<std::size_t> rows;
  bool is_single = false;
};

/// An integer, an array of shape (m,) of integers of any type, or a mask: one bool for each of the rows,
/// which `num_rows` counts. Raises TypeError and ValueError for anything else, InputError for negative
/// numbers. `list`: how messages about single rows begin, see place_in().
RowNumbers as_rows(const py::object& object, const std::string& name, const std::string& list,
                   const std::function<std::size_t()>& num_rows);

/// How messages of edits name a place in a list: "remove[2]", or "remove" if there is no other.
std::string place_in(const std::string& list, std::size_t size, std::size_t place);

/// Queries of shape (…, d), and arrays with one answer for each.
class Queries {
 public:
  /// `columns`: the labels that a DataFrame must have, a tuple, or None; `name`: of the argument, for
  /// messages.
  Queries(const py::object& object, int dimension, const py::object& columns = py::none(),
          const std::string& name = "queries");
  /// With dimension() and columns() of what is asked.
  template <class Held>
  requires requires(const Held& held) { held.columns(); }
  Queries(const py::object& object, const Held& held, const std::string& name = "queries")
      : Queries(object, held.dimension(), held.columns(), name) {}
  std::span<const double> coordinates() const { return numbers(array_); }
  std::size_t size() const { return size_; }
  /// A new array of shape (…, further).
  template <class T>
  py::array_t<T> answers(std::initializer_list<std::size_t> further = {}) const {
    std::vector<py::ssize_t> shape = shape_;
    for (const std::size_t length : further) shape.push_back(static_cast<py::ssize_t>(length));
    return py::array_t<T>(shape);
  }
  /// For a single query of shape (d,) with one number as answer: that number as a scalar.
  static py::object scalar_if_single(const py::array& answers) {
    return answers.ndim() == 0 ? py::object(answers[py::tuple()]) : py::object(answers);
  }

 private:
  py::array_t<double> array_;
  std::vector<py::ssize_t> shape_;  // without the last one
  std::size_t size_ = 0;
};

/// A read-only array over memory that `owner` keeps alive.
template <class T>
py::array view(std::span<const T> items, std::vector<py::ssize_t> shape, std::shared_ptr<const void> owner) {
  using Owner = std::shared_ptr<const void>;
  auto keep = std::make_unique<Owner>(std::move(owner));
  const py::capsule base(keep.get(), [](void* p) { delete static_cast<Owner*>(p); });
  static_cast<void>(keep.release());
  py::array_t<T> array(std::move(shape), items.data(), base);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// The same with rows of `width` numbers. `rows` matters if the width is 0.
template <class T, class Owner>
py::array rows_view(const std::vector<T>& items, std::size_t rows, std::size_t width,
                    const std::shared_ptr<Owner>& owner) {
  return view<T>(items, {static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(width)}, owner);
}
template <class T, class Owner>
py::array list_view(const std::vector<T>& items, const std::shared_ptr<Owner>& owner) {
  return view<T>(items, {static_cast<py::ssize_t>(items.size())}, owner);
}

/// The same for a vector that the array itself takes over.
template <class T>
py::array rows_view(std::vector<T>&& items, std::size_t rows, std::size_t width) {
  const auto owner = std::make_shared<const std::vector<T>>(std::move(items));
  return rows_view(*owner, rows, width, owner);
}
template <class T>
py::array list_view(std::vector<T>&& items) {
  const auto owner = std::make_shared<const std::vector<T>>(std::move(items));
  return list_view(*owner, owner);
}

}  // namespace delone::python
