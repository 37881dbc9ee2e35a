// SPDX-License-Identifier: BSD-3-Clause
// What tests of edits in this folder share: triangulations that record, beside those of the same rows at
// once.
#pragma once

#include <delone/check.hpp>
#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <cstddef>
#include <numeric>
#include <vector>

namespace delone::construction {

using RowList = std::vector<std::size_t>;
using Rows = std::vector<double>;

/// The numbers first … last − 1.
inline RowList rows_from(std::size_t first, std::size_t last) {
  RowList rows(last - first);
  std::iota(rows.begin(), rows.end(), first);
  return rows;
}

inline void expect_sound(const Triangulation& t) {
  const CheckReport report = check(t.to_data(), {.canonical = true});
  EXPECT_TRUE(report.ok) << report.violation;
}

/// The cells are those of the rows that are left, inserted at once.
inline void expect_as_at_once(const Delaunay<>& t) {
  const ComplexData data = t.to_data();
  Rows left;
  for (std::size_t row = 0; row < t.num_rows(); ++row)
    if (t.has_row(row))
      for (std::size_t j = 0; j < static_cast<std::size_t>(t.dimension()); ++j)
        left.push_back(data.points[row * static_cast<std::size_t>(t.dimension()) + j]);
  EXPECT_EQ(t.hash(), Delaunay<>(left, t.dimension()).hash());
  EXPECT_EQ(t.num_points(), left.size() / static_cast<std::size_t>(t.dimension()));
  expect_sound(t);
}

/// Whether the last edit has rebuilt all cells, of which there were so many.
inline bool has_rebuilt(const Triangulation& t, Index num_before) {
  return t.changes().removed_cells.size() == num_before &&
         t.changes().created_cells.size() == t.num_all_cells();
}

}  // namespace delone::construction
