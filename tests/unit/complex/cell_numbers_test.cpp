// SPDX-License-Identifier: BSD-3-Clause
// Numbers of cells against to_data(), which they are those of.
#include <delone/cell_numbers.hpp>
#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace delone::complex {
namespace {

void expect_rows_of_data(const Triangulation& t) {
  const ComplexData data = t.to_data();
  const Complex complex = t.complex();
  const CellNumbers numbers(complex);
  ASSERT_EQ(numbers.size(), data.num_cells());
  const int k = complex.affine_dimension();
  std::size_t row = 0;
  for (const CellId cell : complex.finite_cells()) {
    ASSERT_EQ(numbers.row(cell), static_cast<SignedIndex>(row));
    ASSERT_EQ(numbers.cell(row), cell);
    for (int i = 0; i <= k; ++i) {
      const std::size_t at = row * static_cast<std::size_t>(k + 1) + static_cast<std::size_t>(i);
      ASSERT_EQ(data.cells[at], static_cast<SignedIndex>(t.row_of(complex.vertex(cell, i))));
      ASSERT_EQ(data.neighbors[at], numbers.row(complex.neighbor(cell, i)));
    }
    ++row;
  }
  for (const CellId cell : complex.infinite_cells()) EXPECT_EQ(numbers.row(cell), -1);
  for (Index slot = 0; slot < complex.num_cell_slots(); ++slot)
    if (!complex.is_cell(CellId{slot})) {
      EXPECT_EQ(numbers.row(CellId{slot}), -1) << "a vacant slot";
    }
  EXPECT_EQ(numbers.row(invalid_cell), -1);
}

TEST(CellNumbers, AreRowsOfData) {
  for (const int d : {1, 2, 3, 5}) {
    Delaunay<> t(make_point_set("uniform", d, 150, 4), d);
    expect_rows_of_data(t);
    std::vector<std::size_t> removed;
    for (std::size_t row = 0; row < 100; ++row) removed.push_back(row);
    t.remove(removed);  // leaves vacant slots
    expect_rows_of_data(t);
    t.sort_cells();
    expect_rows_of_data(t);
  }
}

TEST(CellNumbers, OfFewPoints) {
  expect_rows_of_data(Delaunay<>(3));
  expect_rows_of_data(Delaunay<>(std::vector<double>{1, 2, 3}, 3));
  EXPECT_EQ(CellNumbers().size(), 0u);
  EXPECT_EQ(CellNumbers().row(CellId{0}), -1);
}

TEST(CellNumbers, OfChosenCells) {
  std::vector<std::uint8_t> chosen(200, 0);
  for (std::size_t slot = 3; slot < chosen.size(); slot += slot < 100 ? 1 : 7) chosen[slot] = 1;
  const CellNumbers numbers(chosen);
  std::size_t row = 0;
  for (std::size_t slot = 0; slot < chosen.size(); ++slot) {
    const CellId cell{static_cast<Index>(slot)};
    EXPECT_EQ(numbers.row(cell), chosen[slot] != 0 ? static_cast<SignedIndex>(row) : -1);
    if (chosen[slot] != 0) {
      EXPECT_EQ(numbers.cell(row++), cell);
    }
  }
  EXPECT_EQ(numbers.size(), row);
}

}  // namespace
}  // namespace delone::complex
