// SPDX-License-Identifier: BSD-3-Clause
// Rows of box faces that are taken out are in the hull of the others, on its boundary.
#include "hull/box_faces.hpp"

#include "degenerate.hpp"
#include "hull/hull_analysis.hpp"
#include "scale.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace delone::hull {
namespace {

/// Points of the cube, and of its floor and one of its walls.
std::vector<double> room(int dimension, std::size_t n, double unit) {
  std::vector<double> rows = make_point_set("uniform", dimension, 3 * n, 1);
  const auto d = static_cast<std::size_t>(dimension);
  for (std::size_t i = 0; i < n; ++i) rows[i * d] = 0;
  for (std::size_t i = n; i < 2 * n; ++i) rows[i * d + d - 1] = 1;
  if (unit > 0)
    for (double& x : rows) x = std::nearbyint(x / unit) * unit;
  return rows;
}

TEST(BoxFaces, HaveInnerRowsThatAreNotExtreme) {
  const std::size_t n = test::scaled_size(2000, 700);
  for (int d = 3; d <= 5; ++d)
    for (const double unit : {0.0, 0x1p-4, 0x1p-2}) {
      const auto size = static_cast<std::size_t>(d);
      const std::vector<double> rows = room(d, n, unit);
      const std::vector<char> is_inner = find_inner_rows_of_box_faces(rows, d, 1);
      ASSERT_EQ(is_inner.size(), 3 * n);
      EXPECT_GT(std::count(is_inner.begin(), is_inner.end(), 1), static_cast<std::ptrdiff_t>(n));
      std::vector<double> others;
      for (std::size_t row = 0; row < 3 * n; ++row)
        if (is_inner[row] == 0)
          others.insert(others.end(), rows.begin() + static_cast<std::ptrdiff_t>(row * size),
                        rows.begin() + static_cast<std::ptrdiff_t>((row + 1) * size));
      HullState hull(d);
      Options as_given;
      as_given.order = InsertionOrder::as_given;
      hull.insert_range(others, as_given);
      const HullLocator locator(hull.sites(), *hull.boundary());
      for (std::size_t row = 0; row < 3 * n; ++row) {
        if (is_inner[row] == 0) continue;
        const double* const point = rows.data() + row * size;
        kernel::Grid grid = hull.sites().grid;
        grid.include(point);
        EXPECT_EQ(locator.locate(point, grid).side, Sign::zero) << d << ' ' << unit << ' ' << row;
      }
    }
}

TEST(BoxFaces, HaveNoneWhereFewAreOnThem) {
  EXPECT_TRUE(find_inner_rows_of_box_faces(make_point_set("uniform", 3, 2000, 1), 3, 1).empty());
  EXPECT_TRUE(find_inner_rows_of_box_faces(room(2, 2000, 0), 2, 1).empty());
  EXPECT_TRUE(find_inner_rows_of_box_faces(room(3, 100, 0), 3, 1).empty());
}

// A face of one line has none, and nor has one whose rows are all extreme.
TEST(BoxFaces, ArePassedOverWhereTheySpanLess) {
  std::vector<double> rows = room(3, 1000, 0);
  for (std::size_t i = 0; i < 1000; ++i) rows[3 * i + 1] = 0.5;
  const std::vector<char> is_inner = find_inner_rows_of_box_faces(rows, 3, 1);
  EXPECT_EQ(std::count(is_inner.begin(), is_inner.begin() + 1000, 1), 0);
  EXPECT_GT(std::count(is_inner.begin(), is_inner.end(), 1), 500);
}

}  // namespace
}  // namespace delone::hull
