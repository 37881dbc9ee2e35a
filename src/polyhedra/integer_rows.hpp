// SPDX-License-Identifier: BSD-3-Clause
// Rows of integers of any size, and their elimination without fractions: for what is done once per
// conversion, not once per ray.
#pragma once

#include "kernel/fractions.hpp"

#include <cstddef>
#include <vector>

namespace delone::polyhedra {

using kernel::Integer;
using Row = std::vector<Integer>;
using Rows = std::vector<Row>;

bool is_zero(const Row& row);
Integer scalar_product(const Row& a, const Row& b);

/// Divides a row by the greatest common divisor of its entries; one of zeros stays.
void make_primitive(Row& row);

/// A basis of the space that rows span, fully reduced: each row is primitive, positive at its pivot, and has
/// zeros at the pivots of the others. Two sequences of rows with the same span have the same basis.
class Echelon {
 public:
  /// Pivots are among the first `width` entries of a row; entries beyond take part in all operations.
  explicit Echelon(std::size_t width) : width_(width) {}
  Echelon(std::size_t width, const Rows& rows);

  /// Adds a row; false if the basis does not change because the span contains it.
  bool add(Row row);
  /// Reduces a row to zeros at all pivots, and makes it primitive: its class modulo the span, up to a
  /// positive factor, decides the result.
  void reduce(Row& row) const;

  std::size_t rank() const { return rows_.size(); }
  const Rows& rows() const { return rows_; }
  /// The pivots of the rows, in their order.
  const std::vector<std::size_t>& pivots() const { return pivots_; }
  /// The rows in increasing order of their pivots.
  Rows sorted_rows() const;
  /// A basis of {x : row·x = 0 for all rows}, of primitive vectors; one for each entry without pivot.
  Rows kernel() const;

 private:
  std::size_t width_;
  Rows rows_;
  std::vector<std::size_t> pivots_;
};

}  // namespace delone::polyhedra
