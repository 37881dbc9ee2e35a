// SPDX-License-Identifier: BSD-3-Clause
// The sweep of one wall against the facet that insertions make.
#include "hull/wall_sweep.hpp"

#include "hull/hull_state.hpp"
#include "hull_support.hpp"
#include "kernel/stages.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace delone::hull {
namespace {

using Rows = std::vector<double>;
using Cells = std::set<std::set<Rows>>;

/// Rows of m entries in the hyperplane of R^(m+1) where the last entry is a fixed combination of the others.
Rows on_wall(int m, const Rows& flat, const Rows& slope) {
  const auto size = static_cast<std::size_t>(m);
  Rows rows;
  for (std::size_t i = 0; i < flat.size(); i += size) {
    double last = 0;
    for (std::size_t j = 0; j < size; ++j) {
      rows.push_back(flat[i + j]);
      last += slope[j] * flat[i + j];
    }
    rows.push_back(last);
  }
  return rows;
}

Cells cells_of(const BoundarySites& sites, std::span<const Index> cells, std::size_t corners,
               const double* without) {
  Cells result;
  for (std::size_t at = 0; at < cells.size(); at += corners) {
    std::set<Rows> cell;
    for (const Index site : cells.subspan(at, corners))
      cell.emplace(sites.point(site), sites.point(site) + sites.ambient);
    if (without == nullptr || !cell.contains(Rows(without, without + sites.ambient))) result.insert(cell);
  }
  return result;
}

/// Neighbors know each other across the ridge that they share, and are on different sides of it.
void expect_linked(const BoundarySites& sites, const SweptWall& wall) {
  const std::size_t k = wall.corners;
  for (std::size_t at = 0; at < wall.cells.size(); ++at) {
    if (wall.neighbors[at] == invalid_index) continue;
    const std::size_t c = at / k, other = wall.neighbors[at];
    const auto cell = std::span(wall.cells).subspan(c * k, k),
               across = std::span(wall.cells).subspan(other * k, k);
    const auto begin = wall.neighbors.begin() + static_cast<std::ptrdiff_t>(other * k);
    const auto mirror = static_cast<std::size_t>(
        std::find(begin, begin + static_cast<std::ptrdiff_t>(k), static_cast<Index>(c)) - begin);
    ASSERT_LT(mirror, k);
    std::set<Index> ridge(cell.begin(), cell.end()), ridge_of_other(across.begin(), across.end());
    ridge.erase(cell[at % k]);
    ridge_of_other.erase(across[mirror]);
    EXPECT_EQ(ridge, ridge_of_other);
    EXPECT_FALSE(ridge.contains(across[mirror]));
  }
  // Seen from a point off the wall, all cells have one orientation.
  Rows apex(static_cast<std::size_t>(sites.ambient), 0);
  apex.back() = -1000;
  kernel::Grid grid = sites.grid;
  grid.include(apex.data());
  std::vector<const double*> scratch;
  std::set<int> signs;
  for (std::size_t c = 0; c < wall.num_cells(); ++c)
    signs.insert(static_cast<int>(
        compiled::side_of_sites(sites, std::span(wall.cells).subspan(c * k, k), apex.data(), grid, scratch)));
  EXPECT_EQ(signs.size(), 1u);
  EXPECT_FALSE(signs.contains(0));
}

/// `flat`: rows of m entries that span R^m.
void expect_as_inserted(int m, const Rows& flat, const Rows& slope) {
  Rows rows = on_wall(m, flat, slope);
  const auto d = static_cast<std::size_t>(m) + 1;
  Rows apex(d, 0);
  apex.back() = 1e3;
  rows.insert(rows.end(), apex.begin(), apex.end());
  HullState hull(m + 1);
  Options options;
  options.order = InsertionOrder::as_given;
  hull.insert_range(rows, options);
  std::vector<Index> wall;
  for (Index site = 0; site < hull.sites().size(); ++site)
    if (!std::equal(apex.begin(), apex.end(), hull.sites().point(site))) wall.push_back(site);
  std::sort(wall.begin(), wall.end(), [&](Index a, Index b) {
    return kernel::lexicographically_less(hull.sites().point(a), hull.sites().point(b), m + 1);
  });
  std::size_t last = 0;
  const SweptWall swept = sweep_wall(hull.sites(), wall, [&](std::size_t done) {
    EXPECT_LE(last, done);
    last = done;
  });
  EXPECT_LT(last, wall.size());
  EXPECT_EQ(cells_of(hull.sites(), swept.cells, swept.corners, nullptr),
            cells_of(hull.sites(), hull.hull().cells, d, apex.data()));
  expect_linked(hull.sites(), swept);
}

Rows slope_of(int m, double step) {
  Rows slope(static_cast<std::size_t>(m), 0);
  for (int j = 0; j < m; ++j) slope[static_cast<std::size_t>(j)] = step * (j + 1);
  return slope;
}

TEST(WallSweep, MakesTheCellsThatInsertionsMake) {
  for (int m = 1; m <= 4; ++m)
    for (const double step : {0.0, 1.0, -2.0})
      for (const int range : {1, 2, 5, 1000}) {
        const std::size_t n = test::scaled_size(m == 4 ? 60 : 200, 40);
        Rows flat = test::small_integers(m, n, -range, range, static_cast<std::uint64_t>(range + m)).points;
        for (int corner = 0; corner < 1 << m; ++corner)  // they span
          for (int j = 0; j < m; ++j) flat.push_back(corner >> j & 1);
        SCOPED_TRACE(testing::Message() << m << ' ' << step << ' ' << range);
        expect_as_inserted(m, flat, slope_of(m, step));
      }
}

// The first points are on a line, then in a plane, and then span space.
TEST(WallSweep, BeginsInAnyDimension) {
  for (int m = 2; m <= 4; ++m) {
    Rows flat;
    for (int flag = 0; flag <= m; ++flag)
      for (int i = 0; i < 5; ++i)
        for (int j = 0; j < m; ++j) flat.push_back(j < m - flag ? 0 : (i + 1) * (j + 2) % 7);
    for (int j = 0; j < m; ++j) flat.push_back(3);
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i) flat.push_back(i >= j ? 2 : 0);
    SCOPED_TRACE(m);
    expect_as_inserted(m, flat, slope_of(m, 0));
    expect_as_inserted(m, flat, slope_of(m, 1));
  }
}

TEST(WallSweep, KnowsNoScale) {
  for (int m = 1; m <= 3; ++m) {
    const Rows integers = test::small_integers(m, 150, -6, 6, 8).points;
    for (const double unit : {0x1p-1000, 0x1p-300, 0x1p-30}) {
      Rows flat = integers;
      for (double& x : flat) x *= unit;
      SCOPED_TRACE(testing::Message() << m << ' ' << unit);
      expect_as_inserted(m, flat, slope_of(m, 1));
    }
  }
}

TEST(WallSweep, CanBeStopped) {
  HullState hull(3);
  hull.insert_range(on_wall(2, test::small_integers(2, 500, 0, 100, 1).points, {0, 0}), {});
  std::vector<Index> wall(hull.sites().size());
  std::iota(wall.begin(), wall.end(), Index{0});
  BoundarySites sites = hull.sites();
  sites.axes = {0, 1, 2};
  std::sort(wall.begin(), wall.end(), [&](Index a, Index b) {
    return kernel::lexicographically_less(sites.point(a), sites.point(b), 3);
  });
  const auto stop = [](std::size_t done) {
    if (done > 200) throw Error(Errc::cancelled, "enough");
  };
  EXPECT_THROW(sweep_wall(sites, wall, stop), Error);
}

}  // namespace
}  // namespace delone::hull
