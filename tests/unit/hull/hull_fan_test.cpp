// SPDX-License-Identifier: BSD-3-Clause
#include "hull/hull_fan.hpp"

#include "hull/hull_state.hpp"
#include "hull_support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace delone::hull {

namespace {

using ::testing::ElementsAre;

constexpr auto always = [](const double*, const kernel::Grid&) { return true; };

// The mean is (1, 1/3); its extents are 2 and 2/3, so the units of the first trial are 2⁻⁶ and 2⁻⁸.
TEST(ChooseInteriorPoint, TriesFewBitsFirst) {
  const BoundarySites sites = sites_of(2, {0, 0, 3, 0, 0, 1});
  std::vector<double> point(2);
  EXPECT_TRUE(choose_interior_point(sites, {0, 1, 2}, point, always));
  EXPECT_THAT(point, ElementsAre(1, 85.0 / 256));
  int calls = 0;
  const auto second = [&](const double*, const kernel::Grid&) { return ++calls == 2; };
  EXPECT_TRUE(choose_interior_point(sites, {0, 1, 2}, point, second));
  EXPECT_THAT(point, ElementsAre(1, 1.0 / 3));
  const auto never = [](const double*, const kernel::Grid&) { return false; };
  EXPECT_FALSE(choose_interior_point(sites, {0, 1, 2}, point, never));
}

TEST(ChooseInteriorPoint, GivesAGridForThePoint) {
  const BoundarySites sites = sites_of(1, {0, 3});
  std::vector<double> point(1);
  EXPECT_TRUE(choose_interior_point(sites, {0, 1}, point, [](const double* p, const kernel::Grid& grid) {
    return grid.exponent(0) <= kernel::trailing_exponent(*p);
  }));
  EXPECT_EQ(point[0], 1.5);
  EXPECT_EQ(sites.grid.exponent(0), 0);
}

TEST(ChooseInteriorPoint, HoldsAtTheEndsOfTheRange) {
  for (const double scale : {0x1p-1073, 0x1p-1000, 0x1p1022}) {
    const BoundarySites sites = sites_of(1, {-scale, scale, 0, scale});
    std::vector<double> point(1);
    EXPECT_TRUE(choose_interior_point(sites, {0, 1}, point, always));
    EXPECT_EQ(point[0], 0);
    EXPECT_TRUE(choose_interior_point(sites, {1, 3}, point, always));
    EXPECT_EQ(point[0], scale);
  }
}

/// The corners of the cross-polytope: sites 2j at −e_j and 2j+1 at e_j.
HullState cross_polytope(int d) {
  std::vector<double> points;
  for (int j = 0; j < d; ++j)
    for (const double x : {-1.0, 1.0})
      for (int i = 0; i < d; ++i) points.push_back(i == j ? x : 0);
  HullState state(d);
  state.insert_range(points, {});
  return state;
}

// The cones are the orthants.
TEST(WalkCones, FindsTheOrthant) {
  for (int d = 2; d <= 4; ++d) {
    const HullState state = cross_polytope(d);
    const BoundarySites& sites = state.sites();
    const SimplicialHull& hull = state.hull();
    ASSERT_EQ(hull.num_cells(), std::size_t{1} << d);
    const std::vector<double> center(static_cast<std::size_t>(d), 0.0);
    for (int orthant = 0; orthant < 1 << d; ++orthant)
      for (std::size_t start = 0; start < hull.num_cells(); ++start) {
        std::vector<double> q;
        for (int j = 0; j < d; ++j) q.push_back((j + 2) * (orthant >> j & 1 ? 0.125 : -0.125));
        kernel::Grid grid = sites.grid;
        grid.include(q.data());
        grid.include(center.data());
        const std::size_t c = walk_cones(sites, hull, center, q.data(), start, grid);
        for (const Index site : hull.cell(c))
          for (int j = 0; j < d; ++j) EXPECT_GE(sites.point(site)[j] * q[static_cast<std::size_t>(j)], 0);
      }
  }
}

TEST(WalkCones, AcceptsWallsAndTheCenter) {
  const HullState state = cross_polytope(3);
  const BoundarySites& sites = state.sites();
  const SimplicialHull& hull = state.hull();
  const std::vector<double> center(3, 0.0);
  for (std::size_t start = 0; start < hull.num_cells(); ++start) {
    kernel::Grid grid = sites.grid;
    grid.include(center.data());
    EXPECT_EQ(walk_cones(sites, hull, center, center.data(), start, grid), start);
    const double axis[3] = {7, 0, 0};
    grid.include(axis);
    const std::size_t c = walk_cones(sites, hull, center, axis, start, grid);
    const auto is_at_the_axis = [&](Index site) { return sites.point(site)[0] == 1; };
    EXPECT_TRUE(std::any_of(hull.cell(c).begin(), hull.cell(c).end(), is_at_the_axis));
    // One unit in the last place beside the wall y = 0.
    const double nudged[3] = {7, 0x1p-1074, 1};
    grid.include(nudged);
    const std::size_t beside = walk_cones(sites, hull, center, nudged, start, grid);
    for (const Index site : hull.cell(beside)) EXPECT_GE(sites.point(site)[1], 0);
  }
}

// All cells of a facet lie in one hyperplane: the fan still tells them apart.
TEST(WalkCones, FindsEachCellOfALatticeCube) {
  for (int d = 2; d <= 3; ++d) {
    HullState state(d);
    state.insert_range(test::lattice(d, 3).points, {});
    const BoundarySites& sites = state.sites();
    const SimplicialHull& hull = state.hull();
    const std::vector<double> center(static_cast<std::size_t>(d), 1.0);
    for (std::size_t c = 0; c < hull.num_cells(); ++c) {
      std::vector<double> q(static_cast<std::size_t>(d), 0.0);
      for (const Index site : hull.cell(c))
        for (std::size_t j = 0; j < q.size(); ++j) q[j] += 4 * sites.point(site)[j];
      for (double& x : q) x -= 4 * d - 1;  // 4·d·(mean − center) + center
      kernel::Grid grid = sites.grid;
      grid.include(q.data());
      grid.include(center.data());
      EXPECT_EQ(walk_cones(sites, hull, center, q.data(), 0, grid), c);
    }
  }
}

}  // namespace
}  // namespace delone::hull
