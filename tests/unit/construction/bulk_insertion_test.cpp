// SPDX-License-Identifier: BSD-3-Clause
// Batches: duplicates within one and across several, rows that raise the dimension late, hidden points. Ids
// have no gaps, and the result is that of one batch.
#include <delone/convex_hull.hpp>
#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/lower_hull.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <set>
#include <span>
#include <vector>

namespace delone {
namespace {

using Coordinates = std::vector<double>;

std::span<const double> row_of(const Coordinates& rows, std::size_t row, std::size_t width) {
  return std::span(rows).subspan(row * width, width);
}

/// Expects that the vertices are 1, 2, … without gaps, each at the points of its rows.
void expect_consistent(const Delaunay<>& triangulation, const Coordinates& rows) {
  const auto d = static_cast<std::size_t>(triangulation.dimension()), n = rows.size() / d;
  ASSERT_EQ(triangulation.num_rows(), n);
  std::set<Index> ids;
  std::set<Coordinates> distinct;
  for (std::size_t row = 0; row < n; ++row) {
    const VertexId v = triangulation.vertex_at(row);
    const auto expected = row_of(rows, row, d), point = triangulation.point(v);
    EXPECT_TRUE(std::equal(point.begin(), point.end(), expected.begin(), expected.end())) << row;
    EXPECT_EQ(triangulation.vertex_at(triangulation.row_of(v)), v);
    ids.insert(index(v));
    distinct.emplace(expected.begin(), expected.end());
  }
  EXPECT_EQ(ids.size(), distinct.size());
  EXPECT_EQ(*ids.begin(), 1u);
  EXPECT_EQ(*ids.rbegin(), ids.size());
  EXPECT_EQ(triangulation.num_vertices(), ids.size());
  EXPECT_EQ(triangulation.num_duplicates(), n - ids.size());
  EXPECT_EQ(triangulation.hash().hex(), Delaunay<>(rows, triangulation.dimension()).hash().hex());
}

TEST(BatchInsertion, DuplicatesInOneBatchAndInALaterOne) {
  const Coordinates first{0, 0, 0, 0, 4, 0, 0, 4, 4, 0, 1, 1, 0, 0}, second{1, 1, 5, 5, 0, 4, 5, 5, 2, 3};
  for (const InsertionOrder order : {InsertionOrder::as_given, Options{}.order}) {
    Options options;
    options.order = order;
    Delaunay<> triangulation(2, options);
    triangulation.insert_range(first);
    expect_consistent(triangulation, first);
    EXPECT_EQ(triangulation.num_duplicates(), 3u);
    Coordinates all = first;
    all.insert(all.end(), second.begin(), second.end());
    triangulation.insert_range(second);
    expect_consistent(triangulation, all);
    EXPECT_EQ(triangulation.num_duplicates(), 6u);
    EXPECT_EQ(triangulation.vertex_at(7), triangulation.vertex_at(5));
    EXPECT_EQ(triangulation.vertex_at(8), triangulation.vertex_at(10));
  }
}

TEST(BatchInsertion, EqualRowsAreOneVertexUntilAnotherComes) {
  Delaunay<> triangulation(2);
  triangulation.insert_range(Coordinates{3, 3, 3, 3});
  triangulation.insert_range(Coordinates{3, 3});
  EXPECT_EQ(triangulation.affine_dimension(), 0);
  EXPECT_EQ(triangulation.num_duplicates(), 2u);
  triangulation.insert_range(Coordinates{3, 3, 3, 3, 7, 3, 3, 3, 3, 9});
  EXPECT_EQ(triangulation.affine_dimension(), 2);
  expect_consistent(triangulation, {3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 7, 3, 3, 3, 3, 9});
}

TEST(BatchInsertion, RowsInTheMiddleOfABatchRaiseTheDimension) {
  const Coordinates line{0, 0, 0, 1, 0, 0, 2, 0, 0, 1, 0, 0};
  const Coordinates solid{3, 0, 0, 1, 0, 0, 1, 2, 0, 2, 2, 0, 1, 2, 0, 5, 0, 0, 1, 1, 4, 2, 1, 3, 0, 0, 0};
  Delaunay<> triangulation(3);
  triangulation.insert_range(line);
  EXPECT_EQ(triangulation.affine_dimension(), 1);
  triangulation.insert_range(solid);
  EXPECT_EQ(triangulation.affine_dimension(), 3);
  Coordinates all = line;
  all.insert(all.end(), solid.begin(), solid.end());
  expect_consistent(triangulation, all);
}

TEST(BatchInsertion, ManyBatchesGiveWhatOneGives) {
  const Coordinates rows = make_point_set("duplicates", 3, 400, 1);
  Delaunay<> triangulation(3);
  for (std::size_t first = 0, size = 1; first < rows.size(); first += 3 * size, size *= 2)
    triangulation.insert_range(
        Coordinates(rows.begin() + static_cast<std::ptrdiff_t>(first),
                    rows.begin() + static_cast<std::ptrdiff_t>(std::min(first + 3 * size, rows.size()))));
  expect_consistent(triangulation, rows);
}

// Batches of up to a 1024th of the vertices go in one by one.
TEST(BatchInsertion, SmallBatchesGiveWhatOneGives) {
  Coordinates rows = make_point_set("uniform", 2, 5000, 1);
  for (const double outside : {-3.0, 5.0, 1e200}) rows.insert(rows.end(), {outside, 0.5});
  for (std::size_t i = 0; i < 40; ++i) rows.push_back(rows[300 * (i / 2 % 7) + i % 2]);
  for (const double x : {0.25, 0.5, 0.25, 0.75, 0.5}) rows.insert(rows.end(), {x, 0.125});
  Delaunay<> triangulation(2);
  std::size_t done = 2 * 4900;
  triangulation.insert_range(std::span(rows).first(done));
  for (std::size_t size = 2; done < rows.size(); size = size % 8 + 2) {
    const std::size_t count = std::min(size, rows.size() - done);
    triangulation.insert_range(std::span(rows).subspan(done, count));
    done += count;
  }
  expect_consistent(triangulation, rows);
}

TEST(BatchInsertion, PointsOfLittleWeightAreHidden) {
  // A square, its center too light; a heavy twin of a corner hides that; the center again is hidden, too.
  const Coordinates square{0, 0, 4, 0, 4, 4, 0, 4, 2, 2}, later{0, 0, 2, 2, 4, 4, 4, 0};
  Regular<> regular(2);
  regular.insert_range(square, Coordinates{0, 0, 0, 0, -100});
  EXPECT_EQ(regular.hidden_rows(), std::vector<std::size_t>{4});
  EXPECT_EQ(regular.num_vertices(), 4u);
  regular.insert_range(later, Coordinates{1, -100, 0, -1});
  EXPECT_EQ(regular.num_rows(), 9u);
  EXPECT_EQ(regular.hidden_rows(), (std::vector<std::size_t>{0, 4, 6, 8}));
  EXPECT_EQ(regular.num_hidden(), 4u);
  EXPECT_EQ(regular.num_vertices(), 4u);
  EXPECT_EQ(regular.num_duplicates(), 1u);  // row 7 is row 2
  EXPECT_EQ(regular.vertex_at(7), regular.vertex_at(2));
  EXPECT_EQ(regular.weight(regular.vertex_at(5)), 1);
  Coordinates all = square;
  all.insert(all.end(), later.begin(), later.end());
  EXPECT_EQ(Regular<>(all, Coordinates{0, 0, 0, 0, -100, 1, -100, 0, -1}, 2).hash().hex(),
            regular.hash().hex());
}

TEST(BatchInsertion, InOnePlaceTheHeaviestIsTheVertex) {
  Regular<> regular(2);
  regular.insert_range(Coordinates{1, 1, 1, 1, 1, 1}, Coordinates{0, 5, 5});
  EXPECT_EQ(regular.num_vertices(), 1u);
  EXPECT_EQ(regular.hidden_rows(), std::vector<std::size_t>{0});
  EXPECT_EQ(regular.num_duplicates(), 1u);
  regular.insert_range(Coordinates{1, 1}, Coordinates{6});
  EXPECT_EQ(regular.hidden_rows(), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(regular.weight(regular.vertex_at(3)), 6);
}

/// The code of what an insertion throws.
Errc code_of_insertion(Delaunay<>& triangulation, const Coordinates& rows) {
  try {
    triangulation.insert_range(rows);
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "nothing was thrown";
  return Errc::cancelled;
}

TEST(BatchInsertion, AtALimitEverythingIsAsBeforeAndPointsCanStillBeInserted) {
  const Coordinates rows{0, 0, 4, 0, 0, 4, 4, 5, 1, 2}, more{9, 9, -3, 7, 2, 2};
  for (const Errc limit : {Errc::time_limit, Errc::out_of_memory}) {
    Options options;
    if (limit == Errc::time_limit)
      options.time_limit = 1e-9;
    else
      options.memory_limit = 1000;
    Delaunay<> triangulation(2, options);
    for (std::size_t row = 0; row < 4; ++row) triangulation.insert(row_of(rows, row, 2));
    EXPECT_EQ(code_of_insertion(triangulation, more), limit);
    expect_consistent(triangulation, Coordinates(rows.begin(), rows.begin() + 8));
    EXPECT_EQ(triangulation.locate(row_of(rows, 4, 2)).kind, Location::Kind::in_cell);
    triangulation.insert(row_of(rows, 4, 2));
    expect_consistent(triangulation, rows);
    EXPECT_EQ(code_of_insertion(triangulation, more), limit);
    expect_consistent(triangulation, rows);
  }
}

TEST(BatchInsertion, BadLimitsOfTimeAreErrorsAtOnce) {
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    Options options;
    options.time_limit = bad;
    EXPECT_THROW(Delaunay<>(2, options), Error);
    EXPECT_THROW(ConvexHull<>(2, options), Error);
    EXPECT_THROW(LowerHull<>(Coordinates{}, 2, HullSide::lower, options), Error);
  }
}

}  // namespace
}  // namespace delone
