// SPDX-License-Identifier: BSD-3-Clause
// Vertices that move little stay where they are in the cells; others do not.
#include "construction/editing.hpp"

#include "editing_support.hpp"

#include <algorithm>

namespace delone::construction {
namespace {

/// The coordinates of rows, each moved by a step that depends on its number.
Rows stepped(const Triangulation& t, const RowList& rows, double step) {
  Rows to;
  for (const std::size_t row : rows) {
    const auto point = t.point(t.vertex_at(row));
    for (std::size_t j = 0; j < point.size(); ++j)
      to.push_back(point[j] + ((row + j) % 3 == 0 ? -step : step));
  }
  return to;
}

Delaunay<> recorded(Rows points, int dimension) {
  Delaunay<> t(std::move(points), dimension);
  t.record_changes();
  t.record_undo();
  return t;
}

TEST(EditMoves, FewSmallStepsChangeNoCell) {
  Delaunay<> t = recorded(make_point_set("uniform", 3, 300, 1), 3);
  const CanonicalHash hash = t.hash();
  const RowList rows = rows_from(20, 24);
  t.move(rows, stepped(t, rows, 1e-12));
  EXPECT_TRUE(t.changes().removed_cells.empty());
  EXPECT_EQ(t.changes().moved_vertices.size(), 4u);
  expect_as_at_once(t);
  t.undo();
  EXPECT_EQ(t.hash(), hash);
  expect_as_at_once(t);
}

TEST(EditMoves, ManyVerticesMoveAtOnceUnlessStepsAreLong) {
  for (const double step : {1e-9, 3e-4, 0.3}) {
    Delaunay<> t = recorded(make_point_set("uniform", 2, 400, 1), 2);
    const CanonicalHash hash = t.hash();
    const Index before = t.num_all_cells();
    const RowList rows = rows_from(0, 400);
    t.move(rows, stepped(t, rows, step));
    EXPECT_EQ(has_rebuilt(t, before), step > 0.1) << step;
    EXPECT_EQ(t.changes().removed_cells.empty(), step < 1e-6) << step;
    EXPECT_EQ(t.changes().moved_vertices.size(), 400u);
    expect_as_at_once(t);
    t.undo();
    EXPECT_EQ(t.hash(), hash);
    expect_as_at_once(t);
  }
}

TEST(EditMoves, TheFrameGrowsWithAStepOutOfIt) {
  Delaunay<> t = recorded(make_point_set("uniform", 2, 400, 1), 2);
  const RowList rows = rows_from(0, 400);
  Rows to = stepped(t, rows, 1e-9);
  to[0] = 1e6;
  to[3] = -1e6;
  t.move(rows, to);
  expect_as_at_once(t);
  t.undo();
  expect_as_at_once(t);
  t.insert({1e5, 1e5});  // the frame of before again
  expect_as_at_once(t);
  t.move(5, {-1e9, 4});  // one alone
  expect_as_at_once(t);
}

TEST(EditMoves, OutOfTheFlatTheDimensionChanges) {
  Rows plane = make_point_set("uniform", 2, 100, 3), points;
  for (std::size_t i = 0; i < plane.size(); i += 2)
    points.insert(points.end(), {plane[i], plane[i + 1], 0.5});
  Delaunay<> t = recorded(points, 3);
  const RowList rows = rows_from(0, 100);
  Rows to = stepped(t, rows, 1e-9);
  for (std::size_t row = 0; row < 100; ++row) to[3 * row + 2] = row == 7 ? 0.5 + 1e-9 : 0.5;
  t.move(rows, to);
  EXPECT_EQ(t.affine_dimension(), 3);
  expect_as_at_once(t);
  t.undo();
  EXPECT_EQ(t.affine_dimension(), 2);
  t.move(7, std::span(to).subspan(21, 3));  // one alone
  EXPECT_EQ(t.affine_dimension(), 3);
  expect_as_at_once(t);
  t.move(7, std::span(points).subspan(21, 3));
  EXPECT_EQ(t.affine_dimension(), 2);
  expect_as_at_once(t);
}

/// A net of 100 points without weight, and one with.
struct Net {
  Rows points, weights;
  Net(double x, double y, double weight) : weights(100, 0.0) {
    for (int i = 0; i < 100; ++i) points.insert(points.end(), {i % 10 * 1.0, i / 10 * 1.0});
    points.insert(points.end(), {x, y});
    weights.push_back(weight);
  }
};

TEST(EditMoves, ToThePointOfAHiddenOneThatOneKeepsItsVertex) {
  // It is hidden in its square, and not in the hole that is left without a corner of that.
  const Net net(4.5, 4.25, -0.5);
  Regular<> t(net.points, net.weights, 2);
  t.record_changes();
  t.record_undo();
  ASSERT_EQ(t.hidden_rows(), RowList{100});
  t.set_weight(99, 0.125);  // now the hidden point has its place in a list
  const VertexId moved = t.vertex_at(44);
  const RowList row{44};
  t.edit({.move = row, .to = Rows{4.5, 4.25}, .reweight = row, .weights = Rows{-0.5}});
  EXPECT_EQ(t.hidden_rows(), RowList{}) << "nothing hides it any more";
  EXPECT_EQ(t.vertex_at(44), t.vertex_at(100));
  EXPECT_NE(t.vertex_at(100), moved);
  EXPECT_EQ(t.changes().removed_vertices, std::vector<VertexId>{moved});
  t.undo();
  EXPECT_EQ(t.vertex_at(44), moved);
  EXPECT_TRUE(t.is_hidden(100));
}

TEST(EditMoves, HiddenPointsComeBackAsTheirCellsChange) {
  for (const std::size_t num_moved : {1u, 100u}) {  // one step, and all at once
    // Hidden by the circle of its square, 3/8; visible as a corner moves away, 39/80.
    Net net(4.25, 4.25, -0.4375);
    Regular<> t(net.points, net.weights, 2);
    ASSERT_TRUE(t.is_hidden(100));
    t.record_changes();
    const RowList rows = num_moved == 1 ? RowList{44} : rows_from(0, 100);
    Rows to;
    for (const std::size_t row : rows)
      for (std::size_t j = 0; j < 2; ++j)
        to.push_back(net.points[2 * row + j] =
                         row == 44 ? 3.875
                                   : net.points[2 * row + j] + 1e-9 * static_cast<double>((row + j) % 7));
    t.move(rows, to);
    const Regular<> at_once(net.points, net.weights, 2);
    EXPECT_EQ(t.hash(), at_once.hash());
    EXPECT_EQ(t.hidden_rows(), at_once.hidden_rows());
    EXPECT_FALSE(t.is_hidden(100));
    EXPECT_EQ(t.changes().reappeared_vertices, std::vector<VertexId>{t.vertex_at(100)});
  }
}

}  // namespace
}  // namespace delone::construction
