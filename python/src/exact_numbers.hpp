// SPDX-License-Identifier: BSD-3-Clause
// Numbers of Python as rational numbers, and back: doubles as they are, integers of any size, fractions, text
// such as "3/7", and two arrays of integers.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <delone/rational.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace delone::python {

namespace py = pybind11;

/// Rational numbers in the shape of an array.
struct ExactArray {
  std::vector<py::ssize_t> shape;
  std::vector<Rational> entries;  ///< in the order of C

  std::size_t length(std::size_t axis) const { return static_cast<std::size_t>(shape[axis]); }
};

/// An array of one or two axes: of numbers, of objects, or a tuple (numerators, denominators) of integers,
/// which are broadcast. Raises InputError if an entry is not a number, is not finite, or has the denominator
/// 0, naming its row, and for matrices its column; ValueError for masked arrays and for another number of
/// axes.
ExactArray as_exact(const py::object& object, const std::string& name, std::size_t num_axes);

/// The same with any number of axes but none, and without pairs of arrays.
ExactArray as_exact_queries(const py::object& object, const std::string& name);

/// The numbers of a vector. Raises ValueError unless there are `size`.
std::vector<Rational> as_exact_vector(const py::object& object, const std::string& name, std::size_t size);

/// The rows of a matrix. Matrices of width 0 have rows, too.
RationalRows to_rows(ExactArray matrix);

// Read-only arrays (n, width). RationalRows without rows do not tell the width.

/// Integers: int64 if all fit, otherwise objects of Python. REQUIRES integers.
py::array integer_array(const RationalRows& rows, std::size_t width);
/// Objects: fractions.Fraction.
py::array fraction_array(const RationalRows& rows, std::size_t width);
/// The nearest doubles.
py::array double_array(const RationalRows& rows, std::size_t width);
/// The same by RationalRows::to_scaled_doubles().
py::array scaled_double_array(const RationalRows& rows, std::size_t width, std::size_t leading);

/// One number as fractions.Fraction.
py::object to_fraction(const Rational& x);
/// An integer as int. REQUIRES one.
py::object to_int(const Rational& x);

/// The same array, read-only.
py::array read_only(py::array array);

}  // namespace delone::python
