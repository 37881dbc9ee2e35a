// SPDX-License-Identifier: BSD-3-Clause
// One transaction under batches and edits: what it does is the same on record and off it, whole or not at
// all.
#include "construction/construction.hpp"

#include "base/compiled_dimension.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace delone {
namespace {

std::vector<double> uniform(int d, std::size_t n, std::uint64_t seed) {
  return make_point_set("uniform", d, n, seed);
}

// Few points in 7 dimensions are wrapped: each cell is created once.
TEST(Construction, RebuildsAsANewObjectIsBuilt) {
  if (internal::largest_compiled_dimension < 7) GTEST_SKIP() << "7 dimensions are not compiled";
  constexpr std::size_t n = 220;
  Delaunay<7> t(uniform(7, n, 1));
  ASSERT_EQ(t.statistics().created_cells, t.num_all_cells());
  const std::uint64_t before = t.statistics().created_cells;
  std::vector<std::size_t> rows(n);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const std::vector<double> to = uniform(7, n, 2);
  t.edit({.move = rows, .to = to});
  EXPECT_EQ(t.statistics().created_cells - before, t.num_all_cells());
  EXPECT_EQ(t.hash(), Delaunay<7>(to).hash());
}

TEST(Construction, WrapsTheVerticesThatAreLeft) {
  if (internal::largest_compiled_dimension < 7) GTEST_SKIP() << "7 dimensions are not compiled";
  constexpr std::size_t n = 400;
  const std::vector<double> points = uniform(7, n, 3);
  Delaunay<7> t(points);
  std::vector<std::size_t> gone, kept;
  for (std::size_t row = 0; row < n; ++row) (row % 5 < 2 ? gone : kept).push_back(row);
  std::vector<double> left, copies;
  for (const std::size_t row : kept)
    left.insert(left.end(), points.begin() + 7 * row, points.begin() + 7 * row + 7);
  copies.assign(left.begin(), left.begin() + 7 * 3);  // rows that are there already
  t.edit({.remove = gone, .insert = copies});
  EXPECT_EQ(t.hash(), Delaunay<7>(left).hash());
  EXPECT_EQ(t.num_duplicates(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(t.vertex_at(n + i), t.vertex_at(kept[i]));
    EXPECT_EQ(t.row_of(t.vertex_at(kept[i])), kept[i]);
  }
  for (const std::size_t row : kept) {
    const auto point = t.point(t.vertex_at(row));
    EXPECT_TRUE(std::equal(point.begin(), point.end(), points.begin() + 7 * row));
  }
  t.insert(uniform(7, 1, 9));  // wrapped cells get their functionals
  EXPECT_EQ(t.num_vertices(), kept.size() + 1);
}

template <class T>
void expect_what_changes_tell(const T& t, const std::vector<CellId>& before, Index ids_before) {
  const Changes& changes = t.changes();
  std::vector<CellId> now;
  for (const CellId c : t.all_cells()) now.push_back(c);
  std::vector<CellId> expected;
  std::set_difference(before.begin(), before.end(), changes.removed_cells.begin(),
                      changes.removed_cells.end(), std::back_inserter(expected));
  expected.insert(expected.end(), changes.created_cells.begin(), changes.created_cells.end());
  std::sort(expected.begin(), expected.end());
  std::sort(now.begin(), now.end());
  EXPECT_EQ(expected, now);
  for (const VertexId v : changes.added_vertices) EXPECT_GE(index(v), ids_before);
}

TEST(Construction, BatchesOnRecordAreThoseOffIt) {
  for (const unsigned threads : {1u, 2u}) {
    for (const std::size_t n : {5u, 300u, 4000u}) {
      Options options;
      options.threads = threads;
      const std::vector<double> first = uniform(3, 500, 1);
      std::vector<double> second = uniform(3, n, 2);
      second.insert(second.end(), first.begin(), first.begin() + 30);  // duplicates
      Delaunay<3> off(first, options), on(first, options);
      on.record_changes();
      on.record_undo();
      const CanonicalHash hash = on.hash();
      std::vector<CellId> before;
      for (const CellId c : on.all_cells()) before.push_back(c);
      std::sort(before.begin(), before.end());
      off.insert_range(second);
      on.insert_range(second);
      EXPECT_EQ(on.hash(), off.hash());
      EXPECT_EQ(on.num_duplicates(), off.num_duplicates());
      EXPECT_EQ(on.changes().added_vertices.size(), on.num_vertices() - 500u);
      expect_what_changes_tell(on, before, 501);
      for (std::size_t row = 0; row < on.num_rows(); ++row)
        EXPECT_EQ(on.row_of(on.vertex_at(row)), off.row_of(off.vertex_at(row)));
      ASSERT_TRUE(on.can_undo());
      on.undo();
      EXPECT_EQ(on.hash(), hash);
      EXPECT_EQ(on.num_rows(), 500u);
      on.insert_range(second);
      EXPECT_EQ(on.hash(), off.hash());
    }
  }
}

TEST(Construction, TellsWhichVerticesABatchHides) {
  const std::vector<double> first = uniform(2, 200, 1), second = uniform(2, 200, 2);
  const std::vector<double> light(200, 0.0), heavy(200, 0.01);
  Regular<2> t(first, light);
  t.record_changes();
  t.record_undo();
  std::vector<VertexId> visible;
  for (std::size_t row = 0; row < 200; ++row) visible.push_back(t.vertex_at(row));
  t.insert_range(second, heavy);
  std::vector<VertexId> hid;
  for (std::size_t row = 0; row < 200; ++row)
    if (visible[row] != invalid_vertex && t.is_hidden(row)) hid.push_back(visible[row]);
  std::sort(hid.begin(), hid.end());
  EXPECT_FALSE(hid.empty());
  EXPECT_EQ(t.changes().hidden_vertices, hid);
  t.undo();
  for (std::size_t row = 0; row < 200; ++row) EXPECT_EQ(t.vertex_at(row), visible[row]);
}

TEST(Construction, ABadListKeepsWhatCanBeUndone) {
  Delaunay<2> t(uniform(2, 50, 1));
  t.record_undo();
  const CanonicalHash hash = t.hash();
  t.remove(3);
  EXPECT_THROW(t.remove(3), Error);
  ASSERT_TRUE(t.can_undo());
  t.undo();
  EXPECT_EQ(t.hash(), hash);
}

TEST(Construction, ADuplicateLeavesNothingToLaterChanges) {
  const std::vector<double> line{0, 0, 1, 0, 2, 0}, middle{1, 0}, above{2, 1}, more{3, 3, 4, 5};
  Delaunay<2> t(line);
  EXPECT_FALSE(t.insert(middle).inserted);
  EXPECT_EQ(t.complex().num_vertex_slots(), 4u);
  auto raised = t.clone();
  raised.move(2, above);
  EXPECT_EQ(raised.affine_dimension(), 2);
  EXPECT_EQ(raised.num_vertices(), 3u);
  t.record_undo();
  const CanonicalHash hash = t.hash();
  t.insert_range(more);
  t.undo();
  EXPECT_EQ(t.hash(), hash);
  EXPECT_EQ(t.num_vertices(), 3u);
  t.record_undo(false);
  EXPECT_FALSE(t.insert(middle).inserted);
  t.record_undo();
  t.insert_range(line);  // duplicates alone
  t.undo();
  EXPECT_EQ(t.hash(), hash);
}

TEST(Construction, RaisesTheDimensionOnRecord) {
  Delaunay<3> t(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  t.record_changes();
  t.record_undo();
  const CanonicalHash flat = t.hash();
  const std::vector<double> up{0, 0, 1, 1, 1, 1, 0.5, 0.5, 0.5};
  t.insert_range(up);
  EXPECT_EQ(t.affine_dimension(), 3);
  EXPECT_EQ(t.changes().added_vertices.size(), 3u);
  t.undo();
  EXPECT_EQ(t.affine_dimension(), 2);
  EXPECT_EQ(t.hash(), flat);
  Delaunay<3> none;
  none.record_undo();
  none.insert_range(up);
  none.undo();
  EXPECT_EQ(none.affine_dimension(), -1);
  EXPECT_EQ(none.num_rows(), 0u);
  none.insert_range(up);
  EXPECT_EQ(none.affine_dimension(), 2);
}

}  // namespace
}  // namespace delone
