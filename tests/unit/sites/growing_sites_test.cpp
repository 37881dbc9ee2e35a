// SPDX-License-Identifier: BSD-3-Clause
// Equal rows share a site, ids are given in order, and what was added can be taken back.
#include "sites/growing_sites.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace delone::sites {
namespace {

using ::testing::ElementsAre;

std::vector<Index> sites_of_rows(const GrowingSites& sites) {
  std::vector<Index> all;
  for (std::size_t row = 0; row < sites.num_rows(); ++row) all.push_back(sites.site_of_row(row));
  return all;
}

std::vector<Index> rows_of_sites(const GrowingSites& sites) {
  std::vector<Index> all;
  for (Index site = 0; site < sites.size(); ++site) all.push_back(sites.row_of_site(site));
  return all;
}

TEST(GrowingSites, EqualPointsShareASite) {
  GrowingSites sites(2);
  sites.add_rows(std::vector<double>{1, 2, 0.0, 3, 1, 2, -0.0, 3, 2, 1});
  EXPECT_THAT(sites_of_rows(sites), ElementsAre(0, 1, 0, 1, 2));
  EXPECT_THAT(rows_of_sites(sites), ElementsAre(0, 1, 4));
  const double known[] = {2, 1}, unknown[] = {2, 2};
  EXPECT_EQ(sites.find(known), 2u);
  EXPECT_EQ(sites.find(unknown), invalid_index);
  EXPECT_EQ(sites.add_row(known), 2u);
  EXPECT_EQ(sites.add_row(unknown), 3u);
  EXPECT_THAT(rows_of_sites(sites), ElementsAre(0, 1, 4, 6));
}

TEST(GrowingSites, RowsOnOneRayShareASite) {
  GrowingSites sites(3, kernel::RowForm::homogeneous);
  const double at_infinity[] = {0, 0, -1};
  EXPECT_EQ(sites.add_site(at_infinity), 0u);
  sites.add_rows(std::vector<double>{1, 2, 0, 2, 4, 0, -1, -2, 0, 0.1, 0.2, 0.3, 0.3, 0.6, 0.9, 0, 0, -7});
  // (0.1, 0.2, 0.3)·3 is not (0.3, 0.6, 0.9): these are doubles.
  EXPECT_THAT(sites_of_rows(sites), ElementsAre(1, 1, 2, 3, 4, 0));
  EXPECT_THAT(rows_of_sites(sites), ElementsAre(invalid_index, 0, 2, 3, 4));
}

TEST(GrowingSites, RowsCanHaveNoneAtFirst) {
  GrowingSites sites(1);
  const std::vector<double> rows = {5, 6, 7, 6};
  const std::vector<Index> having_site = {0, 2};
  sites.add_rows(rows, &having_site);
  EXPECT_THAT(sites_of_rows(sites), ElementsAre(0, invalid_index, 1, invalid_index));
  sites.give_sites(std::vector<Index>{1, 3}, [&](Index row) { return &rows[row]; });
  EXPECT_THAT(sites_of_rows(sites), ElementsAre(0, 2, 1, 2));
  EXPECT_THAT(rows_of_sites(sites), ElementsAre(0, 2, 1));
  const std::vector<Index> none;
  sites.add_rows(std::vector<double>{8}, &none);
  EXPECT_EQ(sites.site_of_row(4), invalid_index);
}

TEST(GrowingSites, EarlierRowsAreTheFirstOfTheirSites) {
  const std::vector<double> rows = {1, 2, 3, 4, 3, 6, 5, 5};
  GrowingSites sites(2, kernel::RowForm::homogeneous);
  const std::vector<Index> having_site = {2, 3};
  sites.add_rows(rows, &having_site);
  sites.give_sites(std::vector<Index>{0, 1}, [&](Index row) { return &rows[2 * row]; });
  EXPECT_THAT(sites_of_rows(sites), ElementsAre(0, 2, 0, 1));
  EXPECT_THAT(rows_of_sites(sites), ElementsAre(0, 3, 1));
}

TEST(GrowingSites, AreTakenBack) {
  GrowingSites sites(1);
  sites.add_rows(std::vector<double>{1, 2, 1});
  const GrowingSites::Mark before = sites.mark();
  for (int round = 0; round < 3; ++round) {
    std::vector<double> more;
    for (int x = 0; x < 1000; ++x) more.push_back(x % 700);
    sites.add_rows(more);
    EXPECT_EQ(sites.size(), 700u);
    sites.rollback(before);
    EXPECT_THAT(sites_of_rows(sites), ElementsAre(0, 1, 0));
    EXPECT_THAT(rows_of_sites(sites), ElementsAre(0, 1));
    const double known = 2, forgotten = 5;
    EXPECT_EQ(sites.find(&known), 1u);
    EXPECT_EQ(sites.find(&forgotten), invalid_index);
  }
}

TEST(GrowingSites, AFinishedCopyKnowsRowsAndSites) {
  GrowingSites sites(1);
  sites.add_rows(std::vector<double>{1, 2, 1});
  const GrowingSites copy(sites, GrowingSites::Finished());
  EXPECT_THAT(sites_of_rows(copy), ElementsAre(0, 1, 0));
  EXPECT_EQ(*copy.point(1), 2);
}

}  // namespace
}  // namespace delone::sites
