// SPDX-License-Identifier: BSD-3-Clause
// Edits that rebuild everything: who keeps its vertex where points become equal, and nothing left.
#include "construction/editing.hpp"

#include "editing_support.hpp"

#include <algorithm>

namespace delone::construction {
namespace {

constexpr std::size_t n = 40;

/// The lower the row, the older its vertex.
Delaunay<> to_rebuild() {
  Options options;
  options.order = InsertionOrder::as_given;
  Delaunay<> t(make_point_set("uniform", 2, n, 1), 2, options);
  t.record_changes();
  t.record_undo();
  return t;
}

Rows point_at(const Triangulation& t, std::size_t row) {
  const auto point = t.point(t.vertex_at(row));
  return {point.begin(), point.end()};
}

TEST(Rebuild, AnUntouchedVertexKeepsItsId) {
  Delaunay<> t = to_rebuild();
  const Index before = t.num_all_cells();
  const VertexId moving = t.vertex_at(0), untouched = t.vertex_at(9), other = t.vertex_at(10);
  const Rows there = point_at(t, 9);
  Rows inserted = there;  // a new row there, too
  inserted.insert(inserted.end(), {0.5, 0.5});
  const RowList moved{0}, removed = rows_from(20, n);
  t.edit({.remove = removed, .move = moved, .to = there, .insert = inserted});
  ASSERT_TRUE(has_rebuilt(t, before));
  for (const std::size_t row : {std::size_t{0}, std::size_t{9}, n}) EXPECT_EQ(t.vertex_at(row), untouched);
  EXPECT_EQ(t.row_of(untouched), 0u);
  EXPECT_EQ(t.vertex_at(10), other);
  EXPECT_TRUE(
      std::binary_search(t.changes().removed_vertices.begin(), t.changes().removed_vertices.end(), moving));
  EXPECT_EQ(t.num_duplicates(), 2u);
  expect_as_at_once(t);
  t.undo();
  EXPECT_EQ(t.vertex_at(0), moving);
  EXPECT_EQ(t.row_of(untouched), 9u);
}

TEST(Rebuild, OfThoseThatMeetElsewhereTheOldestKeepsItsId) {
  Delaunay<> t = to_rebuild();
  const Index before = t.num_all_cells();
  const RowList moved{7, 3, 5}, removed = rows_from(20, n);
  const VertexId oldest = std::min({t.vertex_at(3), t.vertex_at(5), t.vertex_at(7)});
  const Rows together{0.5, 0.25, 0.5, 0.25, 0.5, 0.25}, inserted{0.5, 0.25, -0.0, 2, 0.0, 2};
  t.edit({.remove = removed, .move = moved, .to = together, .insert = inserted});
  ASSERT_TRUE(has_rebuilt(t, before));
  for (const std::size_t row : {std::size_t{3}, std::size_t{5}, std::size_t{7}, n})
    EXPECT_EQ(t.vertex_at(row), oldest);
  EXPECT_EQ(t.vertex_at(n + 1), t.vertex_at(n + 2)) << "zeros of either sign are equal";
  EXPECT_EQ(t.changes().added_vertices, std::vector<VertexId>{t.vertex_at(n + 1)});
  EXPECT_EQ(t.changes().moved_vertices, std::vector<VertexId>{oldest});
  expect_as_at_once(t);
}

TEST(Rebuild, OfFlatsAndOfNothing) {
  Delaunay<> t = to_rebuild();
  const CanonicalHash hash = t.hash();
  const RowList all = rows_from(0, n);
  t.move(all, Rows(2 * n, 0.75));
  EXPECT_EQ(t.affine_dimension(), 0);
  EXPECT_EQ(t.num_vertices(), 1u);
  EXPECT_EQ(t.num_duplicates(), n - 1);
  expect_as_at_once(t);
  t.undo();
  EXPECT_EQ(t.hash(), hash);
  Rows line;
  for (std::size_t row = 0; row < n; ++row) line.insert(line.end(), {1.0 * static_cast<double>(row % 30), 1});
  t.move(all, line);
  EXPECT_EQ(t.affine_dimension(), 1);
  EXPECT_EQ(t.num_vertices(), 30u);
  expect_as_at_once(t);
  t.undo();
  t.remove(all);
  EXPECT_EQ(t.affine_dimension(), -1);
  EXPECT_EQ(t.num_vertices(), 0u);
  EXPECT_EQ(t.num_rows(), n);
  EXPECT_FALSE(t.has_row(0));
  t.undo();
  EXPECT_EQ(t.hash(), hash);
  t.remove(all);
  t.insert_range(make_point_set("uniform", 2, n, 1));
  EXPECT_EQ(t.hash(), hash);
  EXPECT_EQ(t.num_rows(), 2 * n);
}

TEST(Rebuild, TellsWhoIsHiddenThen) {
  Rows points = make_point_set("uniform", 2, n, 1);
  Regular<> t(points, Rows(n, 0.0), 2);
  t.record_changes();
  ASSERT_EQ(t.num_hidden(), 0u);
  const Index before = t.num_all_cells();
  const RowList heavy = rows_from(20, n);
  const Rows weights(20, 0.02);
  std::vector<VertexId> vertices;
  for (std::size_t row = 0; row < n; ++row) vertices.push_back(t.vertex_at(row));
  t.set_weights(heavy, weights);
  ASSERT_TRUE(has_rebuilt(t, before));
  std::vector<VertexId> hidden;
  for (const std::size_t row : t.hidden_rows()) hidden.push_back(vertices[row]);
  std::sort(hidden.begin(), hidden.end());
  EXPECT_FALSE(hidden.empty());
  EXPECT_EQ(t.changes().hidden_vertices, hidden);
  t.set_weights(heavy, Rows(20, 0.0));
  EXPECT_EQ(t.changes().reappeared_vertices, hidden);
}

}  // namespace
}  // namespace delone::construction
