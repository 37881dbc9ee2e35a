// SPDX-License-Identifier: BSD-3-Clause
#include "sites/site_table.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace delone::sites {
namespace {

constexpr auto any = [](Index) { return true; };

TEST(SiteTable, FindsNothingWhereNothingIs) {
  SiteTable table;
  EXPECT_EQ(table.find(7, any), invalid_index);
  table.prefetch(7);
  table.remove_last(7, 0);
  table.add(7, 0);
  EXPECT_EQ(table.find(8, any), invalid_index);
  EXPECT_EQ(table.find(7, [](Index) { return false; }), invalid_index);
}

// All tags are equal modulo every capacity, so each search probes the whole cluster; the table grows on the
// way.
TEST(SiteTable, KeepsCollidingSitesApart) {
  SiteTable table;
  constexpr Index n = 100;
  for (Index site = 0; site < n; ++site) table.add(std::uint64_t{site} << 32, site);
  for (Index site = 0; site < n; ++site) EXPECT_EQ(table.find(std::uint64_t{site} << 32, any), site);
  EXPECT_EQ(table.find(std::uint64_t{n} << 32, any), invalid_index);
}

TEST(SiteTable, DistinguishesPointsWithOneTag) {
  SiteTable table;
  for (Index site = 0; site < 40; ++site) table.add(15, site);
  for (Index site = 0; site < 40; ++site)
    EXPECT_EQ(table.find(15, [&](Index candidate) { return candidate == site; }), site);
}

// Clusters wrap around the end of the table.
TEST(SiteTable, ForgetsOnlyTheLastSite) {
  SiteTable table;
  for (Index site = 0; site < 5; ++site) table.add(15, site);
  table.remove_last(15, 4);
  table.remove_last(15, 4);  // no longer there
  table.remove_last(3, 9);   // never was
  for (Index site = 0; site < 5; ++site) {
    const auto is_site = [&](Index candidate) { return candidate == site; };
    EXPECT_EQ(table.find(15, is_site), site < 4 ? site : invalid_index);
  }
  table.add(15, 4);
  EXPECT_EQ(table.find(15, [](Index candidate) { return candidate == 4; }), 4u);
}

// A table that fills up would search forever for what it does not hold.
TEST(SiteTable, NeverFillsUp) {
  SiteTable table;
  for (Index site = 0; site < 64; ++site) {
    table.add(site, site);
    EXPECT_EQ(table.find(64, any), invalid_index);
  }
}

// If removals of nothing were counted, every later addition would double the table.
TEST(SiteTable, CountsItsSites) {
  SiteTable table;
  table.add(1, 0);
  for (int i = 0; i < 40; ++i) table.remove_last(2, 9);
  for (Index site = 1; site < 60; ++site) EXPECT_NO_THROW(table.add(site, site));
}

TEST(SiteTable, HasReservedRoom) {
  SiteTable table;
  table.reserve(1000);
  for (Index site = 0; site < 1000; ++site) table.add(site, site);
  for (std::uint64_t tag = 1000; tag < 4096; ++tag) EXPECT_EQ(table.find(tag, any), invalid_index);
  for (Index site = 0; site < 1000; ++site) EXPECT_EQ(table.find(site, any), site);
}

}  // namespace
}  // namespace delone::sites
