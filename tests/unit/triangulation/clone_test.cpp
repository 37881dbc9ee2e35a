// SPDX-License-Identifier: BSD-3-Clause
// Clones of triangulations of all kinds are equal to what they are made from, and independent of it.
#include "scale.hpp"

#include <delone/delaunay.hpp>
#include <delone/furthest_site.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace delone::triangulation {
namespace {

template <class T>
void expect_independent_clone(T& t, const std::vector<double>& more) {
  const CanonicalHash before = t.hash();
  T copy = t.clone();
  EXPECT_EQ(copy.hash(), before);
  EXPECT_EQ(copy.num_vertices(), t.num_vertices());
  EXPECT_EQ(copy.to_data().cells, t.to_data().cells);
  copy.insert_range(more);
  EXPECT_EQ(t.hash(), before);
  t.insert_range(more);
  EXPECT_EQ(copy.hash(), t.hash());
  EXPECT_EQ(copy.num_duplicates(), t.num_duplicates());
}

TEST(Clone, OfDelaunayTriangulations) {
  for (const char* kind : {"uniform", "grid", "flat", "duplicates"})
    for (const int d : {2, 3}) {
      SCOPED_TRACE(kind);
      Delaunay<> t(make_point_set(kind, d, 60, 1), d);
      expect_independent_clone(t, make_point_set("uniform", d, 40, 2));
    }
  Delaunay<> compacted(make_point_set("uniform", 3, 60, 1), 3),
      wrapped(make_point_set("uniform", 7, test::scaled_size(210, 40), 1), 7);
  compacted.compact();
  expect_independent_clone(compacted, make_point_set("uniform", 3, 10, 2));
  expect_independent_clone(wrapped, make_point_set("uniform", 7, 2, 2));
}

TEST(Clone, OfFewPoints) {
  for (const std::size_t n : {0, 1, 2}) {
    Delaunay<2> t(make_point_set("uniform", 2, n, 1));
    const std::vector<double> more = make_point_set("uniform", 2, 9, 2);
    const CanonicalHash before = t.hash();
    Delaunay<2> copy = t.clone();
    copy.insert_range(more);
    EXPECT_EQ(t.hash(), before);
    t.insert_range(more);
    EXPECT_EQ(copy.hash(), t.hash());
  }
}

TEST(Clone, OfFurthestSitesAndWeightedPoints) {
  FurthestSite<> furthest(make_point_set("uniform", 3, 60, 1), 3);
  expect_independent_clone(furthest, make_point_set("uniform", 3, 40, 2));
  const std::vector<double> points = make_point_set("uniform", 3, 60, 1),
                            weights = make_point_set("uniform", 1, 60, 3);
  Regular<3> regular(points, weights);
  Regular<3> copy = regular.clone();
  EXPECT_EQ(copy.hash(), regular.hash());
  EXPECT_EQ(copy.hidden_rows(), regular.hidden_rows());
  copy.insert({0.5, 0.5, 0.5}, 2.0);
  EXPECT_NE(copy.hash(), regular.hash());
}

}  // namespace
}  // namespace delone::triangulation
