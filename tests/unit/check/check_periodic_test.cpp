// SPDX-License-Identifier: BSD-3-Clause
// The check of periodic triangulations finds what is wrong, at its level.
#include <delone/check.hpp>
#include <delone/periodic.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace delone {
namespace {

ComplexData sample(bool with_weights = false, int rank = 3) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> points(60), weights(20);
  for (double& x : points) x = std::ldexp(std::nearbyint(std::ldexp(uniform(random), 30)), -30);
  for (double& w : weights) w = uniform(random) / 4;
  Lattice lattice{3, {1, 0, 0, .25, 1, 0, 0, .5, 1}};
  lattice.vectors.resize(static_cast<std::size_t>(3 * rank));
  if (with_weights) return PeriodicRegular<>(PointsView(points, 3), weights, lattice).to_data();
  return PeriodicDelaunay<>(PointsView(points, 3), lattice).to_data();
}

/// Data that something was done to violate this level.
void expect_violation(int level, const char* what, const std::function<void(ComplexData&)>& spoil,
                      ComplexData data = sample()) {
  SCOPED_TRACE(what);
  ASSERT_TRUE(check(data).ok);
  spoil(data);
  const CheckReport report = check(data);
  EXPECT_FALSE(report.ok);
  EXPECT_EQ(report.reached.number, level) << report;
}

TEST(CheckPeriodic, RightDataPass) {
  for (const bool with_weights : {false, true})
    for (int rank = 1; rank <= 3; ++rank) {
      const CheckReport report = check(sample(with_weights, rank), {.canonical = true});
      EXPECT_TRUE(report.ok) << report;
      EXPECT_EQ(report.reached.number, 6);
    }
}

TEST(CheckPeriodic, EachLevelFindsItsViolations) {
  expect_violation(1, "a row out of range", [](ComplexData& data) { data.cells[5] = 20; });
  expect_violation(1, "offsets are missing", [](ComplexData& data) { data.cell_offsets.pop_back(); });
  expect_violation(1, "points off the grid", [](ComplexData& data) { data.points[7] = 0.1; });
  expect_violation(1, "a singular lattice",
                   [](ComplexData& data) { std::fill_n(data.lattice.begin(), 3, 0.0); });
  expect_violation(1, "a vertex twice", [](ComplexData& data) {
    data.cells[1] = data.cells[0];
    std::copy_n(data.cell_offsets.begin(), 3, data.cell_offsets.begin() + 3);
  });
  expect_violation(2, "a neighbor at another place", [](ComplexData& data) { ++data.neighbor_offsets[4]; });
  expect_violation(2, "another neighbor",
                   [](ComplexData& data) { std::swap(data.neighbors[0], data.neighbors[1]); });
  expect_violation(2, "an offset of a cell", [](ComplexData& data) { ++data.cell_offsets[10]; });
  expect_violation(2, "outside of a set that is periodic everywhere",
                   [](ComplexData& data) { data.neighbors[3] = -1; });
  expect_violation(
      3, "outside of a slab in its interior",
      [](ComplexData& data) {
        const auto inner =
            std::find_if(data.neighbors.begin(), data.neighbors.end(), [](SignedIndex c) { return c >= 0; });
        const auto other = static_cast<std::size_t>(*inner);
        const auto back = std::find(data.neighbors.begin() + static_cast<std::ptrdiff_t>(4 * other),
                                    data.neighbors.begin() + static_cast<std::ptrdiff_t>(4 * other + 4),
                                    static_cast<SignedIndex>((inner - data.neighbors.begin()) / 4));
        *inner = *back = -1;
      },
      sample(false, 2));
  expect_violation(4, "another orientation", [](ComplexData& data) {
    // Two vertices of every cell change places, with their neighbors.
    for (std::size_t c = 0; c < data.num_cells(); ++c) {
      std::swap(data.cells[4 * c], data.cells[4 * c + 1]);
      std::swap(data.neighbors[4 * c], data.neighbors[4 * c + 1]);
      std::swap_ranges(data.cell_offsets.begin() + static_cast<std::ptrdiff_t>(12 * c),
                       data.cell_offsets.begin() + static_cast<std::ptrdiff_t>(12 * c + 3),
                       data.cell_offsets.begin() + static_cast<std::ptrdiff_t>(12 * c + 3));
      std::swap_ranges(data.neighbor_offsets.begin() + static_cast<std::ptrdiff_t>(12 * c),
                       data.neighbor_offsets.begin() + static_cast<std::ptrdiff_t>(12 * c + 3),
                       data.neighbor_offsets.begin() + static_cast<std::ptrdiff_t>(12 * c + 3));
    }
  });
  expect_violation(
      5, "weights of another triangulation",
      [](ComplexData& data) {
        for (std::size_t row = 0; row < 20; ++row)
          if (data.vertex_of_point[row] >= 0) data.weights[row] += row % 2 == 0 ? 0.02 : -0.02;
      },
      sample(true));
  expect_violation(6, "a point that is no vertex", [](ComplexData& data) {
    data.points.insert(data.points.end(), {0.5, 0.5, 0.5});
    data.vertex_of_point.push_back(20);
    data.point_offsets.insert(data.point_offsets.end(), 3, 0);
  });
  expect_violation(6, "an offset of a duplicate", [](ComplexData& data) {
    data.points.insert(data.points.end(), {data.points[0] + 1, data.points[1], data.points[2]});
    data.vertex_of_point.push_back(0);
    data.point_offsets.insert(data.point_offsets.end(), 3, 0);
  });
}

}  // namespace
}  // namespace delone
