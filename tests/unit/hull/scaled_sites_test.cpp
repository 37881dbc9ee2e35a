// SPDX-License-Identifier: BSD-3-Clause
// Sites where distances count: themselves, or a copy with a grid of its own.
#include "hull/scaled_sites.hpp"

#include "hull_support.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace delone::hull {
namespace {

TEST(ScaledSites, AreTheSitesUnlessAxesDiffer) {
  const BoundarySites sites = sites_of(2, {1, 2, 3, 5}, {1});
  EXPECT_EQ(&ScaledSites(sites, internal::AxisScale(0.5)).get(), &sites);
  const std::vector<double> equal{0.5, 0.5}, wanted{0.25, 4};
  EXPECT_EQ(&ScaledSites(sites, internal::AxisScale(0, equal, 2)).get(), &sites);
  const internal::AxisScale scale(0, wanted, 2);
  const ScaledSites scaled(sites, scale);
  ASSERT_NE(&scaled.get(), &sites);
  EXPECT_EQ(scaled.get().axes, sites.axes);
  EXPECT_EQ(scaled.get().coordinates, scale.scaled(sites.coordinates));
  EXPECT_EQ(scaled.get().coordinates, (std::vector<double>{16, 2, 48, 5}));
  EXPECT_EQ(scaled.get().grid.exponent(0), 4);
  EXPECT_EQ(scaled.get().grid.exponent(1), 0);
}

}  // namespace
}  // namespace delone::hull
