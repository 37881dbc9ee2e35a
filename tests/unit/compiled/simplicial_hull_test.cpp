// SPDX-License-Identifier: BSD-3-Clause
// Sides of cells of a boundary, the two ends of a segment included.
#include "compiled/simplicial_hull.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace delone::compiled {
namespace {

BoundarySites sites_on(std::vector<double> coordinates, int ambient, std::vector<int> axes) {
  BoundarySites sites(ambient);
  sites.coordinates = std::move(coordinates);
  sites.axes = std::move(axes);
  for (Index site = 0; site < sites.size(); ++site) sites.grid.include(sites.point(site));
  return sites;
}

Sign side(const BoundarySites& sites, const SimplicialHull& hull, std::size_t c, std::vector<double> q) {
  kernel::Grid grid = sites.grid;
  grid.include(q.data());
  std::vector<const double*> scratch;
  return side_of_cell(sites, hull, c, q.data(), grid, scratch);
}

TEST(SimplicialHull, ASegmentHasALowerAndAnUpperEnd) {
  // Along the second axis of the plane.
  const BoundarySites sites = sites_on({5, 1, 5, 3}, 2, {1});
  const SimplicialHull hull{1, {0, 1}, {1, 0}, {}};
  EXPECT_EQ(hull.num_cells(), 2u);
  for (const auto& [y, lower, upper] :
       {std::tuple(2.0, Sign::positive, Sign::positive), std::tuple(0.0, Sign::negative, Sign::positive),
        std::tuple(4.0, Sign::positive, Sign::negative), std::tuple(1.0, Sign::zero, Sign::positive),
        std::tuple(3.0, Sign::positive, Sign::zero)}) {
    EXPECT_EQ(side(sites, hull, 0, {5, y}), lower) << y;
    EXPECT_EQ(side(sites, hull, 1, {5, y}), upper) << y;
  }
}

TEST(SimplicialHull, EdgesHaveTheInsideOnTheirPositiveSide) {
  const BoundarySites sites = sites_on({0, 0, 4, 0, 0, 4}, 2, {0, 1});
  const SimplicialHull hull{2, {0, 1, 1, 2, 2, 0}, {1, 2, 2, 0, 0, 1}, {}};
  ASSERT_EQ(hull.num_cells(), 3u);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(side(sites, hull, c, {1, 1}), Sign::positive);
  EXPECT_EQ(side(sites, hull, 0, {1, -0x1p-50}), Sign::negative);
  EXPECT_EQ(side(sites, hull, 1, {2, 2}), Sign::zero);
  EXPECT_EQ(side(sites, hull, 1, {2, 2 + 0x1p-51}), Sign::negative);
}

TEST(SimplicialHull, OfAPointAndOfNothingHasNoCells) {
  for (const int k : {-1, 0}) {
    const SimplicialHull hull{k, {}, {}, {}};
    EXPECT_EQ(hull.num_cells(), 0u);
    EXPECT_EQ(hull.corners(), 0u);
  }
}

}  // namespace
}  // namespace delone::compiled
