// SPDX-License-Identifier: BSD-3-Clause
// Hulls against cddlib in rational numbers: facets by the points on them, and which points are extreme; in
// general position, full of points on facets, and flat.
#include "degenerate.hpp"
#include "double_description.hpp"

#include <delone/convex_hull.hpp>

#include <gtest/gtest.h>

#include <iterator>
#include <set>
#include <string>

namespace delone {
namespace {

#if DELONE_HAVE_CDDLIB
using Rows = test::DoubleDescription::Rows;

/// REQUIRES two distinct points.
void expect_same(const test::PointSet& set) {
  // Each point once.
  const auto d = static_cast<std::size_t>(set.dimension);
  std::set<std::vector<double>> distinct;
  for (std::size_t i = 0; i < set.points.size(); i += d) {
    std::vector<double> point(&set.points[i], &set.points[i] + d);
    for (double& x : point) x += 0.0;  // never −0
    distinct.insert(point);
  }
  std::vector<double> points;
  for (const std::vector<double>& point : distinct) points.insert(points.end(), point.begin(), point.end());

  const auto truth = test::DoubleDescription::of_points(points, set.dimension);
  const ConvexHull hull(points, set.dimension);
  const HullData& data = hull.data();
  EXPECT_EQ(static_cast<std::size_t>(data.affine_dimension) + truth.linearities, d);
  EXPECT_EQ(data.vertices, truth.essential);
  std::set<Rows> facets, expected;
  std::set<SignedIndex> on_boundary;
  for (const auto& [row, on] : truth.found) {
    Rows extreme;
    std::set_intersection(on.begin(), on.end(), truth.essential.begin(), truth.essential.end(),
                          std::back_inserter(extreme));
    expected.insert(extreme);
    on_boundary.insert(on.begin(), on.end());
  }
  for (std::size_t f = 0; f < data.num_facets(); ++f)
    facets.emplace(data.facet_vertices.begin() + data.facet_offsets[f],
                   data.facet_vertices.begin() + data.facet_offsets[f + 1]);
  EXPECT_EQ(facets, expected);
  EXPECT_EQ(data.num_facets(), expected.size());
  for (std::size_t r = 0; r < data.point_kinds.size(); ++r) {
    const auto row = static_cast<SignedIndex>(r);
    const PointKind kind = std::binary_search(truth.essential.begin(), truth.essential.end(), row)
                               ? PointKind::extreme
                           : on_boundary.count(row) > 0 ? PointKind::boundary
                                                        : PointKind::interior;
    EXPECT_EQ(data.point_kinds[r], kind) << "row " << r;
  }
}
#endif

class HullCddlibIn : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, HullCddlibIn, ::testing::Range(2, 7),
                         ::testing::PrintToStringParamName());

TEST_P(HullCddlibIn, GeneralPosition) {
#if DELONE_HAVE_CDDLIB
  const int d = GetParam(), sizes[] = {60, 40, 25, 18, 15};
  test::Random random(static_cast<std::uint64_t>(71 + d));
  test::PointSet set{"random", d, {}};
  for (int i = 0; i < sizes[d - 2] * d; ++i) set.points.push_back(random.real());
  expect_same(set);
#else
  GTEST_SKIP() << "this build found no cddlib";
#endif
}

TEST_P(HullCddlibIn, LatticePointsInEveryAffineDimension) {
#if DELONE_HAVE_CDDLIB
  const int d = GetParam();
  test::Random random(static_cast<std::uint64_t>(72 + d));
  for (int k = 1; k <= d; ++k) {
    // Points of a lattice of dimension k; the other coordinates are sums of theirs.
    test::PointSet set{"lattice", d, {}};
    for (int i = 0; i < 6 + 4 * k; ++i) {
      std::vector<double> point;
      for (int j = 0; j < k; ++j) point.push_back(random.integer(-1, 1));
      for (int j = k; j < d; ++j) point.push_back(point[0] - 2 * point[static_cast<std::size_t>(j % k)] + j);
      set.points.insert(set.points.end(), point.begin(), point.end());
    }
    expect_same(set);
    if (HasFailure()) FAIL() << "affine dimension " << k << " in " << d;
  }
#else
  GTEST_SKIP() << "this build found no cddlib";
#endif
}

}  // namespace
}  // namespace delone
