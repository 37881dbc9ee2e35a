// SPDX-License-Identifier: BSD-3-Clause
// A compacted triangulation is the same triangulation in less memory, and can grow again.
#include "degenerate.hpp"

#include <delone/delaunay.hpp>
#include <delone/furthest_site.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace delone {
namespace {

std::span<const double> row(const std::vector<double>& points, int dimension, std::size_t i) {
  const auto d = static_cast<std::size_t>(dimension);
  return std::span<const double>(points).subspan(i * d, d);
}

/// The vertex sets of cells, which do not depend on the ids of cells.
std::vector<std::vector<VertexId>> vertex_sets(const Triangulation& t, const std::vector<CellId>& cells) {
  std::vector<std::vector<VertexId>> sets;
  for (const CellId c : cells) {
    sets.push_back(t.vertices(c));
    std::sort(sets.back().begin(), sets.back().end());
  }
  std::sort(sets.begin(), sets.end());
  return sets;
}

template <class Product>
std::vector<CellId> zone_of(const Product& t, std::span<const double> q) {
  if constexpr (requires { t.conflict_zone(q, 0.0); })
    return t.conflict_zone(q, 0.0);
  else
    return t.conflict_zone(q);
}

template <class Product>
void expect_same_answers(const Product& before, const Product& after, const std::vector<double>& queries) {
  ASSERT_EQ(after.hash(), before.hash());
  EXPECT_EQ(after.num_finite_cells(), before.num_finite_cells());
  EXPECT_EQ(after.num_infinite_cells(), before.num_infinite_cells());
  EXPECT_EQ(after.complex().num_cell_slots(), after.complex().num_all_cells()) << "no gaps";
  for (std::size_t i = 0; i < queries.size() / static_cast<std::size_t>(before.dimension()); ++i) {
    const auto q = row(queries, before.dimension(), i);
    Location was = before.locate(q), is = after.locate(q);
    EXPECT_EQ(is.kind, was.kind);
    std::sort(was.face.begin(), was.face.end());
    std::sort(is.face.begin(), is.face.end());
    EXPECT_EQ(is.face, was.face);
    EXPECT_EQ(vertex_sets(after, zone_of(after, q)), vertex_sets(before, zone_of(before, q)));
  }
}

TEST(Compact, AnswersAsBeforeAndGrowsAgain) {
  for (const test::PointSet& set : test::degenerate_sets(3, 40, 5)) {
    SCOPED_TRACE(set.name);
    const auto d = static_cast<std::size_t>(set.dimension);
    const std::size_t half = set.size() / 2;
    const auto first = std::span<const double>(set.points).first(half * d);
    const Delaunay<> reference(first, set.dimension);
    Delaunay<> compacted(first, set.dimension);
    compacted.compact();
    expect_same_answers(reference, compacted, set.points);
    compacted.compact();
    for (std::size_t i = half; i < set.size(); ++i) {
      compacted.insert(row(set.points, set.dimension, i));
      if (i == half + 2) compacted.compact();
    }
    EXPECT_EQ(compacted.hash(), Delaunay<>(set.points, set.dimension).hash());
  }
}

TEST(Compact, TakesEightBytesPerVertexOfACell) {
  for (const int d : {2, 3, 5}) {
    Delaunay<> t(make_point_set("uniform", d, 400, 1), d);
    const double before = static_cast<double>(t.statistics().cell_bytes);
    t.compact();
    const double cells = t.complex().num_all_cells(), after = static_cast<double>(t.statistics().cell_bytes);
    EXPECT_LE(after, 8 * (d + 1) * cells + 64);
    EXPECT_LT(after, before / 2);
  }
}

TEST(Compact, OfWeightedAndFurthestPoints) {
  const std::vector<double> points = make_point_set("uniform", 2, 300, 7);
  std::vector<double> weights;
  for (std::size_t i = 0; i < 300; ++i) weights.push_back(0.01 * static_cast<double>(i % 5));
  const Regular<> reference(points, weights, 2);
  Regular<> compacted(points, weights, 2);
  compacted.compact();
  expect_same_answers(reference, compacted, make_point_set("uniform", 2, 50, 8));
  EXPECT_EQ(compacted.hidden_rows(), reference.hidden_rows());
  const FurthestSite<> furthest(points, 2);
  FurthestSite<> less(points, 2);
  less.compact();
  EXPECT_EQ(less.hash(), furthest.hash());
}

TEST(Compact, OfFewPoints) {
  for (const std::vector<double>& points : {std::vector<double>{}, {1.0, 2.0}, {1.0, 2.0, 3.0, 4.0}}) {
    Delaunay<> t(points, 2);
    t.compact();
    EXPECT_EQ(t.hash(), Delaunay<>(points, 2).hash());
    t.insert_range(std::vector<double>{0, 0, 1, 0, 0, 1});
    std::vector<double> all = points;
    all.insert(all.end(), {0, 0, 1, 0, 0, 1});
    EXPECT_EQ(t.hash(), Delaunay<>(all, 2).hash());
  }
}

}  // namespace
}  // namespace delone
