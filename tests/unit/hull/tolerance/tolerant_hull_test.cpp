// SPDX-License-Identifier: BSD-3-Clause
#include "hull/tolerance/tolerant_hull.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace delone::hull {
using internal::AxisScale;

namespace {

HullState state_of(int d, const std::vector<double>& points) {
  HullState state(d);
  state.insert_range(points, {});
  return state;
}

TEST(TolerantHull, IsTheExactOneIfAllVerticesAreKept) {
  const HullState exact = state_of(2, {0, 0, 1, 0, 0, 1, 1, 1});
  const TolerantHull hull(exact, AxisScale(0.1), {}, false);
  EXPECT_EQ(&hull.state(), &exact);
  EXPECT_EQ(hull.max_distance(), 0);
}

TEST(TolerantHull, HasNoCornersThatAreNotExtreme) {
  const HullState exact = state_of(2, {0, 0, 1, 0, 2, 0, 2, 2, 1, 2, 0, 2});
  EXPECT_GT(exact.hull().num_cells(), 4u);
  EXPECT_EQ(TolerantHull(exact, AxisScale(0.01), {}, false).state().hull().num_cells(), 4u);
}

TEST(TolerantHull, HasAllRowsButFewerVertices) {
  const HullState exact = state_of(2, {0, 0, 1, -0.0625, 2, 0, 2, 2, 0, 2, 1, 1, 0, 0});
  const TolerantHull hull(exact, AxisScale(0.0625), {}, false);
  EXPECT_EQ(hull.state().num_rows(), 7u);
  EXPECT_EQ(hull.state().hull().num_cells(), 4u);
  EXPECT_EQ(hull.max_distance(), 0.0625);
  EXPECT_TRUE(hull.state().is_surely_interior(5));
  EXPECT_FALSE(hull.state().is_surely_interior(1));
}

TEST(TolerantHull, OfOnePointAndOfNone) {
  const HullState none(2), one = state_of(2, {1, 1});
  EXPECT_EQ(&TolerantHull(none, AxisScale(1), {}, false).state(), &none);
  EXPECT_EQ(&TolerantHull(one, AxisScale(1), {}, false).state(), &one);
}

TEST(TolerantHull, MeasuresWhereAxesAreScaled) {
  // The middle of the lower side is out by 1/16 of the height.
  const HullState exact = state_of(2, {0, 0, 1024, -0.0625, 2048, 0, 2048, 1, 0, 1});
  EXPECT_EQ(TolerantHull(exact, AxisScale(0.0625), {}, false).state().hull().num_cells(), 4u);
  for (const double across : {0.0625, 0.06}) {
    const TolerantHull hull(exact, AxisScale(0, std::vector<double>{64, across}, 2), {}, false);
    EXPECT_EQ(hull.state().hull().num_cells(), across < 0.0625 ? 5u : 4u);
    EXPECT_EQ(hull.max_distance(), across < 0.0625 ? 0 : 64);  // along the axis of the largest tolerance
  }
}

TEST(TolerantHull, CanBeCancelled) {
  std::vector<double> circle;
  for (int i = 0; i < 400; ++i) circle.insert(circle.end(), {i * (400.0 - i), 1.0 * i});
  const HullState exact = state_of(2, circle);
  const Options options{.progress = [](double) { return false; }};
  EXPECT_THROW(TolerantHull(exact, AxisScale(0.5), options, true), Error);
  EXPECT_NO_THROW(TolerantHull(exact, AxisScale(0.5), options, false));
}

}  // namespace
}  // namespace delone::hull
