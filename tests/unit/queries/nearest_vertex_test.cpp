// SPDX-License-Identifier: BSD-3-Clause
#include "degenerate.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/point_locator.hpp>
#include <delone/regular.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace delone {
namespace {

using ::testing::ElementsAre;
using Point2 = std::array<double, 2>;

Sign compare(std::vector<double> q, std::vector<double> a, std::vector<double> b, double weight_a = 0,
             double weight_b = 0) {
  const Sign sign = compare_distances(q, a, b, weight_a, weight_b);
  EXPECT_EQ(compare_distances(q, b, a, weight_b, weight_a), -sign);
  return sign;
}

TEST(CompareDistances, DecidesTies) {
  EXPECT_EQ(compare({0, 0}, {3, 4}, {5, 0}), Sign::zero);
  EXPECT_EQ(compare({0, 0}, {3, 4}, {std::nextafter(5, 6), 0}), Sign::negative);
  EXPECT_EQ(compare({0, 0}, {3, 4}, {std::nextafter(5, 4), 0}), Sign::positive);
  EXPECT_EQ(compare({0x1p-1074, 0}, {3, 4}, {5, 0}), Sign::positive);
  EXPECT_EQ(compare({-0x1p-1074, 0}, {3, 4}, {5, 0}), Sign::negative);
  EXPECT_EQ(compare({7}, {7}, {7}), Sign::zero);
  EXPECT_EQ(compare({1e16, 1}, {0, 0}, {0, 2}), Sign::zero);
}

TEST(CompareDistances, CountsWeights) {
  EXPECT_EQ(compare({0}, {3}, {2}, 5), Sign::zero);
  EXPECT_EQ(compare({0}, {3}, {2}, std::nextafter(5, 6)), Sign::negative);
  EXPECT_EQ(compare({0}, {3}, {2}, 0, -5), Sign::zero);
  EXPECT_EQ(compare({0}, {3}, {3}, 1, 2), Sign::positive);
  EXPECT_EQ(compare({0}, {0}, {0}, 1e308, -1e308), Sign::negative);
}

TEST(CompareDistances, AtTheEndsOfTheRange) {
  EXPECT_EQ(compare({0, 0}, {3e300, 4e300}, {3e300, 4e300}), Sign::zero);
  EXPECT_EQ(compare({0, 0}, {3 * 0x1p1000, 4 * 0x1p1000}, {5 * 0x1p1000, 0}), Sign::zero);
  EXPECT_EQ(compare({0, 0}, {3 * 0x1p-1070, 4 * 0x1p-1070}, {5 * 0x1p-1070, 0}), Sign::zero);
  EXPECT_EQ(compare({0, 0}, {1e300, 0}, {1e300, 1e-300}), Sign::negative);
  EXPECT_EQ(compare({-1.5e308}, {1.5e308}, {0}), Sign::positive);
  EXPECT_EQ(compare({0}, {1e-200}, {2e-200}), Sign::negative);
}

TEST(CompareDistances, RefusesWhatItCannotCompare) {
  const std::vector<double> one = {1}, two = {1, 2}, infinite = {INFINITY};
  EXPECT_THROW(compare_distances(one, two, one), Error);
  EXPECT_THROW(compare_distances(one, one, two), Error);
  EXPECT_THROW(compare_distances(infinite, one, one), Error);
  EXPECT_THROW(compare_distances(one, infinite, one), Error);
  EXPECT_THROW(compare_distances(one, one, infinite), Error);
  EXPECT_THROW(compare_distances(one, one, one, std::nan("")), Error);
  EXPECT_THROW(compare_distances(one, one, one, 0, INFINITY), Error);
}

/// The row of the nearest vertex of each query; −1 for none.
template <class T>
std::vector<int> nearest(const T& t, const std::vector<double>& queries) {
  std::vector<int> rows(queries.size() / static_cast<std::size_t>(t.dimension()), -2);
  PointLocator(t).nearest(queries, [&](std::size_t query, VertexId v) {
    rows[query] = v == invalid_vertex ? -1 : static_cast<int>(t.row_of(v));
  });
  return rows;
}

// Rows of the lattice {0, 1, 2}²: x + 3y.
TEST(NearestVertex, OfSeveralIsTheFirstRow) {
  std::vector<Point2> points;
  for (const double y : {0, 1, 2})
    for (const double x : {0, 1, 2}) points.push_back({x, y});
  const Delaunay<2> t(points);
  EXPECT_THAT(nearest(t, {0.5, 0.5, 1.5, 1.5, 1.5, 1, 1, 1, 9, 9, 9, 1.5, -7, 0.5}),
              ElementsAre(0, 4, 4, 4, 8, 5, 0));
  const double nudge = std::nextafter(1.5, 2);
  EXPECT_THAT(nearest(t, {nudge, 1.5, 1.5, nudge, nudge, nudge, 1.5, std::nextafter(1.5, 1)}),
              ElementsAre(5, 7, 8, 4));
  // The same in the opposite order: other rows come first.
  const Delaunay<2> reversed(std::vector<Point2>(points.rbegin(), points.rend()));
  EXPECT_THAT(nearest(reversed, {0.5, 0.5, 1.5, 1.5}), ElementsAre(4, 0));
}

// 12 points on one circle around the query, and duplicates of them.
TEST(NearestVertex, CollectsTiesAroundACircle) {
  std::vector<Point2> points;
  for (const Point2 p : {Point2{3, 4}, {4, 3}, {5, 0}, {0, 5}})
    for (const double sx : {-1, 1})
      for (const double sy : {-1, 1}) points.push_back({sx * p[0], sy * p[1]});
  for (std::size_t shift = 0; shift < points.size(); ++shift) {
    EXPECT_THAT(nearest(Delaunay<2>(points), {0, 0, 0.125, 0}).front(), 0);
    std::rotate(points.begin(), points.begin() + 1, points.end());
  }
}

TEST(NearestVertex, OfFlatInput) {
  const Delaunay<2> line(std::vector<Point2>{{0, 0}, {4, 4}, {1, 1}, {2, 2}});
  EXPECT_THAT(nearest(line, {1, 2, 3, -3, 9, 9, 0.5, 0.5, 2.5, 2.5, 3, 3}), ElementsAre(2, 0, 1, 0, 3, 1));
  EXPECT_THAT(nearest(Delaunay<2>(std::vector<Point2>{{3, 3}, {3, 3}}), {8, 8}), ElementsAre(0));
  EXPECT_THAT(nearest(Delaunay<2>(), {8, 8}), ElementsAre(-1));
  const Delaunay<1> numbers(std::vector<std::array<double, 1>>{{5}, {1}, {3}});
  EXPECT_THAT(nearest(numbers, {2, 4, -1, 1e300, std::nextafter(2, 3)}), ElementsAre(1, 0, 1, 0, 2));
}

// The heavier site wins beyond the other's position.
TEST(NearestVertex, OfWeightedPointsHasLeastPower) {
  const Regular<1> t(std::vector<std::array<double, 1>>{{0}, {4}}, std::vector<double>{0, 24});
  EXPECT_THAT(nearest(t, {-1, std::nextafter(-1, -2), 0}), ElementsAre(0, 0, 1));
}

TEST(PointLocatorEdges, AreTheNeighborsOfEachVertex) {
  const Delaunay<2> t(std::vector<Point2>{{0, 0}, {4, 0}, {0, 4}, {1, 1}});
  const PointLocator locator(t);
  const PointLocator::Edges& edges = locator.edges();
  EXPECT_EQ(&edges, &locator.edges());
  EXPECT_EQ(edges.offsets.size(), 6u);
  EXPECT_EQ(edges.vertices.size(), 12u);
  for (std::size_t v = 1; v <= 4; ++v) {
    std::set<Index> found;
    for (std::size_t e = edges.offsets[v]; e < edges.offsets[v + 1]; ++e)
      found.insert(index(edges.vertices[e]));
    std::set<Index> expected = {1, 2, 3, 4};
    expected.erase(static_cast<Index>(v));
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace delone
