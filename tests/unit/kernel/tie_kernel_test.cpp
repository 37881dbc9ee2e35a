// SPDX-License-Identifier: BSD-3-Clause
// Ties broken many at a time, against one at a time and without a grid.
#include "kernel/tie_kernel.hpp"

#include "kernel/stages.hpp"
#include "random.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace delone::kernel {
namespace {

/// Cells of corners of a box, which are cospherical: barycentric coordinates of many other corners are 0.
template <int K>
void expect_the_same_as_one_at_a_time() {
  SCOPED_TRACE(testing::Message() << "dimension " << K);
  constexpr std::size_t row_size = K + 1, num_corners = std::size_t{1} << K;
  ASSERT_TRUE(can_break_together(K));
  random::Generator generator(static_cast<std::uint64_t>(K));
  std::vector<double> corners(num_corners * row_size, -7);  // the last entry of a row is not a coordinate
  Grid grid(K), fine(K);
  for (std::size_t v = 0; v < num_corners; ++v) {
    for (std::size_t r = 0; r < K; ++r) corners[v * row_size + r] = (v >> r & 1) != 0 ? static_cast<double>(r + 1) : 0.0;
    grid.include(&corners[v * row_size]);
    fine.include(&corners[v * row_size]);
  }
  fine.include(std::vector<double>(K, 1.0 / 3).data());
  ASSERT_TRUE(grid.is_small());
  ASSERT_FALSE(fine.is_small());
  std::vector<double> key_weights;
  for (int r = 0; r < K; ++r) key_weights.push_back(grid.key_weight(r));
  std::vector<int> axes(K);
  std::iota(axes.begin(), axes.end(), 0);
  const Flat flat{K, axes};

  std::size_t negative = 0, all = 0;
  for (std::size_t round = 0; round < test::scaled_count(300); ++round) {
    const double* query = &corners[generator.below(num_corners) * row_size];
    std::vector<std::vector<Index>> cells(1 + generator.below(20));
    std::vector<Sign> expected;
    for (auto& cell : cells) {
      std::vector<const double*> points;
      do {
        cell.clear();
        points.clear();
        while (cell.size() <= K) {
          cell.push_back(static_cast<Index>(generator.below(num_corners)));
          points.push_back(&corners[cell.back() * row_size]);
        }
      } while (orientation<K>(flat, points.data(), grid) != Sign::positive ||
               std::find(points.begin(), points.end(), query) != points.end());
      expected.push_back(perturbed_in_sphere<0>(flat, points.data(), query, fine));
    }
    std::vector<const Index*> vertices;
    for (const auto& cell : cells) vertices.push_back(cell.data());
    std::vector<Sign> sides(cells.size(), Sign::zero);
    break_ties({K, vertices, corners.data(), row_size, query, key_weights.data(), sides.data()});
    EXPECT_EQ(sides, expected);
    negative += static_cast<std::size_t>(std::count(expected.begin(), expected.end(), Sign::negative));
    all += expected.size();
  }
  EXPECT_GT(negative, 0u);
  EXPECT_LT(negative, all);
}

TEST(TieKernel, BreaksTiesAsTheScalarStagesDo) {
  expect_the_same_as_one_at_a_time<3>();
  expect_the_same_as_one_at_a_time<4>();
  expect_the_same_as_one_at_a_time<5>();
  expect_the_same_as_one_at_a_time<6>();
  expect_the_same_as_one_at_a_time<7>();
  expect_the_same_as_one_at_a_time<8>();
}

}  // namespace
}  // namespace delone::kernel
