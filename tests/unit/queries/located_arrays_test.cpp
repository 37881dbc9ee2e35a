// SPDX-License-Identifier: BSD-3-Clause
// The answers of PointLocator as arrays against those that it calls back with.
#include "degenerate.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/point_locator.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace delone::queries {
namespace {

struct Arrays {
  explicit Arrays(std::size_t count, std::size_t width)
      : kinds(count), cells(count), barycentric(count * width), distances(count) {}
  LocatedArrays spans() { return {kinds, cells, barycentric, distances}; }
  std::vector<Location::Kind> kinds;
  std::vector<SignedIndex> cells;
  std::vector<double> barycentric, distances;
};

void expect_as_called_back(const Delaunay<>& t, const std::vector<double>& queries, double tolerance) {
  const PointLocator locator(t);
  const CellNumbers numbers(t.complex());
  const std::size_t count = queries.size() / static_cast<std::size_t>(t.dimension()),
                    width = static_cast<std::size_t>(t.affine_dimension() + 1);
  Arrays expected(count, width), found(count, width);
  std::vector<std::vector<SignedIndex>> faces(count);
  locator.locate(queries, {.tolerance = tolerance}, [&](std::size_t i, const LocatedPoint& where) {
    expected.kinds[i] = where.kind;
    expected.cells[i] = where.barycentric.empty() ? -1 : numbers.row(where.cell);
    expected.distances[i] = where.distance;
    for (std::size_t j = 0; j < width; ++j) {
      expected.barycentric[i * width + j] = where.barycentric.empty() ? std::nan("") : where.barycentric[j];
      if (!where.barycentric.empty() && where.barycentric[j] > 0)
        faces[i].push_back(
            static_cast<SignedIndex>(t.row_of(t.complex().vertex(where.cell, static_cast<int>(j)))));
    }
    std::sort(faces[i].begin(), faces[i].end());
  });
  for (const unsigned threads : {1u, 3u}) {
    locator.locate(queries, {.tolerance = tolerance}, numbers, found.spans(), {.threads = threads});
    EXPECT_EQ(found.kinds, expected.kinds);
    EXPECT_EQ(found.cells, expected.cells);
    EXPECT_EQ(found.distances, expected.distances);
    for (std::size_t i = 0; i < found.barycentric.size(); ++i) {
      const double a = found.barycentric[i], b = expected.barycentric[i];
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << i;
    }
    const LocatedPoints points =
        locator.locate(queries, {.tolerance = tolerance}, numbers, {.threads = threads});
    EXPECT_EQ(points.kinds, expected.kinds);
    EXPECT_EQ(points.cells, expected.cells);
    ASSERT_EQ(points.face_offsets.size(), count + 1);
    ASSERT_EQ(points.face_offsets.back(), static_cast<std::int64_t>(points.face_rows.size()));
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_EQ(std::vector<SignedIndex>(points.face_rows.begin() + points.face_offsets[i],
                                         points.face_rows.begin() + points.face_offsets[i + 1]),
                faces[i])
          << i;
  }
}

TEST(LocatedArrays, AreThoseOfTheCallback) {
  for (const int d : {1, 2, 3}) {
    const Delaunay<> t(test::small_integers(d, 60, -6, 6, 1).points, d);
    std::vector<double> queries = test::small_integers(d, 300, -8, 8, 2).points;
    for (std::size_t i = 0; i < queries.size(); i += 5) queries[i] += 0.25;
    expect_as_called_back(t, queries, 0);
    expect_as_called_back(t, queries, 0.5);
    expect_as_called_back(t, {}, 0);
  }
  expect_as_called_back(Delaunay<>(2), {1, 1, 2, 3}, 0);
  expect_as_called_back(Delaunay<>(std::vector<double>{1, 1}, 2), {1, 1, 2, 3}, 0);
}

TEST(LocatedArrays, OnlyWhatIsWanted) {
  const Delaunay<> t(std::vector<double>{0, 0, 4, 0, 0, 4}, 2);
  const std::vector<double> queries{1, 1, 5, 5};
  const PointLocator locator(t);
  std::vector<SignedIndex> cells(2, 7);
  locator.locate(queries, {}, CellNumbers(t.complex()), {.cells = cells});
  EXPECT_EQ(cells, (std::vector<SignedIndex>{0, -1}));
  std::vector<double> wrong(5);
  EXPECT_THROW(locator.locate(queries, {}, CellNumbers(t.complex()), {.barycentric = wrong}), Error);
  const std::vector<double> half{1, 1, 5};
  EXPECT_THROW(locator.locate(half, {}, CellNumbers(t.complex()), LocatedArrays{}), Error);
  EXPECT_THROW(locator.locate(half, {}, CellNumbers(t.complex())), Error);
}

}  // namespace
}  // namespace delone::queries
