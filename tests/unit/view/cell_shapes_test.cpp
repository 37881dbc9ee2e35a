// SPDX-License-Identifier: BSD-3-Clause
#include "view/cell_shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace delone;

/// Corners of a regular simplex of dimension k in R^(k+1): the unit vectors, times a size.
std::vector<double> regular(std::size_t k, double size) {
  std::vector<double> points((k + 1) * (k + 1), 0);
  for (std::size_t i = 0; i <= k; ++i) points[i * (k + 1) + i] = size;
  return points;
}

TEST(ViewCellShapes, RegularSimplicesHaveQualityOne) {
  for (std::size_t k = 1; k <= 6; ++k)
    for (const double size : {1.0, 1e-200, 1e200}) {
      std::vector<SignedIndex> cell;
      for (std::size_t i = 0; i <= k; ++i) cell.push_back(static_cast<SignedIndex>(i));
      const auto shapes =
          view::cell_shapes(regular(k, size), static_cast<int>(k) + 1, cell, static_cast<int>(k) + 1);
      const double n = static_cast<double>(k) + 1;
      EXPECT_NEAR(shapes.radius[0] / size, std::sqrt(1 - 1 / n), 1e-12);
      EXPECT_NEAR(shapes.quality[0], 1, 1e-12);
    }
}

TEST(ViewCellShapes, KnownTriangleAndTetrahedron) {
  // 3, 4, 5: circumradius 5/2, inradius 1. The corner of a cube: √3/2 and (3 − √3)/6.
  const auto triangle =
      view::cell_shapes(std::vector<double>{0, 0, 3, 0, 0, 4}, 2, std::vector<SignedIndex>{0, 1, 2}, 3);
  EXPECT_NEAR(triangle.radius[0], 2.5, 1e-14);
  EXPECT_NEAR(triangle.quality[0], 0.8, 1e-14);
  const auto corner = view::cell_shapes(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, 3,
                                        std::vector<SignedIndex>{3, 1, 0, 2}, 4);
  EXPECT_NEAR(corner.radius[0], std::sqrt(3) / 2, 1e-14);
  EXPECT_NEAR(corner.quality[0], 3 * (3 - std::sqrt(3)) / 6 / (std::sqrt(3) / 2), 1e-14);
}

TEST(ViewCellShapes, FlatOnesHaveNone) {
  const auto shapes = view::cell_shapes(std::vector<double>{0, 0, 1, 1, 2, 2, 0, 0}, 2,
                                        std::vector<SignedIndex>{0, 1, 2, 0, 3, 0}, 3);
  EXPECT_TRUE(std::isnan(shapes.radius[0]) && std::isnan(shapes.quality[0]));
  EXPECT_TRUE(std::isnan(shapes.radius[1]));
}

}  // namespace
