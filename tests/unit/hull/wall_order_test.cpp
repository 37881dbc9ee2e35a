// SPDX-License-Identifier: BSD-3-Clause
// Points on walls: the order of insertion, and that the hull does not depend on it.
#include "hull/wall_order.hpp"

#include "scale.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

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

TEST(WallOrder, GoesWallByWallInLexicographicOrder) {
  HullState hull(3);
  hull.insert_range(corners_of_cube(3), {});
  const Coordinates rows = cube(3, 100, 400, 3, 1);
  std::vector<Index> sites;
  for (std::size_t i = 0; i < 500; ++i) sites.push_back(hull.add_without_inserting(rows.data() + i * 3));
  const std::vector<Index> before = sites;
  ASSERT_TRUE(order_by_walls(hull, sites));
  EXPECT_EQ(std::set<Index>(before.begin(), before.end()), std::set<Index>(sites.begin(), sites.end()));
  const auto wall = [&](Index site) {
    const double* p = hull.sites().point(site);
    for (int j = 0; j < 3; ++j)
      if (p[j] == 0 || p[j] == 1) return 1 + 2 * j + static_cast<int>(p[j]);
    return 0;
  };
  std::set<int> seen;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_EQ(wall(sites[i]) == 0, i < 100);
    if (i == 0 || wall(sites[i]) != wall(sites[i - 1])) {
      EXPECT_TRUE(seen.insert(wall(sites[i])).second);
    } else {
      const double *p = hull.sites().point(sites[i - 1]), *q = hull.sites().point(sites[i]);
      EXPECT_TRUE(std::lexicographical_compare(p, p + 3, q, q + 3));
    }
  }
  EXPECT_EQ(seen.size(), 7u);
}

TEST(WallOrder, LeavesFewPointsOnWallsAlone) {
  HullState hull(3);
  hull.insert_range(corners_of_cube(3), {});
  const Coordinates rows = cube(3, 500, 20, 3, 1);
  std::vector<Index> sites;
  for (std::size_t i = 0; i < 520; ++i) sites.push_back(hull.add_without_inserting(rows.data() + i * 3));
  const std::vector<Index> before = sites;
  EXPECT_FALSE(order_by_walls(hull, sites));
  EXPECT_EQ(sites, before);
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

// A batch in the order given takes another road.
TEST(WallOrder, ChangesNoCell) {
  const std::size_t n = test::scaled_size(2000, 1100);
  for (int d = 2; d <= 4; ++d)
    for (const std::size_t axes : {std::size_t{1}, static_cast<std::size_t>(d)})
      for (const double unit : {0.0, 0x1p-4}) {
        Coordinates rows = cube(d, n / 4, n, axes, 3);
        if (unit > 0)
          for (double& x : rows) x = std::nearbyint(x / unit) * unit;
        HullState batch(d), given(d);
        batch.insert_range(rows, {});
        Options options;
        options.order = InsertionOrder::as_given;
        given.insert_range(rows, options);
        EXPECT_EQ(cells_of(batch), cells_of(given)) << d << ' ' << axes << ' ' << unit;
      }
}

// Walls that are turned, so that rounding puts most of their points beside them.
TEST(WallOrder, ChangesNoCellOfTurnedWalls) {
  const std::size_t n = test::scaled_size(2000, 1100);
  Coordinates rows = cube(3, n / 4, n, 3, 5);
  for (std::size_t i = 0; i < rows.size(); i += 3) {
    const double x = rows[i], y = rows[i + 1], z = rows[i + 2];
    rows[i] = 0.8 * x + 0.48 * y + 0.36 * z;
    rows[i + 1] = -0.6 * x + 0.64 * y + 0.48 * z;
    rows[i + 2] = -0.6 * y + 0.8 * z;
  }
  HullState batch(3), given(3);
  batch.insert_range(rows, {});
  Options options;
  options.order = InsertionOrder::as_given;
  given.insert_range(rows, options);
  EXPECT_EQ(cells_of(batch), cells_of(given));
}

}  // namespace
}  // namespace delone::hull
