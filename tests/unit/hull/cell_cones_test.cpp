// SPDX-License-Identifier: BSD-3-Clause
// Weights in the cones of cells: those of vertices are known, and flat cones have none.
#include "hull/cell_cones.hpp"

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::hull {
namespace {

HullState hull_of_points(int d, std::size_t n, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<double> points(n * static_cast<std::size_t>(d));
  for (double& x : points) x = random.real() - 0.5;
  HullState state(d);
  state.insert_range(points, {});
  return state;
}

TEST(CellCones, TheInverseTakesVerticesToUnitVectors) {
  for (int dimension = 2; dimension <= 6; ++dimension) {
    const auto d = static_cast<std::size_t>(dimension);
    const HullState state = hull_of_points(dimension, 30, d);
    const std::vector<double>& center = state.boundary()->center();
    CellCones cones(state, center.data());
    for (int turn = 0; turn < 2; ++turn)  // the second time they are known
      for (std::size_t c = 0; c < cones.hull().num_cells(); ++c) {
        const double* const inverse = cones.inverse(c);
        double size = 1;
        for (std::size_t i = 0; i < d * d; ++i) size = std::max(size, std::fabs(inverse[i]));
        for (std::size_t v = 0; v < d; ++v)
          for (std::size_t i = 0; i < d; ++i) {
            double weight = 0;
            for (std::size_t j = 0; j < d; ++j) weight += inverse[i * d + j] * cones.edge(c, v, j);
            EXPECT_NEAR(weight, i == v ? 1 : 0, 1e-14 * size * size);
          }
      }
  }
}

/// Seen from a vertex, the cones of all cells with this vertex are flat.
TEST(CellCones, FlatConesHaveNoNumbers) {
  const HullState state = hull_of_points(3, 20, 1);
  const double* const vertex = state.sites().point(state.hull().cell(0)[0]);
  CellCones cones(state, vertex);
  EXPECT_FALSE(std::isfinite(cones.inverse(0)[0]));
}

}  // namespace
}  // namespace delone::hull
