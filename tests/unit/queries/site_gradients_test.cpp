// SPDX-License-Identifier: BSD-3-Clause
#include "queries/site_gradients.hpp"

#include "degenerate.hpp"

#include <delone/delaunay.hpp>

#include <gtest/gtest.h>

namespace delone::queries {
namespace {

TEST(FitGradients, SolvesTheNormalEquations) {
  test::Random random(1);
  for (std::size_t d = 1; d <= 5; ++d) {
    const std::size_t n = d + 4;
    std::vector<double> weights, differences, rows, g(2 * d);
    for (std::size_t i = 0; i < n; ++i) {
      weights.push_back(random.real() + 0.1);
      for (int c = 0; c < 2; ++c) differences.push_back(random.real());
      for (std::size_t j = 0; j < d; ++j) rows.push_back(random.real() - 0.5);
    }
    fit_gradients(weights, differences, 2, rows, d, g.data());
    for (std::size_t c = 0; c < 2; ++c)
      for (std::size_t m = 0; m < d; ++m) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) {
          double residual = differences[2 * i + c];
          for (std::size_t j = 0; j < d; ++j) residual -= g[c * d + j] * rows[i * d + j];
          sum += weights[i] * residual * rows[i * d + m];
        }
        EXPECT_NEAR(sum, 0, 1e-12);
      }
  }
}

// Along (1, 1, 0) only: the solution of least length is along it, too.
TEST(FitGradients, OfLeastLength) {
  double g[3];
  fit_gradients(std::vector<double>{1, 2}, std::vector<double>{4, -8}, 1,
                std::vector<double>{1, 1, 0, -2, -2, 0}, 3, g);
  EXPECT_NEAR(g[0], 2, 1e-14);
  EXPECT_NEAR(g[1], 2, 1e-14);
  EXPECT_EQ(g[2], 0);
}

// a + b·x + c·|x|²: exact inside; linear: everywhere.
TEST(EstimateGradients, AreExactForSphericalQuadratics) {
  for (int d = 1; d <= 4; ++d) {
    const auto size = static_cast<std::size_t>(d);
    test::Random random(static_cast<std::uint64_t>(d));
    std::vector<double> points;
    for (int i = 0; i < 40 * d; ++i) points.push_back(random.real());
    points.insert(points.end(), size, 0.5);
    const Delaunay<> t(points, d);
    const NaturalCenters centers(t, true);
    std::vector<double> values(t.complex().num_vertex_slots() * 2);
    for (const VertexId v : t.complex().finite_vertices())
      for (std::size_t j = 0; j < size; ++j) {
        const double x = t.Triangulation::point(v)[j];
        values[2 * index(v)] += static_cast<double>(j + 1) * x;
        values[2 * index(v) + 1] += static_cast<double>(j + 1) * x + 3 * x * x;
      }
    int num_inside = 0;
    for (const VertexId v : t.complex().finite_vertices()) {
      std::vector<double> g(2 * size);
      estimate_gradients(centers, v, values, 2, g.data());
      bool inside = true;
      for (const CellId c : t.complex().star(v)) inside = inside && !t.complex().is_infinite(c);
      num_inside += inside ? 1 : 0;
      for (std::size_t j = 0; j < size; ++j) {
        EXPECT_NEAR(g[j], static_cast<double>(j + 1), 1e-9);
        if (!inside) continue;
        EXPECT_NEAR(g[size + j], static_cast<double>(j + 1) + 6 * t.Triangulation::point(v)[j], 1e-8);
      }
    }
    EXPECT_GT(num_inside, 0);
  }
}

TEST(EstimateGradients, OfASinglePointAreZero) {
  const Delaunay<> t(std::vector<double>{3, 4}, 2);
  const NaturalCenters centers(t, true);
  double g[2] = {1, 1};
  estimate_gradients(centers, t.vertex_at(0), std::vector<double>{0, 5}, 1, g);
  EXPECT_EQ(g[0], 0);
  EXPECT_EQ(g[1], 0);
}

}  // namespace
}  // namespace delone::queries
