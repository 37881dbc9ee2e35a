// SPDX-License-Identifier: BSD-3-Clause
// The bounds from a grid, against the values and determinants of all simplices of a lattice.
#include "geometry/lattice.hpp"

#include "base/random.hpp"
#include "brute_force.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace delone::geometry {
namespace {

/// |det| of rows that are exact in binary64.
double determinant(const std::vector<std::vector<double>>& rows) {
  double unit = 0x1p-20;
  test::Matrix m;
  for (const auto& row : rows) {
    m.emplace_back();
    for (const double x : row) m.back().push_back(test::Integer(x / unit));
  }
  return std::fabs(static_cast<double>(test::determinant(m)) *
                   std::pow(unit, static_cast<double>(rows.size())));
}

TEST(Lattice, BoundsWhatIsNotZero) {
  random::Generator generator(1);
  for (const auto& [unit_x, unit_y] : {std::pair{1.0, 1.0}, {0.25, 2.0}, {8.0, 0.5}}) {
    kernel::Grid grid(2);
    std::vector<std::vector<double>> points;
    for (int i = 0; i < 16; ++i) {
      points.push_back({unit_x * (i % 4), unit_y * static_cast<double>(i / 4)});
      grid.include(points.back().data());
    }
    const std::vector<int> axes{0, 1};
    const Frame frame({0, 0}, {3 * unit_x, 3 * unit_y});
    const LatticeBounds bounds = Lattice(frame, axes).bounds(grid, axes);
    EXPECT_GT(bounds.numerator, 0);
    double least_numerator = 1e300, least_determinant = 1e300, least_value = 1e300, least_infinite = 1e300,
           least_edge = 1e300;
    for (int round = 0; round < 5000; ++round) {
      std::vector<std::vector<double>> edges, lifted;
      const auto& q = points[generator.below(16)];
      for (int i = 0; i < 3; ++i) {
        const auto& p = points[generator.below(16)];
        const double x = p[0] - q[0], y = p[1] - q[1], s = frame.lift_scale();
        edges.push_back({x * frame.scale()[0], y * frame.scale()[1]});
        lifted.push_back({edges.back()[0], edges.back()[1], (x * x + y * y) * s * s});
      }
      const auto keep_least = [](double& least, double x) {
        if (x != 0) least = std::min(least, x);
      };
      const double of_facet = determinant({edges[0], edges[1]}), numerator = determinant(lifted);
      std::vector<std::vector<double>> of_cell{edges[1], edges[2]};
      for (auto& edge : of_cell)
        for (std::size_t r = 0; r < 2; ++r) edge[r] -= edges[0][r];
      keep_least(least_determinant, determinant(of_cell));
      if (determinant(of_cell) != 0) {
        keep_least(least_numerator, numerator);
        keep_least(least_value, numerator / determinant(of_cell));
      }
      // The height over the line of a facet, in units of its larger coordinate.
      const double along =
          std::max(std::fabs(edges[0][0] - edges[1][0]), std::fabs(edges[0][1] - edges[1][1]));
      keep_least(least_edge, along);
      if (along > 0) keep_least(least_infinite, of_facet / along);
    }
    EXPECT_LE(bounds.numerator, least_numerator);
    EXPECT_LE(bounds.least_value(false), least_value);
    EXPECT_LE(bounds.least_determinant(false), least_determinant);
    EXPECT_LE(bounds.least_value(true), least_infinite);
    EXPECT_LE(bounds.least_determinant(true), least_edge);
    EXPECT_GE(bounds.numerator, least_numerator / 16);  // not by far too small
  }
}

TEST(Lattice, NumbersOfFullPrecisionSayNothingOfUse) {
  kernel::Grid grid(2);
  const double p[] = {0.1, 0.7}, q[] = {1e-300, 1.3};
  grid.include(p);
  grid.include(q);
  const std::vector<int> axes{0, 1};
  EXPECT_LT(Lattice(Frame({0, 0}, {1, 2}), axes).bounds(grid, axes).least_value(false), 1e-100);
  EXPECT_EQ(LatticeBounds().least_value(true), 0);
}

}  // namespace
}  // namespace delone::geometry
