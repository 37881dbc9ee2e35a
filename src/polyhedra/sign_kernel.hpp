// SPDX-License-Identifier: BSD-3-Clause
// Signs of the scalar products of a ray with many rows in binary64, as far as they are certain. One row per
// SIMD lane; compiled for several instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::polyhedra {

/// Rows of integers, rounded, column after column.
class RoundedRows {
 public:
  /// Rows are taken in blocks of so many.
  static constexpr std::size_t block = 8;

  RoundedRows() = default;
  /// `entry(row, column)`: an integer, rounded with a relative error of at most 2^−52; infinite if it is
  /// beyond all doubles.
  template <class Entry>
  RoundedRows(std::size_t num_rows, std::size_t dimension, Entry entry)
      : num_rows_(num_rows),
        dimension_(dimension),
        stride_((num_rows + block - 1) / block * block),
        columns_(stride_ * dimension, 0.0),
        sums_(stride_, 0.0) {
    for (std::size_t row = 0; row < num_rows; ++row)
      for (std::size_t c = 0; c < dimension; ++c) {
        const double x = entry(row, c);
        columns_[c * stride_ + row] = x;
        sums_[row] += x < 0 ? -x : x;
      }
  }

  std::size_t size() const { return num_rows_; }
  std::size_t dimension() const { return dimension_; }
  std::size_t stride() const { return stride_; }
  const double* column(std::size_t c) const { return columns_.data() + c * stride_; }
  /// The sums of the magnitudes of the entries of each row.
  const double* sums() const { return sums_.data(); }

 private:
  std::size_t num_rows_ = 0, dimension_ = 0, stride_ = 0;
  std::vector<double> columns_, sums_;
};

/// Looks at the rows from `first` on, block by block, up to the end of the block with the first product that
/// is certainly negative. Inserts rows whose product is certainly 0 into `zeros`, and rows that remain open
/// into `open`, of whose words only those of rows that were looked at are changed. Returns that first row, or
/// the number of rows. `ray`: an integer vector, rounded as the rows are.
std::size_t find_signs(const RoundedRows& rows, std::span<const double> ray, std::size_t first,
                       std::span<std::uint64_t> zeros, std::span<std::uint64_t> open);

}  // namespace delone::polyhedra
