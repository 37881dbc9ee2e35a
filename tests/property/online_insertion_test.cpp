// SPDX-License-Identifier: BSD-3-Clause
// Points inserted one by one, in no order and without hints: the result is that of a batch, and walks stay
// short.
#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace delone {
namespace {

std::vector<double> points_of_kind(const char* kind, int dimension, std::size_t n) {
  return make_point_set(kind, dimension, n, 3);
}

std::span<const double> row(const std::vector<double>& points, int dimension, std::size_t i) {
  const auto d = static_cast<std::size_t>(dimension);
  return std::span<const double>(points).subspan(i * d, d);
}

double visited_per_insertion(const char* kind, int dimension, std::size_t n) {
  SCOPED_TRACE(std::string(kind) + " in dimension " + std::to_string(dimension));
  const std::vector<double> points = points_of_kind(kind, dimension, n);
  Delaunay<> online(dimension);
  const std::size_t half = n / 2;
  for (std::size_t i = 0; i < half; ++i) online.insert(row(points, dimension, i));
  const std::uint64_t before = online.statistics().visited_cells;
  for (std::size_t i = half; i < n; ++i) online.insert(row(points, dimension, i));
  EXPECT_EQ(online.hash(), Delaunay<>(points, dimension).hash());
  return static_cast<double>(online.statistics().visited_cells - before) / static_cast<double>(n - half);
}

TEST(OnlineInsertion, WalksDoNotGrowWithTheNumberOfPoints) {
  // From the last insertion a walk would cross about 80 triangles, or 25 tetrahedra.
  EXPECT_LT(visited_per_insertion("uniform", 2, 20000), 5);
  EXPECT_LT(visited_per_insertion("uniform", 3, 8000), 5);
  EXPECT_LT(visited_per_insertion("clusters", 2, 20000), 8);
  EXPECT_LT(visited_per_insertion("clusters", 3, 8000), 8);
}

TEST(OnlineInsertion, AfterABatchAndBetweenBatches) {
  const std::vector<double> points = points_of_kind("uniform", 3, 6000);
  Delaunay<> mixed(std::span<const double>(points).first(6000), 3);
  for (std::size_t i = 2000; i < 2500; ++i) mixed.insert(row(points, 3, i));
  mixed.insert_range(std::span<const double>(points).subspan(7500, 4500));
  const std::uint64_t before = mixed.statistics().visited_cells;
  for (std::size_t i = 4000; i < 6000; ++i) mixed.insert(row(points, 3, i));
  EXPECT_EQ(mixed.hash(), Delaunay<>(points, 3).hash());
  EXPECT_LT(static_cast<double>(mixed.statistics().visited_cells - before) / 2000, 5);
}

TEST(OnlineInsertion, FromAGrowingBox) {
  std::vector<double> points = points_of_kind("uniform", 2, 4000);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] *= std::ldexp(1.0, static_cast<int>(i / 2 / 500) * 40 - 160);
  Delaunay<> online(2);
  for (std::size_t i = 0; i < 4000; ++i) online.insert(row(points, 2, i));
  EXPECT_EQ(online.hash(), Delaunay<>(points, 2).hash());
  EXPECT_LT(static_cast<double>(online.statistics().visited_cells) / 4000, 10);
}

TEST(OnlineInsertion, OfPointsInAFlatThatIsLeftLate) {
  std::vector<double> points;
  for (std::size_t i = 0; i < 1500; ++i) {
    const double x = static_cast<double>(i * 37 % 1500), y = static_cast<double>(i * 91 % 1500);
    points.insert(points.end(), {x, y, x + y});
  }
  points.insert(points.end(), {3.0, 5.0, 100.0, 7.0, 11.0, -400.0});
  Delaunay<> online(3);
  for (std::size_t i = 0; i < points.size() / 3; ++i) online.insert(row(points, 3, i));
  EXPECT_EQ(online.hash(), Delaunay<>(points, 3).hash());
}

TEST(OnlineInsertion, OfWeightedPointsThatHideLandmarks) {
  const std::vector<double> points = points_of_kind("uniform", 2, 3000);
  std::vector<double> weights;
  // The later, the heavier: most early points become hidden.
  for (std::size_t i = 0; i < 3000; ++i) weights.push_back(1e-6 * static_cast<double>(i * (i % 7)));
  Regular<> online(2);
  for (std::size_t i = 0; i < weights.size(); ++i) online.insert(row(points, 2, i), weights[i]);
  const Regular<> batch(points, weights, 2);
  EXPECT_EQ(online.hash(), batch.hash());
  EXPECT_EQ(online.num_hidden(), batch.num_hidden());
  EXPECT_GT(batch.num_hidden(), 1000u);
}

}  // namespace
}  // namespace delone
