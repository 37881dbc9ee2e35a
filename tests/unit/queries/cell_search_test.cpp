// SPDX-License-Identifier: BSD-3-Clause
// Cells of any kind against all of their orientations, one by one, and against PointLocator.
#include <delone/cell_search.hpp>

#include "degenerate.hpp"
#include "error_code.hpp"

#include <delone/delaunay.hpp>
#include <delone/predicates.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

namespace delone::queries {
namespace {

using test::code_of;
using ::testing::ElementsAre;
using Cells = std::vector<SignedIndex>;
using Coordinates = std::vector<double>;

PointsView view(const Coordinates& points, int d) { return {points, d}; }

std::vector<Cells> found_by(const CellSearch& search, const Coordinates& queries, int d, double radius = 0,
                            unsigned threads = 1) {
  std::vector<Cells> found(queries.size() / static_cast<std::size_t>(d));
  search.find(queries, radius,
              [&](std::size_t query, std::span<const SignedIndex> cells) {
                found[query].assign(cells.begin(), cells.end());
              },
              {.threads = threads});
  return found;
}

/// Whether no vertex of the cell can be replaced by q with the opposite orientation.
bool contains(const Coordinates& points, std::span<const SignedIndex> cell, std::span<const double> q,
              int d) {
  const auto width = static_cast<std::size_t>(d);
  Coordinates corners;
  for (const SignedIndex row : cell)
    corners.insert(corners.end(), points.begin() + row * d, points.begin() + (row + 1) * d);
  const Sign own = orientation(corners, d);
  if (own == Sign::zero) return false;
  for (std::size_t i = 0; i <= width; ++i) {
    Coordinates replaced = corners;
    std::copy(q.begin(), q.end(), replaced.begin() + static_cast<std::ptrdiff_t>(i * width));
    const Sign sign = orientation(replaced, d);
    if (sign != Sign::zero && sign != own) return false;
  }
  return true;
}

/// Random cells of degenerate sets: they overlap, many are flat, and both orientations occur.
TEST(CellSearch, FindsWhatAllOrientationsSay) {
  for (int d = 1; d <= 4; ++d)
    for (const test::PointSet& set : test::degenerate_sets(d, 24, 7)) {
      test::Random random(static_cast<std::uint64_t>(d));
      const auto width = static_cast<std::size_t>(d);
      const int n = static_cast<int>(set.points.size() / width);
      if (n == 0) continue;
      Cells cells;
      for (int i = 0; i < 60 * (d + 1); ++i) cells.push_back(random.integer(0, n - 1));
      const CellSearch search(view(set.points, d), cells);
      Coordinates queries = set.points;
      for (std::size_t i = 0; i + width < set.points.size(); ++i)  // between two points
        queries.push_back(set.points[i] / 2 + set.points[i + width] / 2);
      queries.resize(queries.size() / width * width);
      const std::vector<Cells> found = found_by(search, queries, d);
      EXPECT_EQ(found, found_by(search, queries, d, 0, 4));
      for (std::size_t q = 0; q < found.size(); ++q) {
        Cells expected;
        for (std::size_t c = 0; c * (width + 1) < cells.size(); ++c)
          if (contains(set.points, std::span(cells).subspan(c * (width + 1), width + 1),
                       std::span(queries).subspan(q * width, width), d))
            expected.push_back(static_cast<SignedIndex>(c));
        ASSERT_EQ(found[q], expected) << set.name << ", dimension " << d << ", query " << q;
      }
    }
}

TEST(CellSearch, LocatesAsTheTriangulationDoes) {
  for (int d = 2; d <= 3; ++d) {
    const auto width = static_cast<std::size_t>(d);
    const Coordinates points = make_point_set("uniform", d, 300, 1),
                      queries = make_point_set("uniform", d, 500, 2);
    Delaunay<> triangulation(view(points, d));
    triangulation.sort_cells();
    const ComplexData data = triangulation.to_data();
    const CellSearch search(view(data.points, d), data.cells);
    EXPECT_TRUE(search.flat_cells().empty());
    EXPECT_EQ(search.num_cells(), data.num_cells());
    std::vector<Location::Kind> kinds(500), kinds_there(500);
    Cells cells(500), cells_there(500);
    Coordinates weights(500 * (width + 1)), weights_there(weights.size()), distances(500, 7);
    search.locate(queries, {kinds, cells, weights, distances}, {.threads = 2});
    const CellNumbers numbers(triangulation.complex());
    PointLocator(triangulation).locate(queries, {}, numbers, {kinds_there, cells_there, weights_there});
    EXPECT_EQ(cells, cells_there);
    EXPECT_EQ(kinds, kinds_there);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (std::isnan(weights_there[i]))
        EXPECT_TRUE(std::isnan(weights[i]));
      else
        EXPECT_NEAR(weights[i], weights_there[i], 0x1p-36);
    }
    EXPECT_EQ(distances, Coordinates(500, 0.0));
    // Coordinates are on vertices, of the first cell that has them.
    search.locate(points, {std::span(kinds).first(300), std::span(cells).first(300)});
    for (std::size_t i = 0; i < 300; ++i) {
      EXPECT_EQ(kinds[i], Location::Kind::on_vertex);
      const auto first = std::find(data.cells.begin(), data.cells.end(), static_cast<SignedIndex>(i));
      EXPECT_EQ(cells[i], (first - data.cells.begin()) / (d + 1));
    }
  }
}

TEST(CellSearch, ARadiusReachesBeyondCells) {
  const Coordinates points{0, 0, 4, 0, 0, 4, 9, 9}, queries{-3, -4, 3, 3, 1, 1, 4, -2};
  const Cells cells{0, 1, 2, 1, 0, 2, 0, 1, 1};
  const CellSearch search(view(points, 2), cells);
  EXPECT_THAT(search.flat_cells(), ElementsAre(2));
  EXPECT_THAT(found_by(search, queries, 2, 5),
              ElementsAre(Cells{0, 1}, Cells{0, 1}, Cells{0, 1}, Cells{0, 1}));
  EXPECT_THAT(found_by(search, queries, 2, 2), ElementsAre(Cells{}, Cells{0, 1}, Cells{0, 1}, Cells{0, 1}));
  EXPECT_THAT(found_by(search, queries, 2, 1.4), ElementsAre(Cells{}, Cells{}, Cells{0, 1}, Cells{}));
  EXPECT_THAT(found_by(search, queries, 2), ElementsAre(Cells{}, Cells{}, Cells{0, 1}, Cells{}));
}

TEST(CellSearch, LargeAndSmallNumbers) {
  for (const double scale : {1e300, 1.0, 1e-300, 5e-324}) {
    const Coordinates points{0, 0, 2 * scale, 0, 0, 2 * scale},
        queries{scale, scale, 2 * scale, 2 * scale, 0, scale};
    EXPECT_THAT(found_by(CellSearch(view(points, 2), Cells{0, 1, 2}), queries, 2),
                ElementsAre(Cells{0}, Cells{}, Cells{0}))
        << scale;
  }
}

TEST(CellSearch, BadInputIsAnError) {
  const Coordinates points{0, 0, 1, 0, 0, 1, 0, std::numeric_limits<double>::quiet_NaN()};
  const auto search = [&](const Cells& cells) { return [&, cells] { CellSearch(view(points, 2), cells); }; };
  EXPECT_EQ(code_of(search({0, 1})), Errc::invalid_argument);
  EXPECT_EQ(code_of(search({0, 1, 4})), Errc::invalid_argument);
  EXPECT_EQ(code_of(search({0, 1, -1})), Errc::invalid_argument);
  EXPECT_EQ(code_of(search({0, 1, 3})), Errc::not_finite);
  const Cells cells{0, 1, 2};
  const CellSearch good(view(points, 2), cells);
  EXPECT_EQ(code_of([&] { found_by(good, {0, 0, 1}, 2); }), Errc::bad_dimension);
  EXPECT_EQ(code_of([&] { found_by(good, {0, points.back()}, 2); }), Errc::not_finite);
  EXPECT_EQ(code_of([&] { found_by(good, {0, 0}, 2, -1); }), Errc::invalid_argument);
  Cells wrong(2);
  EXPECT_EQ(code_of([&] { good.locate(Coordinates{0, 0}, {.cells = wrong}); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] {
              good.find(Coordinates{0, 0}, 0, [](auto, auto) {}, {.progress = [](double) { return false; }});
            }),
            Errc::cancelled);
  const Cells none;
  EXPECT_THAT(found_by(CellSearch(view(points, 2), none), {0, 0}, 2), ElementsAre(Cells{}));
}

}  // namespace
}  // namespace delone::queries
