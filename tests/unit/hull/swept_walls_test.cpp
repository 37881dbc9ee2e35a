// SPDX-License-Identifier: BSD-3-Clause
// Many points on walls: the hull is the one that insertions make.
#include "hull/swept_walls.hpp"

#include "degenerate.hpp"
#include "scale.hpp"

#include <delone/check.hpp>
#include <delone/convex_hull.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <string>

namespace delone::hull {
namespace {

using Coordinates = std::vector<double>;

/// `inside` points in the cube [0, 1]^d and `on_walls` on those of its facets x_j = 0 or 1 with j < `axes`.
Coordinates cube(int dimension, std::size_t inside, std::size_t on_walls, std::size_t axes,
                 std::uint64_t seed) {
  const auto d = static_cast<std::size_t>(dimension);
  Coordinates rows = make_point_set("uniform", dimension, inside + on_walls, seed);
  std::mt19937_64 random(seed);
  for (std::size_t i = inside; i < inside + on_walls; ++i)
    rows[i * d + random() % axes] = static_cast<double>(random() % 2);
  return rows;
}

Coordinates corners_of_cube(int dimension) {
  Coordinates corners;
  for (int corner = 0; corner < 1 << dimension; ++corner)
    for (int j = 0; j < dimension; ++j) corners.push_back(corner >> j & 1);
  return corners;
}

TEST(SweptWalls, KnowWhatIsInside) {
  HullState hull(3);
  hull.insert_range(corners_of_cube(3), {});
  const Coordinates rows = cube(3, 100, 400, 3, 1);
  std::vector<Index> sites;
  for (std::size_t i = 0; i < 500; ++i) sites.push_back(hull.add_without_inserting(rows.data() + i * 3));
  const auto walls = sweep_walls(hull, sites, [](std::size_t) {});
  ASSERT_TRUE(walls);
  for (std::size_t i = 0; i < sites.size(); ++i) EXPECT_EQ(walls->is_inside[sites[i]] != 0, i < 100);
  EXPECT_EQ(walls->hull.num_cells(), 2 * 408 - 4u);
  EXPECT_EQ(walls->planes.size(), walls->hull.num_cells());
}

TEST(SweptWalls, AreNotForFewPoints) {
  HullState hull(3);
  hull.insert_range(corners_of_cube(3), {});
  const Coordinates rows = cube(3, 500, 20, 3, 1);
  std::vector<Index> sites;
  for (std::size_t i = 0; i < 520; ++i) sites.push_back(hull.add_without_inserting(rows.data() + i * 3));
  EXPECT_FALSE(sweep_walls(hull, sites, [](std::size_t) {}));
}

/// Cells by coordinates of their vertices.
std::set<std::set<Coordinates>> cells_of(const HullState& state) {
  std::set<std::set<Coordinates>> cells;
  const auto d = static_cast<std::size_t>(state.sites().ambient);
  for (std::size_t c = 0; c < state.hull().num_cells(); ++c) {
    std::set<Coordinates> cell;
    for (const Index site : state.hull().cell(c))
      cell.emplace(state.sites().point(site), state.sites().point(site) + d);
    cells.insert(std::move(cell));
  }
  return cells;
}

/// A batch in the order given takes another road: all points are inserted.
void expect_same(const Coordinates& rows, int d) {
  HullState batch(d), given(d);
  batch.insert_range(rows, {});
  Options options;
  options.order = InsertionOrder::as_given;
  given.insert_range(rows, options);
  EXPECT_EQ(cells_of(batch), cells_of(given));
}

TEST(SweptWalls, ChangeNoCell) {
  const std::size_t n = test::scaled_size(2000, 1100);
  for (int d = 2; d <= 4; ++d)
    for (const std::size_t axes : {std::size_t{1}, static_cast<std::size_t>(d)})
      for (const double unit : {0.0, 0x1p-4}) {
        Coordinates rows = cube(d, n / 4, n, axes, 3);
        if (unit > 0)
          for (double& x : rows) x = std::nearbyint(x / unit) * unit;
        SCOPED_TRACE(testing::Message() << d << ' ' << axes << ' ' << unit);
        expect_same(rows, d);
      }
}

// Walls that are turned, so that rounding puts most of their points beside them.
TEST(SweptWalls, ChangeNoCellOfTurnedWalls) {
  const std::size_t n = test::scaled_size(2000, 1100);
  Coordinates rows = cube(3, n / 4, n, 3, 5);
  for (std::size_t i = 0; i < rows.size(); i += 3) {
    const double x = rows[i], y = rows[i + 1], z = rows[i + 2];
    rows[i] = 0.8 * x + 0.48 * y + 0.36 * z;
    rows[i + 1] = -0.6 * x + 0.64 * y + 0.48 * z;
    rows[i + 2] = -0.6 * y + 0.8 * z;
  }
  expect_same(rows, 3);
}

// In a flat one more coordinate is constant, or another one again, or the sum of all, on any axis.
TEST(SweptWalls, ChangeNoCellOfFlatSets) {
  const std::size_t n = test::scaled_size(2000, 1100);
  for (int d = 2; d <= 3; ++d) {
    Coordinates rows = cube(d, n / 4, n, static_cast<std::size_t>(d), 15);
    for (double& x : rows) x = std::nearbyint(64 * x);  // sums are exact
    const auto size = static_cast<std::size_t>(d);
    for (std::size_t axis = 0; axis <= size; ++axis)
      for (const std::string kind : {"zero", "constant", "again", "sum"}) {
        Coordinates flat;
        for (std::size_t i = 0; i < rows.size(); i += size) {
          std::vector<double> row(rows.begin() + static_cast<std::ptrdiff_t>(i),
                                  rows.begin() + static_cast<std::ptrdiff_t>(i + size));
          const double more = kind == "zero"       ? 0
                              : kind == "constant" ? 5
                              : kind == "again"    ? row[1]
                                                   : std::accumulate(row.begin(), row.end(), 0.0);
          row.insert(row.begin() + static_cast<std::ptrdiff_t>(axis), more);
          flat.insert(flat.end(), row.begin(), row.end());
        }
        SCOPED_TRACE(testing::Message() << d << ' ' << axis << ' ' << kind);
        expect_same(flat, d + 1);
      }
  }
}

/// All points of Z^d with Σ|x_j| ≤ size and, if it is a pyramid, x_0 ≥ 0: walls that are parallel to no axis
/// share the points of their ridges.
Coordinates cross_polytope(int d, int size, bool is_pyramid) {
  Coordinates rows;
  std::vector<int> x(static_cast<std::size_t>(d), -size);
  for (;;) {
    int sum = 0;
    for (const int entry : x) sum += std::abs(entry);
    if (sum <= size && (!is_pyramid || x[0] >= 0)) rows.insert(rows.end(), x.begin(), x.end());
    std::size_t j = 0;
    while (j < x.size() && x[j] == size) x[j++] = -size;
    if (j == x.size()) return rows;
    ++x[j];
  }
}

TEST(SweptWalls, ShareTheirRidges) {
  const int sizes[] = {40, 12, 7};
  for (int d = 2; d <= 4; ++d)
    for (const bool is_pyramid : {false, true})
      for (const double unit : {1.0, 0.1, 0x1p-900, 0x1p300}) {
        Coordinates rows = cross_polytope(d, sizes[d - 2], is_pyramid);
        const auto n = rows.size() / static_cast<std::size_t>(d);
        ASSERT_GT(n, 1100u);
        rows = test::permuted({"", d, rows}, 7).points;
        for (double& entry : rows) entry *= unit;
        SCOPED_TRACE(testing::Message() << d << ' ' << is_pyramid << ' ' << unit);
        expect_same(rows, d);
      }
}

// Some points are one unit in the last place off their walls, inside or beyond, and some are there twice.
TEST(SweptWalls, ChangeNoCellOfNudgedPoints) {
  const std::size_t n = test::scaled_size(2000, 1100);
  for (int d = 2; d <= 4; ++d) {
    Coordinates rows = cube(d, n / 4, n, static_cast<std::size_t>(d), 9);
    test::Random random(9);
    const auto size = static_cast<std::size_t>(d);
    for (std::size_t i = 0; i < rows.size(); i += 1 + random.bits() % 50)
      rows[i] = std::nextafter(rows[i], static_cast<double>(random.integer(-1, 2)));
    for (int twice = 0; twice < 50; ++twice) {
      const std::size_t row = random.bits() % n;
      rows.insert(rows.end(), rows.begin() + static_cast<std::ptrdiff_t>(row * size),
                  rows.begin() + static_cast<std::ptrdiff_t>((row + 1) * size));
    }
    SCOPED_TRACE(d);
    expect_same(rows, d);
  }
}

// What comes later finds the cells, functionals and flags as insertions leave them.
TEST(SweptWalls, CanBeGrown) {
  const std::size_t n = test::scaled_size(2000, 1100);
  for (int d = 2; d <= 4; ++d) {
    const Coordinates rows = cube(d, n / 4, n, static_cast<std::size_t>(d), 11);
    Coordinates more = cube(d, 20, 200, static_cast<std::size_t>(d), 12);
    for (std::size_t i = more.size() / 2; i < more.size(); ++i) more[i] *= 1.25;
    HullState batch(d), given(d);
    Options options;
    batch.insert_range(rows, {});
    HullState copy(batch);
    const auto stop = [] { throw Error(Errc::cancelled, "no"); };
    EXPECT_THROW(batch.insert_range(more, options, stop), Error);
    EXPECT_EQ(cells_of(batch), cells_of(copy));
    batch.insert_range(more, {});
    options.order = InsertionOrder::as_given;
    Coordinates all = rows;
    all.insert(all.end(), more.begin(), more.end());
    given.insert_range(all, options);
    EXPECT_EQ(cells_of(batch), cells_of(given)) << d;
    for (std::size_t i = 0; i < more.size(); i += static_cast<std::size_t>(d))
      copy.insert_range(std::span(more).subspan(i, static_cast<std::size_t>(d)), {});
    EXPECT_EQ(cells_of(copy), cells_of(given)) << d;
  }
}

// Of equal rows in the interior, one may be certainly there while the other is found there exactly.
TEST(SweptWalls, HaveEqualRowsTogether) {
  for (const std::uint64_t seed : {5, 6, 22}) {
    Coordinates rows = test::small_integers(4, 1300, 0, 10, seed).points;
    for (double& x : rows) x *= 0.1;
    for (std::size_t i = 3; i < rows.size(); i += 4) rows[i] *= 5;
    rows.insert(rows.end(), rows.begin(), rows.begin() + 4 * std::ptrdiff_t{300});
    const CheckReport report = check(ConvexHull<>(PointsView{rows, 4}).to_data());
    EXPECT_TRUE(report.ok) << report;
  }
}

// Rows near the corners may belong to the first shells, and be inside of the last one, where others equal
// them.
TEST(SweptWalls, HaveEqualRowsOfShellsTogether) {
  for (const std::uint64_t seed : {223, 227, 290, 390}) {
    test::Random random(seed);
    Coordinates rows(3 * std::size_t{1300});
    for (std::size_t i = 0; i < rows.size(); i += 3) {
      for (std::size_t j = i; j < i + 3; ++j) rows[j] = static_cast<double>(random.integer(-3, 3));
      rows[i + random.bits() % 3] = random.bits() % 2 == 0 ? -3 : 3;
      double& x = rows[i + random.bits() % 3];
      if (random.bits() % 20 == 0) x = std::nextafter(x, random.bits() % 2 == 0 ? -9 : 9);
    }
    const CheckReport report = check(ConvexHull<>(PointsView{rows, 3}).to_data());
    EXPECT_TRUE(report.ok) << report << " seed " << seed;
  }
}

TEST(SweptWalls, PassTheChecks) {
  const std::size_t n = test::scaled_size(2000, 1100);
  for (int d = 2; d <= 4; ++d) {
    const Coordinates rows = cube(d, n / 4, n, static_cast<std::size_t>(d), 13);
    const ConvexHull<> hull(PointsView{rows, d});
    const CheckReport report = check(hull.to_data());
    EXPECT_TRUE(report.ok) << report;
  }
}

}  // namespace
}  // namespace delone::hull
