// SPDX-License-Identifier: BSD-3-Clause
// Closed forms, against known values and against triangulations.
#include "forecast/model/cell_counts.hpp"

#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace delone::cost_model {
namespace {

TEST(CellCounts, PoissonProcesses) {
  constexpr double pi = std::numbers::pi;
  EXPECT_NEAR(poisson_cells_per_point(1), 1, 1e-12);
  EXPECT_NEAR(poisson_cells_per_point(2), 2, 1e-12);
  EXPECT_NEAR(poisson_cells_per_point(3), 24 * pi * pi / 35, 1e-10);
  EXPECT_NEAR(poisson_cells_per_point(4), 286.0 / 9, 1e-9);
}

TEST(CellCounts, OfTheMomentCurve) {
  for (int k = 1; k <= 6; ++k)
    for (const int n : {k + 1, k + 2, 2 * k + 3, k <= 4 ? 30 : 16}) {
      // Small integers as parameters: coordinates are exact.
      std::vector<double> points;
      for (int t = 1; t <= n; ++t)
        for (int power = 1; power <= k; ++power) points.push_back(std::pow(t, power));
      const Delaunay<> triangulation(points, k);
      EXPECT_EQ(moment_curve_cells(k, n), static_cast<double>(triangulation.num_finite_cells()))
          << k << "D, " << n << " points";
    }
}

TEST(CellCounts, MostCellsAreThoseOfCyclicPolytopes) {
  EXPECT_EQ(most_cells(2, 10), 2 * 11 - 4);          // triangles of a sphere
  EXPECT_EQ(most_cells(3, 9), 10.0 * (10 - 3) / 2);  // facets of a neighborly polytope in 4D
  EXPECT_EQ(most_cells(4, 6), 12);
  for (int k = 1; k <= 5; ++k) {
    EXPECT_EQ(most_cells(k, k + 1), k + 2);  // a simplex
    EXPECT_EQ(most_cells(k, k), 0);
  }
  // Points on the moment curve have that many, with their hull facets.
  const Delaunay<> triangulation(make_point_set("moment", 3, 30), 3);
  EXPECT_LE(static_cast<double>(triangulation.num_all_cells()), most_cells(3, 30));
  EXPECT_GE(1.2 * static_cast<double>(triangulation.num_all_cells()), most_cells(3, 30));
}

TEST(CellCounts, OfLattices) {
  EXPECT_EQ(grid_side(3, 1000), 10);
  EXPECT_EQ(grid_side(3, 1001), 11);
  EXPECT_EQ(grid_side(8, 256), 2);
  const LatticeHull cube = lattice_hull(3, 1000, 10);
  EXPECT_EQ(cube.affine_dimension, 3);
  EXPECT_EQ(cube.volume, 729);
  const LatticeHull flat = lattice_hull(3, 9, 3);
  EXPECT_EQ(flat.affine_dimension, 2);
  EXPECT_EQ(flat.volume, 4);
  // Cells of a lattice have the volume 1/k!.
  for (const auto& [d, n] : {std::pair{3, 100}, {4, 300}, {5, 150}, {4, 17}}) {
    const Delaunay<> triangulation(make_point_set("grid", d, static_cast<std::size_t>(n)), d);
    const LatticeHull hull = lattice_hull(d, n, grid_side(d, n));
    EXPECT_EQ(hull.affine_dimension, triangulation.affine_dimension());
    const double cells = factorial(hull.affine_dimension) * hull.volume;
    EXPECT_NEAR(cells / static_cast<double>(triangulation.num_finite_cells()), 1, 0.06) << d << ' ' << n;
  }
}

}  // namespace
}  // namespace delone::cost_model
