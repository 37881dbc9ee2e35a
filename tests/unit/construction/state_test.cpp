// SPDX-License-Identifier: BSD-3-Clause
// Vertices that become part of a triangulation one by one: dimensions, frames, and points in one place.
#include "construction/state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace delone::construction {
namespace {

/// Appends a point and places it.
Index placed(State& state, const std::vector<double>& row) {
  return state.place(state.sites.points().append(row.data()), invalid_index);
}

TEST(State, PointsOutsideTheFlatRaiseTheDimension) {
  State state(3, kernel::RowForm::point, {});
  EXPECT_EQ(state.complex().affine_dimension(), -1);
  const std::vector<std::vector<double>> rows{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(placed(state, rows[i]), i + 1);
    EXPECT_EQ(state.affine_hull.dimension(), static_cast<int>(i));
    EXPECT_EQ(state.engine != nullptr, i > 0);
    EXPECT_EQ(state.num_vertices, i + 1);
    const Complex now = state.complex();
    EXPECT_EQ(now.num_finite_cells(), 1u);
    EXPECT_EQ(now.num_infinite_cells(), i + 1);
    for (Index v = 1; v <= i + 1; ++v) EXPECT_GE(now.index_of(state.cell_of(v), VertexId{v}), 0);
  }
  EXPECT_EQ(placed(state, {0, 4, 0}), 3u) << "the vertex that is there";
  EXPECT_EQ(state.num_vertices, 4u);
  EXPECT_FALSE(state.is_visible(5));
}

TEST(State, FramesGrowMoreWhereTheyHadTo) {
  State state(1, kernel::RowForm::point, {});
  placed(state, {0});
  placed(state, {1});
  ASSERT_TRUE(state.engine);
  EXPECT_EQ(frame_of(*state.engine).low(), std::vector<double>{-1});
  EXPECT_EQ(frame_of(*state.engine).high(), std::vector<double>{2});
  placed(state, {2});
  EXPECT_EQ(frame_of(*state.engine).high(), std::vector<double>{2});
  placed(state, {12});  // the box is −1 … 12
  EXPECT_EQ(frame_of(*state.engine).low(), std::vector<double>{-1 - 13.0 / 4});
  EXPECT_EQ(frame_of(*state.engine).high(), std::vector<double>{12 + 13.0});
  EXPECT_EQ(state.num_vertices, 4u);
  const double low = -9, high = 3;
  const geometry::Frame wider = state.frame_with(&low, &high, 0.5);
  EXPECT_EQ(wider.low(), std::vector<double>{-9 - 17.0});
  EXPECT_EQ(wider.high(), std::vector<double>{25 + 17.0 / 4});
}

TEST(State, FramesAreFiniteAtTheEndsOfTheRange) {
  constexpr double largest = std::numeric_limits<double>::max();
  State state(1, kernel::RowForm::weighted_point, {});
  for (const auto& row : std::vector<std::vector<double>>{{-largest, -largest}, {largest, largest}, {0, 0}})
    placed(state, row);
  for (const double x : frame_of(*state.engine).low()) EXPECT_TRUE(std::isfinite(x));
  for (const double x : frame_of(*state.engine).high()) EXPECT_TRUE(std::isfinite(x));
  const double end[] = {largest, -largest};
  EXPECT_TRUE(frame_of(*state.engine).contains(end));
}

TEST(State, InOnePlaceTheHeaviestIsTheVertex) {
  State state(2, kernel::RowForm::weighted_point, {});
  EXPECT_EQ(placed(state, {1, 1, 5}), 1u);
  EXPECT_EQ(placed(state, {1, 1, 4}), invalid_index) << "hidden";
  EXPECT_FALSE(state.is_visible(2));
  EXPECT_EQ(placed(state, {1, 1, 5}), 1u) << "a duplicate";
  EXPECT_EQ(placed(state, {1, 1, 6}), 4u);
  EXPECT_EQ(state.only_vertex(), 4u);
  EXPECT_TRUE(state.is_visible(4));
  EXPECT_FALSE(state.is_visible(1));
  EXPECT_EQ(state.num_vertices, 1u);
  const double lighter[] = {1, 1, 0}, equal[] = {1, 1, 6}, heavier[] = {1, 1, 7};
  EXPECT_EQ(state.compare_with_only_vertex(lighter), -1);
  EXPECT_EQ(state.compare_with_only_vertex(equal), 0);
  EXPECT_EQ(state.compare_with_only_vertex(heavier), 1);
}

TEST(State, HiddenPointsFollowTheCellsThatHideThem) {
  State state(1, kernel::RowForm::weighted_point, {});
  for (const double x : {0.0, 8.0}) placed(state, {x, 0});
  state.hidden_points = std::make_unique<HiddenPoints>();
  EXPECT_EQ(placed(state, {2, -50}), invalid_index);
  EXPECT_EQ(placed(state, {5, -50}), invalid_index);
  EXPECT_EQ(state.hidden_points->size(), 2u);
  EXPECT_EQ(placed(state, {4, -1}), 5u);
  const auto cell_with = [&](Index point) {
    for (const CellId c : state.complex().finite_cells())
      if (state.hidden_points->any_of(index(c), [&](Index hidden) { return hidden == point; })) return c;
    return invalid_cell;
  };
  ASSERT_NE(cell_with(3), invalid_cell);
  ASSERT_NE(cell_with(4), invalid_cell);
  EXPECT_GE(state.complex().index_of(cell_with(3), VertexId{1}), 0);
  EXPECT_GE(state.complex().index_of(cell_with(4), VertexId{2}), 0);
  EXPECT_EQ(placed(state, {4, 3}), 6u);  // hides vertex 5
  EXPECT_EQ(state.hidden_points->size(), 3u);
  EXPECT_NE(cell_with(5), invalid_cell);
  EXPECT_FALSE(state.is_visible(5));
  EXPECT_EQ(state.num_vertices, 3u);
}

TEST(State, ClonesAreIndependent) {
  State state(2, kernel::RowForm::point, {});
  for (const auto& row : std::vector<std::vector<double>>{{0, 0}, {4, 0}, {0, 4}, {1, 1}}) placed(state, row);
  state.add_landmarks(1, 4);
  const auto copy = state.clone();
  ASSERT_TRUE(copy->landmarks);
  const double near[] = {3.9, 0.1};
  EXPECT_GE(copy->complex().index_of(CellId{copy->start_near(near)}, VertexId{2}), 0);
  EXPECT_EQ(placed(*copy, {2, 1}), 5u);
  EXPECT_EQ(copy->num_vertices, 5u);
  EXPECT_EQ(state.num_vertices, 4u);
  EXPECT_EQ(state.sites.points().last_vertex(), 4u);
  State single(2, kernel::RowForm::point, {});
  placed(single, {7, 7});
  EXPECT_EQ(single.clone()->complex().num_all_cells(), 2u);
  EXPECT_EQ(single.clone()->start_near(near), invalid_index) << "no landmarks, no cell to start from";
}

}  // namespace
}  // namespace delone::construction
