// SPDX-License-Identifier: BSD-3-Clause
// Random subsets that depend on the points alone: their size, duplicates, and sets that are nearly all
// duplicates.
#include "forecast/sample.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace delone::cost_model {
namespace {

std::multiset<std::vector<double>> points_of(const Sample& sample, const std::vector<double>& rows) {
  std::multiset<std::vector<double>> points;
  for (const std::size_t row : sample.rows) points.insert({rows[2 * row], rows[2 * row + 1]});
  return points;
}

TEST(Sample, OfFewPointsIsAllThatAreDistinct) {
  const std::vector<double> rows{0, 1, 2, 3, 0, 1, -0.0, 1, 2, 4};
  for (const std::size_t most : {5u, 100u}) {
    const Sample sample = sample_of(rows, 2, most);
    EXPECT_TRUE(sample.is_all);
    EXPECT_EQ(sample.num_distinct, 3);
    EXPECT_EQ(std::set<std::size_t>(sample.rows.begin(), sample.rows.end()), (std::set<std::size_t>{0, 1, 4}))
        << "the first rows of equal points";
  }
  EXPECT_TRUE(sample_of({}, 2, 5).is_all);
  EXPECT_EQ(sample_of({}, 2, 5).num_distinct, 0);
}

TEST(Sample, OfManyPointsIsAPartOfThem) {
  const std::vector<double> rows = make_point_set("uniform", 2, 20000, 1);
  const Sample sample = sample_of(rows, 2, 1000);
  EXPECT_FALSE(sample.is_all);
  EXPECT_NEAR(static_cast<double>(sample.rows.size()), 1000, 150);
  EXPECT_NEAR(sample.num_distinct, 20000, 3000);
  std::vector<double> reversed;
  for (std::size_t row = 20000; row-- > 0;)
    reversed.insert(reversed.end(), {rows[2 * row], rows[2 * row + 1]});
  EXPECT_EQ(points_of(sample, rows), points_of(sample_of(reversed, 2, 1000), reversed));
}

TEST(Sample, OfNearlyAllDuplicatesIsAll) {
  // Ten points, each two thousand times: a part of the hashes would be of none or one of them.
  std::vector<double> rows;
  for (int i = 0; i < 20000; ++i) rows.insert(rows.end(), {1.0 * (i % 10), 0.5});
  const Sample sample = sample_of(rows, 2, 1000);
  EXPECT_TRUE(sample.is_all);
  EXPECT_EQ(sample.rows.size(), 10u);
  EXPECT_EQ(sample.num_distinct, 10);
}

}  // namespace
}  // namespace delone::cost_model
