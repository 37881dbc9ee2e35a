// SPDX-License-Identifier: BSD-3-Clause
#include "hull/hull_locator.hpp"

#include "hull/hull_state.hpp"
#include "hull_support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace delone::hull {
namespace {

using ::testing::ElementsAre;

/// A hull and its locator.
struct Located {
  Located(int d, const std::vector<double>& points) : state(d) {
    state.insert_range(points, {});
    locator.emplace(state.sites(), *state.boundary());
  }
  kernel::Grid grid_with(const std::vector<double>& q) const {
    kernel::Grid grid = state.sites().grid;
    grid.include(q.data());
    return grid;
  }
  HullLocator::Result locate(const std::vector<double>& q) const {
    return locator->locate(q.data(), grid_with(q));
  }
  Sign side(const std::vector<double>& q) const { return locate(q).side; }
  Sign side_of(std::size_t cell, const std::vector<double>& q) const {
    std::vector<const double*> scratch;
    return compiled::side_of_cell(state.sites(), state.hull(), cell, q.data(), grid_with(q), scratch);
  }
  /// cells_on_side() and what a search of all cells gives.
  void expect_cells_on_side(Sign side, const std::vector<double>& q) const {
    const HullLocator::Result start = locate(q);
    ASSERT_EQ(start.side, side);
    std::vector<Index> expected;
    for (std::size_t c = 0; c < state.hull().num_cells(); ++c)
      if (side_of(c, q) == side) expected.push_back(static_cast<Index>(c));
    EXPECT_EQ(locator->cells_on_side(start.cell, side, q.data(), grid_with(q)), expected);
  }

  HullState state;
  std::optional<HullLocator> locator;
};

TEST(HullLocator, TellsTheSideOfALatticeCube) {
  for (int d = 2; d <= 4; ++d) {
    const Located cube(d, test::lattice(d, 3).points);
    const std::vector<double> grid = test::lattice(d, 5).points;
    for (std::size_t at = 0; at < grid.size(); at += static_cast<std::size_t>(d)) {
      std::vector<double> q;  // −1 … 3
      double largest = 0;
      for (int j = 0; j < d; ++j) {
        q.push_back(grid[at + static_cast<std::size_t>(j)] - 1);
        largest = std::max(largest, std::fabs(q.back() - 1));
      }
      const Sign expected = largest < 1 ? Sign::positive : largest == 1 ? Sign::zero : Sign::negative;
      const HullLocator::Result found = cube.locate(q);
      EXPECT_EQ(found.side, expected);
      EXPECT_EQ(cube.side_of(found.cell, q), expected);  // the cell proves it
      EXPECT_EQ(cube.locator->side_of_hull(q.data(), cube.grid_with(q)), expected);
    }
  }
}

TEST(HullLocator, SeesOneUnitInTheLastPlace) {
  const Located cube(3, test::lattice(3, 3).points);
  EXPECT_EQ(cube.side({2, 0.3, 1.1}), Sign::zero);
  EXPECT_EQ(cube.side({std::nextafter(2.0, 3.0), 0.3, 1.1}), Sign::negative);
  EXPECT_EQ(cube.side({std::nextafter(2.0, 1.0), 0.3, 1.1}), Sign::positive);
  EXPECT_EQ(cube.side({0x1p-1074, 1, 1}), Sign::positive);
  EXPECT_EQ(cube.side({-0x1p-1074, 1, 1}), Sign::negative);
  EXPECT_EQ(cube.side({1e300, -1e300, 1}), Sign::negative);
}

TEST(HullLocator, CollectsCellsOfOneSide) {
  const Located cube(3, test::lattice(3, 3).points);
  cube.expect_cells_on_side(Sign::zero, {2, 1, 1});        // in a facet
  cube.expect_cells_on_side(Sign::zero, {2, 2, 0.5});      // in a ridge
  cube.expect_cells_on_side(Sign::zero, {2, 2, 2});        // at a vertex: three facets
  cube.expect_cells_on_side(Sign::negative, {3, 0.5, 1});  // beyond one facet
  cube.expect_cells_on_side(Sign::negative, {3, -1, 9});   // beyond three
  cube.expect_cells_on_side(Sign::negative, {3, 2, 1});    // beyond one, in the plane of another
}

// k = 1, in R^1 and on a line of R^2: the two ends are cells 0 and 1.
TEST(HullLocator, OfASegment) {
  for (const int d : {1, 2}) {
    const auto at = [&](double x) { return d == 1 ? std::vector{x} : std::vector{x, 3 - 2 * x}; };
    std::vector<double> points;
    for (const double x : {1.0, 4.0, 2.0, -1.0})
      for (const double y : at(x)) points.push_back(y);
    const Located segment(d, points);
    EXPECT_EQ(segment.side(at(0.5)), Sign::positive);
    EXPECT_EQ(segment.side(at(4)), Sign::zero);
    EXPECT_EQ(segment.side(at(-1)), Sign::zero);
    EXPECT_EQ(segment.locate(at(-2)).cell, 0u);
    EXPECT_EQ(segment.side(at(-2)), Sign::negative);
    EXPECT_EQ(segment.locate(at(5)).cell, 1u);
    EXPECT_EQ(segment.side(at(5)), Sign::negative);
  }
}

// No double is strictly inside this triangle, so there is no fan.
TEST(HullLocator, SearchesAllCellsWithoutACenter) {
  const double next = std::nextafter(1.0, 2.0);
  const Located triangle(2, {1, 1, next, 1, 1, next});
  ASSERT_FALSE(triangle.state.boundary()->has_center());
  for (const std::vector<double>& corner : {std::vector{1.0, 1.0}, {next, 1.0}, {1.0, next}})
    EXPECT_EQ(triangle.side(corner), Sign::zero);
  // The last three are on the line of one edge and beyond another.
  const double previous = std::nextafter(1.0, 0.0), after = std::nextafter(next, 2.0);
  for (const std::vector<double>& q :
       {std::vector{next, next}, {0.0, 0.0}, {previous, 1.0}, {1.0, previous}, {1.0, after}}) {
    const HullLocator::Result found = triangle.locate(q);
    EXPECT_EQ(found.side, Sign::negative);
    EXPECT_EQ(triangle.side_of(found.cell, q), Sign::negative);
  }
}

// A square in the plane z = x + y.
TEST(HullLocator, OfAFlatHull) {
  const Located square(3, {0, 0, 0, 2, 0, 2, 0, 2, 2, 2, 2, 4, 1, 1, 2, 1, 0, 1});
  EXPECT_EQ(square.side({1, 1, 2}), Sign::positive);
  EXPECT_EQ(square.side({1, 0, 1}), Sign::zero);
  EXPECT_EQ(square.side({3, 1, 4}), Sign::negative);
}

}  // namespace
}  // namespace delone::hull
