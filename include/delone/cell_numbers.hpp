// SPDX-License-Identifier: BSD-3-Clause
// Cells by their ids and by their rows in arrays.
#pragma once

#include <delone/complex.hpp>
#include <delone/export.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone {

/// The rows that the finite cells of a triangulation have in Triangulation::to_data(), and in the files that
/// are written of it: 0, 1, … in the order of their ids. Valid until the triangulation changes; does not
/// refer to it. `const` members may be called from several threads at once.
///
/// Cost: O(slots) to make, and a SignedIndex per slot in memory.
class DELONE_EXPORT CellNumbers {
 public:
  CellNumbers() = default;
  /// Throws Errc::out_of_memory.
  explicit CellNumbers(const Complex& complex);
  /// The same of some cells only: those whose slots are marked by a number other than 0, which are finite.
  /// REQUIRES as many marks as slots.
  explicit CellNumbers(std::span<const std::uint8_t> chosen);

  /// How many cells have a row.
  std::size_t size() const { return size_; }
  /// The row of a cell; −1 for an infinite cell, a vacant slot and invalid_cell. O(1).
  SignedIndex row(CellId cell) const {
    return index(cell) < row_of_slot_.size() ? row_of_slot_[index(cell)] : -1;
  }
  /// The cell of a row. REQUIRES row < size(). O(1), unless many slots are vacant or infinite.
  CellId cell(std::size_t row) const;

 private:
  static constexpr std::size_t rows_per_anchor = 32;

  void add(Index slot);

  std::vector<SignedIndex> row_of_slot_;
  std::vector<Index> anchors_;  // the slots of the rows 0, 32, 64, …
  std::size_t size_ = 0;
};

}  // namespace delone
