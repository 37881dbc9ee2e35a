// SPDX-License-Identifier: BSD-3-Clause
// What an edit does to rows and vertices, and whether it takes steps or rebuilds everything.
#include "construction/editing.hpp"

#include "editing_support.hpp"
#include "error_code.hpp"

#include <algorithm>

namespace delone::construction {
namespace {

/// Points in the plane from left to right, with a record.
Delaunay<> sorted_by_x(std::size_t n) {
  Rows x = make_point_set("uniform", 1, n, 1), y = make_point_set("uniform", 1, n, 2), points;
  std::sort(x.begin(), x.end());
  for (std::size_t i = 0; i < n; ++i) points.insert(points.end(), {x[i], y[i]});
  Delaunay<> t(points, 2);
  t.record_changes();
  t.record_undo();
  return t;
}

TEST(Editing, FewChangesAreStepsWhateverTheirShare) {
  for (const std::size_t num_removed : {15u, 16u}) {
    Delaunay<> t = sorted_by_x(40);
    const Index before = t.num_all_cells();
    const CanonicalHash hash = t.hash();
    t.remove(rows_from(0, num_removed));
    EXPECT_EQ(has_rebuilt(t, before), num_removed == 16) << num_removed;
    EXPECT_EQ(t.changes().removed_vertices.size(), num_removed);
    expect_as_at_once(t);
    t.undo();
    EXPECT_EQ(t.hash(), hash);
  }
}

TEST(Editing, ManyChangesRebuildWhereTheyCostMore) {
  // 2·removed > left/2 for the first number that rebuilds: 2·81 > (400 − 81)/2.
  for (const std::size_t num_removed : {79u, 81u}) {
    Delaunay<> t = sorted_by_x(400);
    const Index before = t.num_all_cells();
    t.remove(rows_from(0, num_removed));
    EXPECT_EQ(has_rebuilt(t, before), num_removed == 81) << num_removed;
    expect_as_at_once(t);
  }
  // Insertions count once: 201 > (200 + 201)/2.
  for (const std::size_t num_inserted : {199u, 201u}) {
    Delaunay<> t = sorted_by_x(200);
    const Index before = t.num_all_cells();
    Rows points = make_point_set("uniform", 2, num_inserted, 5);
    for (std::size_t i = 0; i < points.size(); i += 2) points[i] += 2;
    t.edit({.insert = points});
    EXPECT_EQ(has_rebuilt(t, before), num_inserted == 201) << num_inserted;
    expect_as_at_once(t);
  }
}

TEST(Editing, RowsThatShareAVertexLeaveItBehind) {
  Delaunay<> t(Rows{0, 0, 4, 0, 0, 4, 4, 0, 1, 1}, 2);
  t.record_changes();
  const VertexId shared = t.vertex_at(1);
  ASSERT_EQ(t.vertex_at(3), shared);
  t.move(1, {3, 3});
  EXPECT_EQ(t.vertex_at(3), shared);
  EXPECT_EQ(t.row_of(shared), 3u);
  EXPECT_EQ(t.changes().added_vertices, std::vector<VertexId>{t.vertex_at(1)});
  EXPECT_TRUE(t.changes().moved_vertices.empty());
  const VertexId alone = t.vertex_at(1);
  t.move(1, {4, 0});  // back to the others: its vertex goes
  EXPECT_EQ(t.vertex_at(1), shared);
  EXPECT_EQ(t.row_of(shared), 1u);
  EXPECT_EQ(t.changes().removed_vertices, std::vector<VertexId>{alone});
  t.move(1, {4, 0});
  EXPECT_TRUE(t.changes().removed_cells.empty() && t.changes().added_vertices.empty());
  t.remove(3);
  EXPECT_EQ(t.vertex_at(1), shared);
  EXPECT_TRUE(t.changes().removed_vertices.empty()) << "a row is left";
  expect_as_at_once(t);
}

TEST(Editing, ARowMayGetAPointAndAWeightAtOnce) {
  Regular<> t(Rows{0, 0, 8, 0, 0, 8, 8, 8, 3, 3}, Rows{0, 0, 0, 0, 0}, 2);
  t.record_changes();
  const RowList move{4, 0}, reweight{3, 4};
  t.edit({.move = move, .to = Rows{4, 3, 0, 0}, .reweight = reweight, .weights = Rows{2, 1}});
  EXPECT_EQ(t.weight(t.vertex_at(4)), 1);
  EXPECT_EQ(t.weight(t.vertex_at(3)), 2);
  EXPECT_EQ(t.point(t.vertex_at(4))[0], 4);
  EXPECT_EQ(t.changes().moved_vertices, (std::vector<VertexId>{t.vertex_at(3), t.vertex_at(4)}))
      << "row 0 has moved to where it was";
  EXPECT_EQ(t.hash(), Regular<>(Rows{0, 0, 8, 0, 0, 8, 8, 8, 4, 3}, Rows{0, 0, 0, 2, 1}, 2).hash());
  t.set_weight(3, 2);
  EXPECT_TRUE(t.changes().moved_vertices.empty());
}

TEST(Editing, AllListsAtOnceAndBack) {
  for (const std::size_t n : {30u, 300u}) {  // a rebuild, and steps
    Delaunay<> t = sorted_by_x(n);
    const CanonicalHash hash = t.hash();
    const Index before = t.num_all_cells();
    const RowList remove = rows_from(0, 8), move = rows_from(10, 16);
    const Rows inserted = make_point_set("uniform", 2, 9, 7);
    t.edit({.remove = remove, .move = move, .to = make_point_set("uniform", 2, 6, 8), .insert = inserted});
    EXPECT_EQ(has_rebuilt(t, before), n == 30);
    EXPECT_EQ(t.num_rows(), n + 9);
    EXPECT_EQ(t.changes().added_vertices.size(), 9u);
    EXPECT_EQ(t.changes().moved_vertices.size(), 6u);
    expect_as_at_once(t);
    t.undo();
    EXPECT_EQ(t.hash(), hash);
    EXPECT_EQ(t.num_rows(), n);
  }
}

TEST(Editing, CanBeCancelledAtAnyCallAndChangesNothing) {
  // The whole is rebuilt, or every eighth row moves in steps.
  for (const bool rebuilds : {true, false}) {
    int calls = 0, last_call = 0;
    double fraction = 0;
    Options options;
    options.progress = [&](double done) {
      EXPECT_GE(done, fraction);
      EXPECT_LE(done, 1);
      fraction = done;
      return ++calls != last_call;
    };
    Delaunay<> t(3, options);
    const std::size_t n = 12000;
    t.insert_range(make_point_set("uniform", 3, n, 1));
    const CanonicalHash hash = t.hash();
    const Rows to = make_point_set("uniform", 3, n, 2);
    const RowList moved = rows_from(0, rebuilds ? n : n / 8);
    for (last_call = 1; last_call <= 2; ++last_call) {
      calls = 0;
      fraction = 0;
      EXPECT_EQ(test::code_of([&] { t.move(moved, std::span(to).first(3 * moved.size())); }),
                Errc::cancelled);
      EXPECT_EQ(t.hash(), hash);
    }
    calls = last_call = 0;
    fraction = 0;
    t.move(moved, std::span(to).first(3 * moved.size()));
    EXPECT_NE(t.hash(), hash);
  }
}

}  // namespace
}  // namespace delone::construction
