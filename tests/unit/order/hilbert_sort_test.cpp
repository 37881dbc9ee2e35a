// SPDX-License-Identifier: BSD-3-Clause
// The Hilbert order: a true Hilbert curve on full grids, a permutation always, blind to scale and offset.
#include "order/insertion_order.hpp"

#include "base/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

namespace delone::order {
namespace {

std::vector<Index> all_rows(std::size_t n) {
  std::vector<Index> rows(n);
  std::iota(rows.begin(), rows.end(), Index{0});
  return rows;
}

std::vector<Index> sorted_rows(const std::vector<double>& x, int d, int first_axis = 0) {
  auto rows = all_rows(x.size() / static_cast<std::size_t>(d));
  hilbert_sort(PointsView(x, d), rows, first_axis);
  return rows;
}

bool is_permutation(std::vector<Index> rows, std::size_t n) {
  std::sort(rows.begin(), rows.end());
  return rows == all_rows(n);
}

std::vector<double> uniform_points(int d, std::size_t n, std::uint64_t seed) {
  random::Generator generator(seed);
  std::vector<double> x(n * static_cast<std::size_t>(d));
  for (double& v : x) v = generator.uniform();
  return x;
}

/// All points of {0 … side−1}^d, in random order.
std::vector<double> full_grid(int d, std::size_t side, std::uint64_t seed) {
  std::size_t n = 1;
  for (int j = 0; j < d; ++j) n *= side;
  std::vector<double> x;
  for (Index i : shuffled_order(n, seed)) {
    std::size_t rest = i;
    for (int j = 0; j < d; ++j, rest /= side) x.push_back(static_cast<double>(rest % side));
  }
  return x;
}

double l1_distance(const std::vector<double>& x, int d, Index a, Index b) {
  double sum = 0;
  for (int j = 0; j < d; ++j) {
    const auto k = static_cast<std::size_t>(d), i = static_cast<std::size_t>(j);
    sum += std::abs(x[static_cast<std::size_t>(a) * k + i] - x[static_cast<std::size_t>(b) * k + i]);
  }
  return sum;
}

struct Grid {
  int dimension;
  std::size_t side;
};

class HilbertGrid : public testing::TestWithParam<Grid> {};

TEST_P(HilbertGrid, ConsecutivePointsOfAFullGridAreNeighbors) {
  const auto [d, side] = GetParam();
  for (int first_axis = 0; first_axis < d; ++first_axis) {
    const auto x = full_grid(d, side, 7);
    const auto rows = sorted_rows(x, d, first_axis);
    ASSERT_TRUE(is_permutation(rows, x.size() / static_cast<std::size_t>(d)));
    for (std::size_t i = 1; i < rows.size(); ++i)
      ASSERT_EQ(l1_distance(x, d, rows[i - 1], rows[i]), 1) << "first axis " << first_axis << ", step " << i;
    // The curve starts at the origin and ends at the far corner of one edge of the cube.
    EXPECT_EQ(l1_distance(x, d, rows.front(), rows.back()), static_cast<double>(side) - 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Grids, HilbertGrid,
                         testing::Values(Grid{1, 64}, Grid{2, 2}, Grid{2, 4}, Grid{2, 64}, Grid{3, 2},
                                         Grid{3, 16}, Grid{4, 2}, Grid{4, 8}, Grid{5, 4}, Grid{6, 4},
                                         Grid{10, 2}));

TEST(HilbertSort, HalvesOfAnyLevelAreSeparated) {
  // The property that appendix A rests on: each half of a half, … of the order lies on one side of a median
  // hyperplane.
  const auto x = uniform_points(3, 512, 3);
  const auto rows = sorted_rows(x, 3);
  for (std::size_t width = 512; width >= 2; width /= 2)
    for (std::size_t begin = 0; begin < rows.size(); begin += width) {
      bool separated = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = [&](std::size_t i) { return x[rows[i] * std::size_t{3} + axis]; };
        double min_1 = 2, max_1 = -1, min_2 = 2, max_2 = -1;
        for (std::size_t i = begin; i < begin + width / 2; ++i)
          min_1 = std::min(min_1, value(i)), max_1 = std::max(max_1, value(i));
        for (std::size_t i = begin + width / 2; i < begin + width; ++i)
          min_2 = std::min(min_2, value(i)), max_2 = std::max(max_2, value(i));
        separated = separated || max_1 <= min_2 || max_2 <= min_1;
      }
      ASSERT_TRUE(separated) << "width " << width << ", begin " << begin;
    }
}

TEST(HilbertSort, KeepsConsecutivePointsClose) {
  // A Hilbert order of n uniform points in the square has steps of about 1.1·n^(−1/2); a random order of
  // about 0.52.
  const auto x = uniform_points(2, 10000, 5);
  const auto rows = sorted_rows(x, 2);
  double length = 0;
  for (std::size_t i = 1; i < rows.size(); ++i)
    length += std::hypot(x[2 * rows[i]] - x[2 * rows[i - 1]], x[2 * rows[i] + 1] - x[2 * rows[i - 1] + 1]);
  EXPECT_LT(length / 10000, 1.4 / 100);
}

TEST(HilbertSort, KeepsPointsOfAClusterClose) {
  // Most points are in one of the cubes that the box is split into, and further apart points come before and
  // after them.
  auto x = uniform_points(2, 10000, 5);
  for (std::size_t i = 0; i < 8000; ++i) {
    x[2 * i] = 0.3 + x[2 * i] * 1e-6;
    x[2 * i + 1] = 0.7 + x[2 * i + 1] * 1e-6;
  }
  const auto rows = sorted_rows(x, 2);
  double within = 0;
  std::size_t steps = 0;
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (rows[i] < 8000 && rows[i - 1] < 8000) {
      within += std::hypot(x[2 * rows[i]] - x[2 * rows[i - 1]], x[2 * rows[i] + 1] - x[2 * rows[i - 1] + 1]);
      ++steps;
    }
  EXPECT_GT(steps, 7900u);
  EXPECT_LT(within / 8000, 1.6e-6 / std::sqrt(8000));
}

TEST(HilbertSort, IsBlindToScaleAndOffsetOfEachAxis) {
  const auto x = full_grid(3, 8, 11);
  auto y = x;
  const double scale[] = {1e-300, 4096, 1e200}, offset[] = {0, -1e6, 1e201};
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = y[i] * scale[i % 3] + offset[i % 3];
  EXPECT_EQ(sorted_rows(x, 3), sorted_rows(y, 3));
  const auto far = uniform_points(6, 500, 1);
  auto moved = far;
  for (double& v : moved)
    v = v * 0x1p40 + 0x1p42;  // monotone; ties of the rounded coordinates are possible and rare
  EXPECT_TRUE(is_permutation(sorted_rows(moved, 6), 500));
}

TEST(HilbertSort, FewerPointsThanCorners) {
  for (int d : {2, 5, 20, 63, 64, 65, 100})
    for (std::size_t n : {0u, 1u, 2u, 3u, 7u, 60u}) {
      const auto x = uniform_points(d, n, 13);
      for (int first_axis : {0, d / 2, d - 1}) {
        const auto rows = sorted_rows(x, d, first_axis);
        EXPECT_TRUE(is_permutation(rows, n)) << d << " " << n;
        if (n > 1) {
          // The first split is along the first axis: the low half comes first.
          double low = -1, high = 2;
          for (std::size_t i = 0; i < n; ++i) {
            const double v = x[rows[i] * static_cast<std::size_t>(d) + static_cast<std::size_t>(first_axis)];
            if (i < n / 2)
              low = std::max(low, v);
            else
              high = std::min(high, v);
          }
          EXPECT_LT(low, high);
        }
      }
    }
}

TEST(HilbertSort, AllPointsEqual) {
  for (int d : {1, 3, 4, 7, 100})
    EXPECT_TRUE(
        is_permutation(sorted_rows(std::vector<double>(static_cast<std::size_t>(d) * 1000, 0.5), d), 1000));
}

TEST(HilbertSort, SortedAndHeavilyTiedInput) {
  std::vector<double> x;
  for (int i = 0; i < 20000; ++i) x.insert(x.end(), {double(i), double(i % 3), 0.0});
  EXPECT_TRUE(is_permutation(sorted_rows(x, 3), 20000));
  std::reverse(x.begin(), x.end());
  EXPECT_TRUE(is_permutation(sorted_rows(x, 3), 20000));
}

TEST(HilbertSort, SortsASubsetInPlace) {
  const auto x = uniform_points(3, 100, 17);
  std::vector<Index> rows{90, 3, 77, 15, 4};
  hilbert_sort(PointsView(x, 3), rows);
  EXPECT_EQ(std::set<Index>(rows.begin(), rows.end()), (std::set<Index>{3, 4, 15, 77, 90}));
}

}  // namespace
}  // namespace delone::order
