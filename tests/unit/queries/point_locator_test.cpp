// SPDX-License-Identifier: BSD-3-Clause
// Where queries lie in small triangulations: the table of minors, the plain walk, and what passes from one to
// the other.
#include "degenerate.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/point_locator.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace delone::queries {
namespace {

using ::testing::ElementsAre;
using Kind = Location::Kind;
using Point2 = std::array<double, 2>;

template <class T>
std::vector<Kind> kinds(const T& t, const std::vector<double>& queries) {
  std::vector<Kind> result(queries.size() / static_cast<std::size_t>(t.dimension()));
  PointLocator(t).locate(queries,
                         [&](std::size_t query, const LocatedPoint& where) { result[query] = where.kind; });
  return result;
}

/// Each query is the sum of the vertices of its cell times the coordinates, which are positive on its face
/// and 0 elsewhere.
template <class T>
void expect_barycentric(const T& t, const std::vector<double>& queries, double tolerance) {
  const auto d = static_cast<std::size_t>(t.dimension());
  const Complex complex = t.complex();
  std::size_t visits = 0;
  PointLocator(t).locate(queries, [&](std::size_t query, const LocatedPoint& where) {
    ++visits;
    ASSERT_EQ(where.barycentric.size(), static_cast<std::size_t>(complex.affine_dimension()) + 1);
    std::vector<double> sum(d, 0.0);
    int positive = 0;
    for (int i = 0; i <= complex.affine_dimension(); ++i) {
      const double weight = where.barycentric[static_cast<std::size_t>(i)];
      EXPECT_GE(weight, 0);
      positive += weight > 0 ? 1 : 0;
      const auto p = t.point(complex.vertex(where.cell, i));
      for (std::size_t j = 0; j < d; ++j) sum[j] += weight * p[j];
    }
    for (std::size_t j = 0; j < d; ++j) EXPECT_NEAR(sum[j], queries[query * d + j], tolerance);
    EXPECT_EQ(positive, where.kind == Kind::on_vertex ? 1
                        : where.kind == Kind::on_face ? std::min(positive, complex.affine_dimension())
                                                      : complex.affine_dimension() + 1);
  });
  EXPECT_EQ(visits, queries.size() / d);
}

TEST(PointLocator, TellsKinds) {
  const Delaunay<2> t(std::vector<Point2>{{0, 0}, {4, 0}, {0, 4}, {1, 1}});
  EXPECT_THAT(kinds(t, {1, 0.5, 1, 1, 2, 0, 0.5, 0.5, 2, 2, 3, 3, -1, 0}),
              ElementsAre(Kind::in_cell, Kind::on_vertex, Kind::on_face, Kind::on_face, Kind::on_face,
                          Kind::outside_hull, Kind::outside_hull));
  const double next = std::nextafter(2, 3), previous = std::nextafter(2, 1);
  EXPECT_THAT(
      kinds(t, {next, 2, previous, 2, 1, std::nextafter(1, 2), 2, 0x1p-1074, 2, -0x1p-1074}),
      ElementsAre(Kind::outside_hull, Kind::in_cell, Kind::in_cell, Kind::in_cell, Kind::outside_hull));
}

// On every lattice point, edge and cell of a lattice, in dimensions with and without a table.
TEST(PointLocator, GivesBarycentricCoordinates) {
  const auto halves = [](int d) {
    std::vector<double> queries = test::lattice(d, d <= 3 ? 5 : 3).points;
    for (double& x : queries) x /= d <= 3 ? 2 : 1;
    return queries;
  };
  expect_barycentric(Delaunay<1>(std::vector<std::array<double, 1>>{{0}, {2}, {1}}), halves(1), 0);
  std::vector<Point2> square;
  for (const double x : {0, 1, 2})
    for (const double y : {0, 1, 2}) square.push_back({x, y});
  expect_barycentric(Delaunay<2>(square), halves(2), 0);
  std::vector<std::array<double, 3>> cube;
  for (const double x : {0, 1, 2})
    for (const double y : {0, 1, 2})
      for (const double z : {0, 1, 2}) cube.push_back({x, y, z});
  expect_barycentric(Delaunay<3>(cube), halves(3), 0);
  std::vector<std::array<double, 7>> simplex(8);
  for (std::size_t i = 0; i < 7; ++i) simplex[i][i] = 8;
  expect_barycentric(Delaunay<7>(simplex), {1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 0, 0, 0}, 1e-14);
}

TEST(PointLocator, OfFlatInput) {
  const Delaunay<2> line(std::vector<Point2>{{0, 0}, {3, 3}, {1, 1}});
  EXPECT_THAT(kinds(line, {2, 2, 1, 1, 4, 4, 2, 2.5, 2, std::nextafter(2, 3)}),
              ElementsAre(Kind::in_cell, Kind::on_vertex, Kind::outside_hull, Kind::outside_affine_hull,
                          Kind::outside_affine_hull));
  expect_barycentric(line, {2, 2, 1, 1, 0.1, 0.1}, 1e-15);
  EXPECT_THAT(kinds(Delaunay<2>(), {0, 0}), ElementsAre(Kind::outside_affine_hull));
}

// Numbers beyond the range of the table go to the plain walk, in the middle of a batch.
TEST(PointLocator, AtTheEndsOfTheRange) {
  const Delaunay<2> t(std::vector<Point2>{{0, 0}, {1, 0}, {0, 1}, {1e200, 1e200}, {-1e-200, -1e-200}});
  EXPECT_THAT(kinds(t, {0.25, 0.25, 1e199, 1e199, 1e200, 1e200, 1e201, 1e201, -5e-201, -5e-201}),
              ElementsAre(Kind::in_cell, Kind::in_cell, Kind::on_vertex, Kind::outside_hull, Kind::on_face));
}

// A cell so thin that the bound of the table says nothing of its coordinates: the system is solved.
TEST(PointLocator, OfAThinCell) {
  const double thin = 0x1p-49;
  const Delaunay<2> t(std::vector<Point2>{{1, 1}, {2, 2}, {1, 1 + thin}});
  PointLocator(t).locate(
      std::vector<double>{1.25, 1.25 + thin / 4}, [&](std::size_t, const LocatedPoint& where) {
        EXPECT_EQ(where.kind, Kind::in_cell);
        for (int i = 0; i < 3; ++i) {
          const auto row = t.row_of(t.complex().vertex(where.cell, i));
          EXPECT_NEAR(where.barycentric[static_cast<std::size_t>(i)], row == 0 ? 0.5 : 0.25, 1e-10);
        }
      });
}

TEST(PointLocator, VisitsEveryQueryOnceInAnyOrder) {
  const Delaunay<2> t(std::vector<Point2>{{0, 0}, {4, 0}, {0, 4}, {4, 4}});
  const test::PointSet queries = test::small_integers(2, 1000, -1, 5, 1);
  std::vector<int> visits(1000, 0);
  PointLocator(t).locate(queries.points, [&](std::size_t query, const LocatedPoint&) { ++visits[query]; });
  EXPECT_EQ(visits, std::vector<int>(1000, 1));
}

/// Where a query lies: the kind, and for queries inside the rows of the face and their weights.
struct Seen {
  Kind kind = Kind::outside_affine_hull;
  std::vector<std::pair<std::size_t, double>> weights;  // by row
};

template <class T>
std::vector<Seen> seen(const T& t, std::span<const double> queries, const LocateOptions& options = {}) {
  std::vector<Seen> result(queries.size() / static_cast<std::size_t>(t.dimension()));
  PointLocator(t).locate(queries, options, [&](std::size_t query, const LocatedPoint& where) {
    result[query].kind = where.kind;
    for (std::size_t i = 0; i < where.barycentric.size(); ++i)
      if (where.barycentric[i] > 0)
        result[query].weights.emplace_back(t.row_of(t.complex().vertex(where.cell, static_cast<int>(i))),
                                           where.barycentric[i]);
    std::sort(result[query].weights.begin(), result[query].weights.end());
  });
  return result;
}

/// Many queries at once get the answers that each gets alone; without coordinates, their faces.
void expect_same_alone(const std::vector<double>& points, int d, const std::vector<double>& queries) {
  const Delaunay<> t(points, d);
  const std::vector<Seen> together = seen(t, queries), faces = seen(t, queries, {.coordinates = false});
  const auto width = static_cast<std::size_t>(d);
  for (std::size_t i = 0; i < together.size(); ++i) {
    const Seen alone = seen(t, std::span(queries).subspan(i * width, width))[0];
    ASSERT_EQ(together[i].kind, alone.kind) << d << "D, query " << i;
    ASSERT_EQ(faces[i].kind, alone.kind);
    ASSERT_EQ(together[i].weights.size(), alone.weights.size());
    ASSERT_EQ(faces[i].weights.size(), alone.weights.size());
    for (std::size_t j = 0; j < alone.weights.size(); ++j) {
      EXPECT_EQ(together[i].weights[j].first, alone.weights[j].first);
      EXPECT_EQ(faces[i].weights[j].first, alone.weights[j].first);
      EXPECT_NEAR(together[i].weights[j].second, alone.weights[j].second, 0x1p-35);
    }
  }
}

TEST(PointLocator, ManyQueriesAtOnceGetTheSameAnswers) {
  for (int d = 1; d <= 7; ++d) {
    const std::size_t n = d <= 3 ? 60 : d <= 5 ? 30 : 12;
    // The face that contains a query is the same in all its cells.
    expect_same_alone(test::small_integers(d, n, 0, 4, 1).points, d,
                      test::small_integers(d, 300, -1, 5, 2).points);
    test::Random random(static_cast<std::uint64_t>(d));
    std::vector<double> points, queries;
    for (std::size_t i = 0; i < n * static_cast<std::size_t>(d); ++i) points.push_back(random.real());
    for (int i = 0; i < 200 * d; ++i) queries.push_back(random.real());
    queries.insert(queries.end(), points.begin(), points.end());
    expect_same_alone(points, d, queries);
    // Beyond the range of the table: some queries, then all of them.
    for (std::size_t i = 0; i < queries.size(); i += 7) queries[i] *= i % 2 == 0 ? 1e200 : 1e-200;
    expect_same_alone(points, d, queries);
    for (double& x : points) x *= 1e-250;
    for (double& x : queries) x *= 1e-250;
    expect_same_alone(points, d, queries);
  }
}

TEST(PointLocator, PassesExceptionsOn) {
  const Delaunay<2> t(std::vector<Point2>{{0, 0}, {4, 0}, {0, 4}});
  const PointLocator locator(t);
  const auto ignore = [](std::size_t, const LocatedPoint&) {};
  EXPECT_THROW(locator.locate(std::vector<double>{1, 2, 3}, ignore), Error);
  try {
    locator.locate(std::vector<double>{1, 2, 3, std::nan(""), 1, INFINITY}, ignore);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Errc::not_finite);
    EXPECT_THAT(e.rows(), ElementsAre(1, 2));
  }
  EXPECT_THROW(locator.locate(std::vector<double>{1, 2},
                              [](std::size_t, const LocatedPoint&) { throw std::runtime_error("enough"); }),
               std::runtime_error);
}

}  // namespace
}  // namespace delone::queries
