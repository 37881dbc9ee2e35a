// SPDX-License-Identifier: BSD-3-Clause
#include <delone/cell_numbers.hpp>

#include "base/guarded.hpp"
#include "base/quick_rounds.hpp"

namespace delone {

CellNumbers::CellNumbers(const Complex& complex) {
  internal::guarded("the numbers of cells", [&] {
    row_of_slot_.assign(complex.num_cell_slots(), -1);
    anchors_.reserve(complex.num_finite_cells() / rows_per_anchor + 1);
    internal::QuickRounds round;
    for (const CellId cell : complex.finite_cells()) {
      round();
      add(index(cell));
    }
  });
}

CellNumbers::CellNumbers(std::span<const std::uint8_t> chosen) {
  internal::guarded("the numbers of cells", [&] {
    row_of_slot_.assign(chosen.size(), -1);
    for (std::size_t slot = 0; slot < chosen.size(); ++slot)
      if (chosen[slot] != 0) add(static_cast<Index>(slot));
  });
}

void CellNumbers::add(Index slot) {
  if (size_ % rows_per_anchor == 0) anchors_.push_back(slot);
  row_of_slot_[slot] = static_cast<SignedIndex>(size_++);
}

CellId CellNumbers::cell(std::size_t row) const {
  if (DELONE_HARDENED && row >= size_) detail::throw_out_of_range("the row of a cell");
  Index slot = anchors_[row / rows_per_anchor];
  while (row_of_slot_[slot] != static_cast<SignedIndex>(row)) ++slot;
  return CellId{slot};
}

}  // namespace delone
