// SPDX-License-Identifier: BSD-3-Clause
// Hulls against Qhull, on points in general position, where rounding does not change Qhull's answer.
#include "compare.hpp"
#include "degenerate.hpp"

#include <delone/convex_hull.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#if DELONE_HAVE_QHULL
#include <libqhull_r/qhull_ra.h>
#endif

namespace delone {
namespace {

#if DELONE_HAVE_QHULL
struct QhullResult {
  test::Cells facets;
  double area = 0, volume = 0;
};

// The facets of Qhull's convex hull; none if Qhull reports an error.
QhullResult qhull(std::vector<double> points, int dimension) {
  QhullResult result;
  qhT state;
  qhT* qh = &state;
  qh_zero(qh, stderr);
  char command[] = "qhull FA";
  const int n = static_cast<int>(points.size()) / dimension;
  if (qh_new_qhull(qh, dimension, n, points.data(), False, command, nullptr, stderr) == 0) {
    qh_getarea(qh, qh->facet_list);
    result.area = qh->totarea;
    result.volume = qh->totvol;
    facetT* facet;
    vertexT *vertex, **vertexp;
    FORALLfacets {
      result.facets.emplace_back();
      FOREACHvertex_(facet->vertices) result.facets.back().push_back(qh_pointid(qh, vertex->point));
      std::sort(result.facets.back().begin(), result.facets.back().end());
    }
  }
  qh_freeqhull(qh, !qh_ALL);
  int current, total;
  qh_memfreeshort(qh, &current, &total);
  std::sort(result.facets.begin(), result.facets.end());
  return result;
}
#endif

class HullQhullIn : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, HullQhullIn, ::testing::Range(2, 9),
                         ::testing::PrintToStringParamName());

TEST_P(HullQhullIn, RandomPointsAgree) {
#if DELONE_HAVE_QHULL
  const int d = GetParam(), sizes[] = {500, 400, 150, 60, 40, 25, 20};
  for (const bool on_sphere : {false, true}) {
    test::Random random(static_cast<std::uint64_t>(d) + on_sphere);
    std::vector<double> points;
    for (int i = 0; i < sizes[d - 2]; ++i) {
      double square = 0;
      for (int j = 0; j < d; ++j) {
        points.push_back(2 * random.real() - 1);
        square += points.back() * points.back();
      }
      if (on_sphere)
        for (auto at = points.end() - d; at != points.end(); ++at) *at /= std::sqrt(square);
    }
    const QhullResult expected = qhull(points, d);
    const ConvexHull hull(points, d);
    EXPECT_TRUE(test::same_cells(expected.facets, test::sorted_cells(hull.data().cells, d - 1)))
        << test::to_text(points, d);
    EXPECT_EQ(hull.num_facets(), expected.facets.size());
    EXPECT_NEAR(hull.volume().value, expected.volume, 1e-10 * expected.volume);
    EXPECT_NEAR(hull.area().value, expected.area, 1e-10 * expected.area);
  }
#else
  GTEST_SKIP() << "this build found no Qhull";
#endif
}

}  // namespace
}  // namespace delone
