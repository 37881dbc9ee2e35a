// SPDX-License-Identifier: BSD-3-Clause
#include "degenerate.hpp"

#include "scale.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/point_locator.hpp>
#include <delone/regular.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace delone::queries {
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

/// The rows of the k nearest vertices of each query.
template <class T>
std::vector<std::vector<std::size_t>> nearest(const T& t, const std::vector<double>& queries, std::size_t k) {
  std::vector<std::vector<std::size_t>> rows(queries.size() / static_cast<std::size_t>(t.dimension()));
  PointLocator(t).nearest(queries, k, [&](std::size_t query, std::span<const VertexId> found) {
    for (const VertexId v : found) rows[query].push_back(t.row_of(v));
  });
  return rows;
}

/// The same by sorting all vertices, for every k up to `most`.
template <class T, class Weight>
void expect_sorted(const T& t, const std::vector<double>& queries, std::size_t most, Weight weight) {
  const auto d = static_cast<std::size_t>(t.dimension());
  const auto vertices = t.complex().finite_vertices();
  const auto found = nearest(t, queries, most);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::span<const double> q = std::span(queries).subspan(i * d, d);
    std::vector<VertexId> sorted = vertices;
    std::sort(sorted.begin(), sorted.end(), [&](VertexId a, VertexId b) {
      const Sign sign =
          compare_distances(q, static_cast<const Triangulation&>(t).point(a),
                            static_cast<const Triangulation&>(t).point(b), weight(a), weight(b));
      return sign == Sign::zero ? t.row_of(a) < t.row_of(b) : sign == Sign::negative;
    });
    sorted.resize(std::min(most, sorted.size()));
    std::vector<std::size_t> rows;
    for (const VertexId v : sorted) rows.push_back(t.row_of(v));
    EXPECT_EQ(found[i], rows) << "query " << i;
    const std::size_t fewer = sorted.size() / 2;
    if (fewer == 0) continue;
    rows.resize(fewer);
    EXPECT_EQ(nearest(t, {q.begin(), q.end()}, fewer).front(), rows);
  }
}

std::vector<double> queries_around(const test::PointSet& set, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<double> queries(set.points.begin(),
                              set.points.begin() + 3 * static_cast<std::ptrdiff_t>(set.dimension));
  for (int i = 0; i < 12 * set.dimension; ++i) queries.push_back(random.integer(-2, 10) / 2.0);
  return queries;
}

TEST(NearestVertices, AreThoseOfASort) {
  for (int d = 1; d <= static_cast<int>(test::scaled_size(5, 3)); ++d)
    for (const test::PointSet& set :
         {test::lattice(d, d > 3 ? 2 : 4), test::small_integers(d, 60, 0, 3, 7u),
          test::nudged(test::lattice(d, 3), 5), test::cospherical(d, d == 1 ? 4 : 5),
          test::embedded(test::lattice(std::max(d - 1, 1), 3), d, true, 3)}) {
      SCOPED_TRACE(set.name + " in dimension " + std::to_string(d));
      for (const std::uint64_t seed : {1u, 2u}) {
        const test::PointSet shuffled = test::permuted(set, seed);
        if (shuffled.size() < 3) continue;
        expect_sorted(Delaunay<>(shuffled.points, d), queries_around(shuffled, seed), 9,
                      [](VertexId) { return 0.0; });
      }
    }
}

TEST(NearestVertices, AreThoseOfLeastPower) {
  for (int d = 1; d <= 4; ++d)
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const test::PointSet set = test::permuted(test::lattice(d, d > 2 ? 3 : 5), seed);
      test::Random random(seed);
      std::vector<double> weights(set.size());
      for (double& w : weights) w = random.integer(-1, 2);
      const Regular<> t(set.points, weights, d);
      expect_sorted(t, queries_around(set, seed), 20, [&](VertexId v) { return t.weight(v); });
    }
}

TEST(NearestVertices, AreAllIfThereAreFewer) {
  EXPECT_THAT(nearest(Delaunay<2>(std::vector<Point2>{{0, 0}, {1, 0}, {0, 0}, {0, 2}}), {2, 0}, 7).front(),
              ElementsAre(1, 0, 3));
  EXPECT_THAT(nearest(Delaunay<2>(std::vector<Point2>{{3, 3}, {3, 3}}), {8, 8}, 2).front(), ElementsAre(0));
  EXPECT_THAT(nearest(Delaunay<2>(), {8, 8}, 2).front(), ElementsAre());
  EXPECT_THROW(nearest(Delaunay<2>(), {8, 8}, 0), Error);
}

// All 12 are nearest; the first rows are not joined by edges.
TEST(NearestVertices, OfTiesAreTheFirstRows) {
  std::vector<Point2> points;
  for (const Point2 p : {Point2{3, 4}, {4, 3}, {5, 0}, {0, 5}})
    for (const double sx : {-1, 1})
      for (const double sy : {-1, 1}) points.push_back({sx * p[0], sy * p[1]});
  points.push_back({9, 9});
  EXPECT_THAT(nearest(Delaunay<2>(points), {0, 0}, 4).front(), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(nearest(Delaunay<2>(points), {0, 0}, 13).front(),
              ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 13, 16));
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
}  // namespace delone::queries
