// SPDX-License-Identifier: BSD-3-Clause
#include "base/require_dimension.hpp"

#include <delone/convex_hull.hpp>
#include <delone/delaunay.hpp>
#include <delone/halfspaces.hpp>
#include <delone/lower_hull.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace delone::internal {
namespace {

void expect_refused(const std::function<void()>& work, const char* number) {
  try {
    work();
    FAIL() << number;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::bad_dimension);
    EXPECT_NE(std::string(error.what()).find(number), std::string::npos) << error.what();
  }
}

TEST(RequireDimension, BetweenOneAndTheLargest) {
  require_dimension(1);
  require_dimension(largest_dimension);
  for (const int none : {0, -1, -2'000'000'000})
    expect_refused([&] { require_dimension(none); }, "at least 1");
  expect_refused([] { require_dimension(largest_dimension + 1); }, "1048577");
}

TEST(RequireDimension, ProductsRefuseItAtOnce) {
  const std::vector<double> none;
  expect_refused([] { Delaunay<> triangulation(2'000'000'000); }, "2000000000");
  expect_refused([] { ConvexHull<> hull(2'000'000'000); }, "2000000000");
  expect_refused([&] { HalfspaceIntersection<> intersection(none, 2'000'000'000); }, "2000000000");
  expect_refused([&] { LowerHull<> hull(none, 2'000'000'000, HullSide::lower); }, "2000000000");
}

TEST(RequireDimension, TheLargestIsPossible) {
  Delaunay<> triangulation(largest_dimension);
  EXPECT_EQ(triangulation.dimension(), largest_dimension);
}

}  // namespace
}  // namespace delone::internal
