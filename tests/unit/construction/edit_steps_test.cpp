// SPDX-License-Identifier: BSD-3-Clause
// Vertices that are taken out and placed one by one: down all dimensions, among hidden points, and in an
// order.
#include "construction/editing.hpp"

#include "degenerate.hpp"
#include "editing_support.hpp"

#include <algorithm>

namespace delone::construction {
namespace {

TEST(EditSteps, TheDimensionFallsToNothingAndRisesAgain) {
  for (int d = 1; d <= 4; ++d) {
    // Two points on each axis, and two more on the first.
    Rows points;
    for (int i = 0; i <= d; ++i)
      for (const double height : {4.0, 6.0})
        for (int j = 1; j <= d; ++j) points.push_back(i == j ? height : i == 0 && j == 1 ? height - 4 : 0);
    Delaunay<> t(points, d);
    t.record_changes();
    t.record_undo();
    ASSERT_EQ(t.affine_dimension(), d);
    std::vector<CanonicalHash> hashes;
    for (std::size_t row = t.num_rows(); row-- > 0;) {
      const CanonicalHash before = t.hash();
      hashes.push_back(before);
      t.remove(row);
      if (t.num_points() > 0) expect_as_at_once(t);
      t.undo();
      ASSERT_EQ(t.hash(), before) << row;
      t.remove(row);
    }
    EXPECT_EQ(t.affine_dimension(), -1);
    EXPECT_EQ(t.num_vertices(), 0u);
    EXPECT_EQ(t.num_all_cells(), 0u);
    for (std::size_t i = 0; i < points.size(); i += static_cast<std::size_t>(d)) {
      t.insert(std::span(points).subspan(i, static_cast<std::size_t>(d)));
      EXPECT_EQ(t.hash(), hashes[hashes.size() - 1 - i / static_cast<std::size_t>(d)]);
    }
  }
}

TEST(EditSteps, BelowAnApexCellsAreOriented) {
  // Both orientations of the plane below: the apex is above it, or beneath.
  for (const double height : {3.0, -3.0})
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      Rows points;
      for (const auto x = test::small_integers(2, 12, -5, 5, seed); const std::size_t row : rows_from(0, 12))
        points.insert(points.end(), {x.points[2 * row], x.points[2 * row + 1], 0});
      points.insert(points.end(), {0.5, 0.25, height});
      Delaunay<> t(points, 3);
      t.record_undo();
      ASSERT_EQ(t.affine_dimension(), 3);
      const CanonicalHash before = t.hash();
      t.remove(12);
      EXPECT_EQ(t.affine_dimension(), 2);
      expect_as_at_once(t);
      t.undo();
      EXPECT_EQ(t.hash(), before);
      t.remove(12);
      t.insert({1, 2, height});
      expect_as_at_once(t);
    }
}

TEST(EditSteps, HiddenPointsAreSetFreeAsTheDimensionFalls) {
  // On the line y = 0 the light point is hidden between those beside it, with the apex or without.
  Regular<> t(Rows{0, 0, 2, 0, 1, 0, 1, 5}, Rows{4, 4, 0, 0}, 2);
  t.record_changes();
  t.record_undo();
  ASSERT_EQ(t.hidden_rows(), RowList{2});
  t.remove(3);
  EXPECT_EQ(t.affine_dimension(), 1);
  EXPECT_EQ(t.hidden_rows(), RowList{2});
  t.remove(0);  // now it is an end
  EXPECT_TRUE(t.hidden_rows().empty());
  EXPECT_EQ(t.hash(), Regular<>(Rows{2, 0, 1, 0}, Rows{4, 0}, 2).hash());
  EXPECT_EQ(t.changes().reappeared_vertices, std::vector<VertexId>{t.vertex_at(2)});
  t.undo();
  EXPECT_EQ(t.hidden_rows(), RowList{2});
}

TEST(EditSteps, InOnePlaceTheNextHeaviestFollows) {
  Regular<> t(2);
  t.record_changes();
  t.record_undo();
  for (const double weight : {1.0, 3.0, 2.0, 3.0}) t.insert({5, 5}, weight);
  EXPECT_EQ(t.hidden_rows(), (RowList{0, 2}));
  const VertexId heaviest = t.vertex_at(1);
  EXPECT_EQ(t.vertex_at(3), heaviest) << "a duplicate, as it has the same weight";
  t.remove(1);
  EXPECT_EQ(t.vertex_at(3), heaviest);
  t.remove(3);
  EXPECT_EQ(t.hidden_rows(), RowList{0});
  EXPECT_EQ(t.changes().removed_vertices, std::vector<VertexId>{heaviest});
  EXPECT_EQ(t.changes().reappeared_vertices, std::vector<VertexId>{t.vertex_at(2)});
  t.undo();
  EXPECT_EQ(t.vertex_at(3), heaviest);
  t.move(3, {6, 5});  // away: then there is a line, on which the next one is a vertex
  EXPECT_EQ(t.affine_dimension(), 1);
  EXPECT_EQ(t.vertex_at(3), heaviest);
  EXPECT_EQ(t.num_hidden(), 1u);
}

TEST(EditSteps, PointsToInsertAreOrderedWithoutOtherRows) {
  for (const std::size_t num_inserted : {31u, 32u, 80u}) {
    Delaunay<> t(make_point_set("uniform", 2, 1000, 1), 2);
    t.record_changes();
    const RowList removed{3, 5};
    const Rows inserted = make_point_set("uniform", 2, num_inserted, 2);
    const Index before = t.num_all_cells();
    t.edit({.remove = removed, .insert = inserted});
    EXPECT_FALSE(has_rebuilt(t, before));
    ASSERT_EQ(t.num_rows(), 1000 + num_inserted);
    for (std::size_t i = 0; i < num_inserted; ++i) {
      const auto point = t.point(t.vertex_at(1000 + i));
      EXPECT_TRUE(
          std::equal(point.begin(), point.end(), inserted.begin() + static_cast<std::ptrdiff_t>(2 * i)));
    }
    expect_as_at_once(t);
  }
}

TEST(EditSteps, AfterALongMoveThePlaceIsFoundFromLandmarks) {
  Delaunay<> t(make_point_set("uniform", 2, 3000, 1), 2);
  const std::uint64_t before = t.statistics().visited_cells;
  RowList rows;
  Rows to;
  for (std::size_t row = 0; row < 50; ++row) {
    rows.push_back(row);
    const auto point = t.point(t.vertex_at(row));
    to.insert(to.end(), {1 - point[0], 1 - point[1]});  // to the other side
  }
  t.move(rows, to);
  expect_as_at_once(t);
  EXPECT_LT(t.statistics().visited_cells - before, 50u * 20) << "a walk across would meet some 50 cells";
}

}  // namespace
}  // namespace delone::construction
