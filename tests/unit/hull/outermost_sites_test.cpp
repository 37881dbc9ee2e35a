// SPDX-License-Identifier: BSD-3-Clause
#include "hull/outermost_sites.hpp"

#include "hull_support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace delone::hull {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

TEST(OutermostSites, AreTheEndsOfALine) {
  EXPECT_THAT(outermost_sites(sites_of(1, {3, 1, 4, 1, 5, 9, 2, 6}), 0), ElementsAre(1, 5));
  EXPECT_THAT(outermost_sites(sites_of(1, {3, 1, 4, 1, 5, 9, 2, 6}), 2), ElementsAre(3, 5));
  EXPECT_THAT(outermost_sites(sites_of(1, {7}), 0), ElementsAre(0));
  EXPECT_THAT(outermost_sites(sites_of(1, {7}), 1), IsEmpty());
}

// The axes come first: x, then y. The diagonals of the box then find the corners, though it is 1000 times as
// wide as it is high.
TEST(OutermostSites, AreFarthestAlongAxesAndDiagonals) {
  const BoundarySites sites =
      sites_of(2, {0, 0, -500, 0, 500, 0, 0, -0.5, 0, 0.5, 400, 0.4, -400, 0.4, 400, -0.4, -400, -0.4});
  EXPECT_THAT(outermost_sites(sites, 0), ElementsAre(1, 2, 3, 4, 8, 5, 6, 7));
}

TEST(OutermostSites, AreTheCornersOfACube) {
  for (int d = 2; d <= 5; ++d) {
    const test::PointSet cube = test::lattice(d, 3);
    const auto found = outermost_sites(sites_of(d, cube.points), 0);
    const auto is_corner = [&](Index site) {
      for (int j = 0; j < d; ++j)
        if (cube.points[site * static_cast<std::size_t>(d) + static_cast<std::size_t>(j)] == 1) return false;
      return true;
    };
    EXPECT_EQ(std::count_if(found.begin(), found.end(), is_corner), 1 << d) << d;
  }
}

// From 6 dimensions on the axes alone count.
TEST(OutermostSites, AreFewInManyDimensions) {
  std::vector<double> points(13 * 6, 0.0);
  for (std::size_t j = 0; j < 6; ++j) {
    points[2 * j * 6 + j] = -1;
    points[(2 * j + 1) * 6 + j] = 1;
  }
  for (std::size_t j = 0; j < 6; ++j) points[12 * 6 + j] = 0.9;  // farthest along the diagonal
  EXPECT_THAT(outermost_sites(sites_of(6, points), 0), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11));
}

TEST(OutermostSites, HoldForAFlatBoxAndForTheEndsOfTheRange) {
  EXPECT_THAT(outermost_sites(sites_of(2, {1, 5, 3, 5, 2, 5}), 0), ElementsAre(0, 1));
  EXPECT_THAT(outermost_sites(sites_of(2, {4, 4, 4, 4}), 0), ElementsAre(0));
  // The width of the box overflows.
  EXPECT_THAT(outermost_sites(sites_of(2, {-1.7e308, 0, 1.7e308, 0, 0, 1, 0, -1}), 0),
              UnorderedElementsAre(0, 1, 2, 3));
  // One over the width of the box overflows.
  EXPECT_THAT(outermost_sites(sites_of(2, {0, 0, 5e-324, 0, 0, 5e-324}), 0), UnorderedElementsAre(0, 1, 2));
}

}  // namespace
}  // namespace delone::hull
