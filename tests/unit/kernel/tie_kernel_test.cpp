// SPDX-License-Identifier: BSD-3-Clause
// Ties broken many at a time, against one at a time and without a grid.
#include "kernel/tie_kernel.hpp"

#include "base/random.hpp"
#include "kernel/stages.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace delone::kernel {
namespace {

/// Cells of corners of a box, which are cospherical: barycentric coordinates of many other corners are 0. Its
/// sides along the axes are 1, 3, 5, … times `side`, up to `longest`.
template <int K>
void expect_the_same_as_one_at_a_time(double side, std::size_t longest, bool is_tiny) {
  SCOPED_TRACE(testing::Message() << "dimension " << K << ", sides up to " << longest);
  constexpr std::size_t row_size = K + 1, num_corners = std::size_t{1} << K;
  if (!can_break_together(K)) return;  // a build with fewer compiled dimensions
  random::Generator generator(static_cast<std::uint64_t>(K));
  std::vector<double> corners(num_corners * row_size, -7);  // the last entry of a row is not a coordinate
  Grid grid(K), fine(K);
  for (std::size_t v = 0; v < num_corners; ++v) {
    for (std::size_t r = 0; r < K; ++r)
      corners[v * row_size + r] =
          (v >> r & 1) != 0 ? side * static_cast<double>(std::min(2 * r + 1, longest)) : 0.0;
    grid.include(&corners[v * row_size]);
    fine.include(&corners[v * row_size]);
  }
  fine.include(std::vector<double>(K, 1.0 / 3).data());
  ASSERT_TRUE(grid.is_small());
  ASSERT_FALSE(fine.is_small());
  ASSERT_EQ(grid.is_tiny(), is_tiny);
  std::vector<double> key_weights, tiny_key_weights, per_unit;
  for (int r = 0; r < K; ++r) {
    key_weights.push_back(grid.key_weight(r));
    tiny_key_weights.push_back(grid.tiny_key_weight(r));
    per_unit.push_back(grid.per_unit(r));
  }
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
    break_ties({K, vertices, corners.data(), row_size, query, key_weights.data(), nullptr, sides.data()});
    EXPECT_EQ(sides, expected);
    if (is_tiny && can_break_in_binary32(K)) {
      std::fill(sides.begin(), sides.end(), Sign::zero);
      break_ties({K, vertices, corners.data(), row_size, query, tiny_key_weights.data(), per_unit.data(),
                  sides.data()});
      EXPECT_EQ(sides, expected);
    }
    negative += static_cast<std::size_t>(std::count(expected.begin(), expected.end(), Sign::negative));
    all += expected.size();
  }
  EXPECT_GT(negative, 0u);
  EXPECT_LT(negative, all);
}

TEST(TieKernel, BreaksTiesAsTheScalarStagesDo) {
  expect_the_same_as_one_at_a_time<3>(1, 5, true);
  expect_the_same_as_one_at_a_time<4>(1, 7, true);
  expect_the_same_as_one_at_a_time<5>(1, 9, true);
  expect_the_same_as_one_at_a_time<6>(1, 11, true);
  expect_the_same_as_one_at_a_time<7>(1, 13, false);
  expect_the_same_as_one_at_a_time<8>(1, 5, false);
  expect_the_same_as_one_at_a_time<3>(0x1p50, 1, true);
  expect_the_same_as_one_at_a_time<4>(0x1p-50, 3, true);
  expect_the_same_as_one_at_a_time<6>(0x1p50, 5, true);
  expect_the_same_as_one_at_a_time<7>(0x1p-50, 3, true);
  expect_the_same_as_one_at_a_time<8>(0x1p50, 1, true);
}

/// A grid of two points in 3D.
Grid grid_of(double x, double y, double z) {
  Grid grid(3);
  grid.include(std::vector<double>{0, 0, 7}.data());
  grid.include(std::vector<double>{x, y, z}.data());
  return grid;
}

TEST(TieKernel, KnowsWhatIsExactInBinary32) {
  EXPECT_TRUE(grid_of(99, 99, 106).is_tiny());
  EXPECT_TRUE(grid_of(127, 127, 134).is_tiny());
  EXPECT_FALSE(grid_of(129, 129, 136).is_tiny());  // keys are 259³ − 1 apart
  EXPECT_TRUE(grid_of(128, 128, 135).is_tiny());   // two numbers on the first two axes, whatever their unit
  EXPECT_TRUE(grid_of(8191, 1, 7).is_tiny());      // one on the last
  EXPECT_FALSE(grid_of(0x1p-23 + 1, 1, 8).is_tiny());
  EXPECT_EQ(grid_of(0.5, 3, 7).per_unit(0), 2);
  EXPECT_EQ(grid_of(0.5, 3, 7).per_unit(2), 1);
  EXPECT_EQ(grid_of(4, 3, 8).tiny_key_weight(0), 21);
}

}  // namespace
}  // namespace delone::kernel
