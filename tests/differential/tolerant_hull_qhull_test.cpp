// SPDX-License-Identifier: BSD-3-Clause
// Hulls with a tolerance against Qhull's merged facets, on turned shapes in rounded coordinates: with the
// distance of the outer planes that Qhull reports they have as few vertices as Qhull's, or fewer.
#include "rounded_sets.hpp"

#include <delone/check.hpp>
#include <delone/convex_hull.hpp>

#include <gtest/gtest.h>

#include <cstdio>
#include <optional>

#if DELONE_HAVE_QHULL
#include <libqhull_r/qhull_ra.h>
#endif

namespace delone {
namespace {

#if DELONE_HAVE_QHULL
struct MergedHull {
  std::size_t vertices = 0, facets = 0;
  double outer = 0;  // how far a point may be outside of its facets
};

std::optional<MergedHull> qhull(std::vector<double> points, int dimension) {
  std::optional<MergedHull> result;
  qhT state;
  qhT* qh = &state;
  qh_zero(qh, stderr);
  char command[] = "qhull";
  const int n = static_cast<int>(points.size()) / dimension;
  if (qh_new_qhull(qh, dimension, n, points.data(), False, command, nullptr, stderr) == 0) {
    realT outer = 0, inner = 0;
    qh_outerinner(qh, nullptr, &outer, &inner);
    result = {static_cast<std::size_t>(qh->num_vertices), static_cast<std::size_t>(qh->num_facets), outer};
  }
  qh_freeqhull(qh, !qh_ALL);
  int current, total;
  qh_memfreeshort(qh, &current, &total);
  return result;
}
#endif

class TolerantHullQhull : public ::testing::TestWithParam<test::Shape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, TolerantHullQhull,
                         ::testing::Values(test::subdivided_box("box", {1, 2.3, 0.7}, 8, false),
                                           test::l_prism(), test::chamfered_hexagon(),
                                           test::subdivided_box("lattice2", {12, 12}, 12, true),
                                           test::subdivided_box("lattice3", {8, 8, 8}, 8, true),
                                           test::subdivided_box("lattice4", {4, 4, 4, 4}, 4, true)),
                         [](const auto& shape) {
                           std::string name = shape.param.name;
                           for (char& c : name)
                             if (c == ' ') c = '_';
                           return name;
                         });

TEST_P(TolerantHullQhull, HasAsFewVerticesOrFewer) {
#if DELONE_HAVE_QHULL
  const test::Shape& shape = GetParam();
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<double> points = test::turned(shape, seed);
    const std::optional<MergedHull> theirs = qhull(points, shape.dimension);
    ASSERT_TRUE(theirs);
    const ConvexHull<> hull(points, shape.dimension, {.tolerance = theirs->outer});
    EXPECT_LE(hull.num_vertices(), theirs->vertices);
    EXPECT_EQ(hull.num_vertices(), shape.vertices) << "Qhull has " << theirs->vertices;
    EXPECT_EQ(hull.num_facets(), shape.facets) << "Qhull has " << theirs->facets;
    EXPECT_LE(hull.max_distance(), theirs->outer);
    const CheckReport report = check(hull.to_data());
    EXPECT_TRUE(report.ok) << report.violation;
  }
#else
  GTEST_SKIP() << "this build found no Qhull";
#endif
}

}  // namespace
}  // namespace delone
