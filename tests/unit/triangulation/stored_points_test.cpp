// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/stored_points.hpp"

#include <delone/delaunay.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace delone::triangulation {
namespace {

using Point2 = std::array<double, 2>;

TEST(StoredPoints, AreThoseOfTheVertices) {
  const Delaunay<2> t(std::vector<Point2>{{0, 0}, {4, 0}, {0, 4}, {4, 0}});
  for (std::size_t row = 0; row < 4; ++row) {
    const double* stored = StoredPoints::of_row(t, row);
    const auto p = t.point(t.vertex_at(row));
    EXPECT_EQ(stored, StoredPoints::of(t).point(index(t.vertex_at(row))));
    EXPECT_EQ(stored[0], p[0]);
    EXPECT_EQ(stored[1], p[1]);
  }
  EXPECT_EQ(StoredPoints::of_row(t, 3), StoredPoints::of_row(t, 1));  // a duplicate
}

TEST(StoredPoints, IncludeHiddenOnesAndWeights) {
  const Regular<2> t(std::vector<Point2>{{0, 0}, {4, 0}, {0, 4}, {1, 1}}, std::vector<double>{9, 0, 0, -7});
  ASSERT_TRUE(t.is_hidden(3));
  const double* hidden = StoredPoints::of_row(t, 3);
  ASSERT_NE(hidden, nullptr);
  EXPECT_EQ(hidden[0], 1);
  EXPECT_EQ(hidden[1], 1);
  EXPECT_EQ(hidden[2], -7);
  EXPECT_EQ(StoredPoints::of_row(t, 0)[2], 9);
}

}  // namespace
}  // namespace delone::triangulation
