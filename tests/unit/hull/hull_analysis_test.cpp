// SPDX-License-Identifier: BSD-3-Clause
#include "hull/hull_analysis.hpp"

#include "hull_support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>
#include <vector>

namespace delone::hull {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using enum PointKind;

HullState state_of(int d, const std::vector<double>& points) {
  HullState state(d);
  state.insert_range(points, {});
  return state;
}

TEST(Lazy, MakesItsValueOnceAndTriesAgainAfterAnException) {
  const Lazy<int> lazy;
  int calls = 0;
  const auto make = [&] {
    if (++calls == 1) throw std::runtime_error("not yet");
    return calls;
  };
  EXPECT_THROW(lazy.get(make), std::runtime_error);
  EXPECT_EQ(lazy.get(make), 2);
  EXPECT_EQ(lazy.get(make), 2);
}

// A square with the middle of an edge, its own middle, a point close to an edge, and duplicates of each kind.
TEST(HullAnalysis, TellsKindsOfPoints) {
  const double below = 2 - 0x1p-51;
  const HullState state = state_of(2, {0, 0, 2, 0, 1, 0, 2, 2, 1, 1, 0, 2, 0, 0, 1, 0, 1, 1, 1, below, 1, 2});
  const HullAnalysis hull(state);
  EXPECT_THAT(hull.kinds(), ElementsAre(extreme, extreme, boundary, extreme, interior, extreme, duplicate,
                                        duplicate, duplicate, interior, boundary));
  EXPECT_EQ(hull.count(extreme), 4u);
  EXPECT_EQ(hull.count(boundary), 2u);
  EXPECT_EQ(hull.count(interior), 2u);
  EXPECT_EQ(hull.count(duplicate), 3u);
  EXPECT_EQ(hull.num_ridges(), 4u);
  const HullData& data = hull.data();
  EXPECT_THAT(data.vertices, ElementsAre(0, 1, 3, 5));
  EXPECT_THAT(data.vertex_of_point, ElementsAre(0, 1, 2, 3, 4, 5, 0, 2, 4, 9, 10));
  EXPECT_EQ(data.num_facets(), 4u);
  EXPECT_EQ(&data, &hull.data());
}

// Of sets of each affine dimension, with duplicates, and points on edges and inside.
TEST(HullAnalysis, CellsHaveTheExtremePointsAsVertices) {
  const std::vector<std::pair<int, std::vector<double>>> sets{
      {2, {0, 0, 2, 0, 1, 0, 2, 2, 1, 1, 0, 2, 0, 0}},
      {3, test::lattice(3, 3).points},
      {2, {1, 1, 3, 3, 2, 2, 0, 0, 3, 3}},
      {3, {0, 0, 1, 2, 0, 1, 0, 2, 1, 2, 2, 1, 1, 1, 1}},
      {2, {5, 5, 5, 5}},
      {2, {}}};
  for (const auto& [d, points] : sets) {
    const HullState state = state_of(d, points);
    const HullAnalysis hull(state);
    const HullCells cells = hull.cells();
    std::vector<SignedIndex> rows;
    for (std::size_t row = 0; row < hull.kinds().size(); ++row)
      if (hull.kinds()[row] == extreme) rows.push_back(static_cast<SignedIndex>(row));
    EXPECT_EQ(cells.vertices, rows);
    EXPECT_EQ(cells.cells, hull.data().cells);
    EXPECT_EQ(cells.neighbors, hull.data().neighbors);
    EXPECT_EQ(cells.affine_dimension, hull.data().affine_dimension);
    EXPECT_EQ(cells.num_cells(), state.hull().num_cells());
  }
}

// They need no facets, which with this tolerance have vertices of their own that are joined.
TEST(HullAnalysis, CellsWithATolerance) {
  const HullState state = state_of(3, {0, 0, 0, 4, 0, 0, 0, 4, 0, 4, 4, 0.25, 2, 2, 3});
  const HullAnalysis hull(state, {internal::AxisScale(0.5), 0.25});
  EXPECT_LT(hull.faces().num_facets(), state.hull().num_cells());
  EXPECT_THAT(hull.cells().vertices, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(hull.cells().vertices, hull.data().vertices);
  EXPECT_EQ(hull.num_extreme(), hull.count(extreme));
}

TEST(HullAnalysis, OfALatticeCube) {
  const HullState state = state_of(3, test::lattice(3, 3).points);
  const HullAnalysis hull(state);
  EXPECT_EQ(hull.count(extreme), 8u);
  EXPECT_EQ(hull.count(boundary), 18u);
  EXPECT_EQ(hull.count(interior), 1u);
  EXPECT_EQ(hull.num_ridges(), 12u);
  EXPECT_EQ(hull.faces().num_facets(), 6u);
  EXPECT_THAT(count_faces(hull.facet_sites(), 3), ElementsAre(8, 12, 6));
}

TEST(HullAnalysis, OfASegment) {
  const HullState state = state_of(2, {1, 1, 3, 3, 2, 2, 0, 0, 3, 3});
  const HullAnalysis hull(state);
  EXPECT_THAT(hull.kinds(), ElementsAre(interior, extreme, interior, extreme, duplicate));
  EXPECT_TRUE(hull.locator().has_value());
  EXPECT_EQ(hull.data().num_facets(), 2u);
}

TEST(HullAnalysis, OfOnePointAndOfNone) {
  const HullState point = state_of(2, {1, 1, 1, 1});
  const HullAnalysis one(point);
  EXPECT_FALSE(one.locator().has_value());
  EXPECT_THAT(one.kinds(), ElementsAre(extreme, duplicate));
  EXPECT_THAT(one.data().vertices, ElementsAre(0));
  EXPECT_EQ(one.data().affine_dimension, 0);
  const HullState empty(2);
  const HullAnalysis none(empty);
  EXPECT_THAT(none.kinds(), IsEmpty());
  EXPECT_EQ(none.count(extreme), 0u);
  EXPECT_EQ(none.data().affine_dimension, -1);
}

}  // namespace
}  // namespace delone::hull
