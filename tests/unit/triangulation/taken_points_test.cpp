// SPDX-License-Identifier: BSD-3-Clause
// Points that are taken over: the result is that of points which are only read, and their memory is given
// back.
#include "scale.hpp"

#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace delone::triangulation {
namespace {

TEST(TakenPoints, GiveTheSameTriangulation) {
  struct Case {
    const char* kind;
    int dimension;
    std::size_t n;
  };
  // Some fit the heap, others are mapped and given back piece by piece; 200 points in 7D are wrapped.
  for (const Case& c : {Case{"uniform", 1, 300},
                        {"uniform", 2, test::scaled_size(100'000, 20'000)},
                        {"grid", 3, 1000},
                        {"duplicates", 3, 2000},
                        {"flat", 4, 500},
                        {"uniform", 7, test::scaled_size(200, 40)},
                        {"uniform", 9, 20}}) {
    SCOPED_TRACE(c.kind);
    const std::vector<double> points = make_point_set(c.kind, c.dimension, c.n, 1);
    std::vector<double> taken = points;
    const Delaunay<> expected(points, c.dimension), result(std::move(taken), c.dimension);
    EXPECT_TRUE(taken.empty());
    EXPECT_EQ(result.hash().hex(), expected.hash().hex());
    EXPECT_EQ(result.num_points(), expected.num_points());
    EXPECT_EQ(result.to_data().cells, expected.to_data().cells);
    EXPECT_EQ(result.to_data().points, points);
  }
}

TEST(TakenPoints, MayComeInSeveralBatches) {
  const std::size_t n = test::scaled_size(60'000, 12'000);
  std::vector<double> points = make_point_set("uniform", 3, n, 1);
  const auto middle = points.begin() + static_cast<std::ptrdiff_t>(3 * (n - n / 6));
  std::vector<double> first(points.begin(), middle), second(middle, points.end());
  Delaunay<> result(3);
  result.insert_range(std::move(first));
  result.insert_range(std::move(second));
  EXPECT_TRUE(first.empty());
  EXPECT_TRUE(second.empty());
  EXPECT_EQ(result.hash().hex(), Delaunay<>(points, 3).hash().hex());
}

TEST(TakenPoints, MayBeInAnyContainer) {
  std::vector<Delaunay<2>::Point> points = {{0, 0}, {1, 0}, {0, 1}, {3, 4}};
  const Delaunay<2> expected(points);
  EXPECT_EQ(points.size(), 4u);
  std::vector<Delaunay<2>::Point> once_more = points;
  const Delaunay<2> result(std::move(points));
  EXPECT_TRUE(points.empty());
  EXPECT_EQ(result.hash().hex(), expected.hash().hex());
  Delaunay<2> by_insertion;
  by_insertion.insert_range(std::move(once_more));
  EXPECT_TRUE(once_more.empty());
  EXPECT_EQ(by_insertion.hash().hex(), expected.hash().hex());
  EXPECT_EQ(Delaunay<2>(std::vector<double>{0, 0, 1, 0, 0, 1, 3, 4}).hash().hex(), expected.hash().hex());
}

TEST(TakenPoints, StayAfterAnError) {
  std::vector<double> points = {0, 0, 1, std::numeric_limits<double>::infinity()};
  Delaunay<> triangulation(2);
  EXPECT_THROW(triangulation.insert_range(std::move(points)), Error);
  EXPECT_EQ(points.size(), 4u);
  points.resize(3);
  EXPECT_THROW(triangulation.insert_range(std::move(points)), Error);
  EXPECT_EQ(points.size(), 3u);
  EXPECT_EQ(triangulation.num_rows(), 0u);
}

}  // namespace
}  // namespace delone::triangulation
