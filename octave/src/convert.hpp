// SPDX-License-Identifier: BSD-3-Clause
// Matrices of Octave, one point in each row and column after column, and arrays of the C interface, row after
// row. Rows and cells count from 1 in Octave; none is NaN.
#pragma once

#include <delone/delone.h>
#include <octave/Cell.h>
#include <octave/oct.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace delone_octave {

/// A matrix as the C interface reads it.
class Rows {
 public:
  /// Of any real class, which becomes double. Raises an error that names the argument.
  Rows(const octave_value& value, const char* name);

  const double* data() const { return transposed_.data(); }
  std::size_t size() const { return static_cast<std::size_t>(transposed_.columns()); }
  int columns() const { return static_cast<int>(transposed_.rows()); }
  /// Raises an error unless the matrix has so many columns or, of those below, rows.
  const Rows& with_columns(int expected) const;
  const Rows& with_rows(std::size_t expected) const;

 private:
  Matrix transposed_;
  const char* name_;
};

/// Numbers of `items` in a matrix, from 0. Raises an error for a number that is not 1 … `largest`, naming its
/// row.
std::vector<int64_t> row_numbers(const octave_value& value, const char* name, std::size_t largest,
                                 const char* items = "points");

/// Numbers of the C interface, `columns` in each row, as a matrix.
template <class T>
Matrix matrix_of(const T* numbers, std::size_t rows, std::size_t columns) {
  Matrix result(static_cast<octave_idx_type>(rows), static_cast<octave_idx_type>(columns));
  double* to = result.fortran_vec();
  for (std::size_t j = 0; j < columns; ++j)
    for (std::size_t i = 0; i < rows; ++i) *to++ = static_cast<double>(numbers[i * columns + j]);
  return result;
}

/// The same for rows and cells.
template <class T>
Matrix numbers_from_1(const T* numbers, std::size_t rows, std::size_t columns) {
  Matrix result = matrix_of(numbers, rows, columns);
  double* to = result.fortran_vec();
  for (octave_idx_type i = 0; i < result.numel(); ++i)
    to[i] = to[i] < 0 ? octave::numeric_limits<double>::NaN() : to[i] + 1;
  return result;
}

/// A member of an object. Integers that number rows, cells, vertices or axes count from 1.
octave_value member_of(const delone_object* object, const std::string& name);

/// A list of lists as a column of cells with a row each: numbers count from `first`; or real numbers.
Cell lists_of(const delone_object* object, const std::string& offsets, const std::string& items,
              double first);

}  // namespace delone_octave
