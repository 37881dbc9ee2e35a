// SPDX-License-Identifier: BSD-3-Clause
#include "hull/sieved_rows.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace delone::hull {
namespace {

TEST(SievedRows, KnowEqualRowsAmongThemselves) {
  const std::vector<double> rows{9, 9, 1, 2, 0.0, 1, 1, 2, -0.0, 1, 9, 8};
  const SievedRows sieved(rows, 2, {1, 2, 3, 4});
  EXPECT_EQ(sieved.first_rows(), (std::vector<Index>{1, 2, 1, 2}));
  EXPECT_EQ(sieved.num_duplicates(), 2u);
  EXPECT_EQ(sieved.point(5)[1], 8);
  SievedRows copy = sieved;
  EXPECT_EQ(copy.first_rows(), sieved.first_rows());
  EXPECT_FALSE(copy.empty());
  SievedRows moved;
  EXPECT_TRUE(moved.empty());
  moved = std::move(copy);
  EXPECT_EQ(moved.num_duplicates(), 2u);
  EXPECT_EQ(moved.rows().size(), 4u);
}

}  // namespace
}  // namespace delone::hull
