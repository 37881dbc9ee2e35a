// SPDX-License-Identifier: BSD-3-Clause
#include "faces/shapes_of_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace delone::internal {
namespace {

/// Corners of a regular simplex of dimension k in R^(k+1): the unit vectors, times a size.
std::vector<double> corners_of_regular_simplex(std::size_t k, double size) {
  std::vector<double> points((k + 1) * (k + 1), 0);
  for (std::size_t i = 0; i <= k; ++i) points[i * (k + 1) + i] = size;
  return points;
}

TEST(ShapesOfCells, RegularSimplicesHaveQualityOne) {
  for (std::size_t k = 1; k <= 6; ++k)
    for (const double size : {1.0, 1e-200, 1e200, 1e-305, 1e305}) {
      std::vector<SignedIndex> cell;
      for (std::size_t i = 0; i <= k; ++i) cell.push_back(static_cast<SignedIndex>(i));
      const auto shapes = shapes_of_cells(corners_of_regular_simplex(k, size), static_cast<int>(k) + 1, cell,
                                          static_cast<int>(k) + 1);
      const double n = static_cast<double>(k) + 1;
      EXPECT_NEAR(shapes.radius[0] / size, std::sqrt(1 - 1 / n), 1e-12);
      EXPECT_NEAR(shapes.ratio[0], 1, 1e-9);
    }
}

TEST(ShapesOfCells, KnownTriangleAndTetrahedron) {
  // 3, 4, 5: circumradius 5/2, inradius 1. The corner of a cube: √3/2 and (3 − √3)/6.
  const auto triangle =
      shapes_of_cells(std::vector<double>{0, 0, 3, 0, 0, 4}, 2, std::vector<SignedIndex>{0, 1, 2}, 3);
  EXPECT_EQ(triangle.radius[0], 2.5);
  EXPECT_NEAR(triangle.ratio[0], 0.8, 1e-9);
  const auto corner = shapes_of_cells(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, 3,
                                      std::vector<SignedIndex>{3, 1, 0, 2}, 4);
  EXPECT_NEAR(corner.radius[0], std::sqrt(3) / 2, 1e-15);
  EXPECT_NEAR(corner.ratio[0], 3 * (3 - std::sqrt(3)) / 6 / (std::sqrt(3) / 2), 1e-9);
}

TEST(ShapesOfCells, FlatOnesHaveNone) {
  // On a line, with equal corners and with a corner twice; on lattices and off them, among good cells.
  for (const double x : {1.0, 1.0 / 3, 1e-200, 1e200}) {
    const auto shapes =
        shapes_of_cells(std::vector<double>{0, 0, x, x, 2 * x, 2 * x, 0, 0, x, 0}, 2,
                        std::vector<SignedIndex>{0, 1, 2, 0, 1, 4, 0, 3, 0, 1, 1, 2, 0, 3, 1, 0, 4, 1}, 3);
    for (std::size_t cell = 0; cell < shapes.radius.size(); ++cell) {
      const bool is_flat = cell != 1 && cell != 5;
      EXPECT_EQ(std::isnan(shapes.radius[cell]), is_flat) << cell;
      EXPECT_EQ(std::isnan(shapes.ratio[cell]), is_flat) << cell;
    }
  }
}

}  // namespace
}  // namespace delone::internal
