// SPDX-License-Identifier: BSD-3-Clause
// The engine against Qhull, on points in general position, where rounding does not change Qhull's answer.
#include "compare.hpp"
#include "degenerate.hpp"

#include <delone/delaunay.hpp>
#include <delone/furthest_site.hpp>

#include <gtest/gtest.h>

#include <cstdio>

#if DELONE_HAVE_QHULL
#include <libqhull_r/qhull_ra.h>
#endif

namespace delone {
namespace {

#if DELONE_HAVE_QHULL
// The cells of Qhull's Delaunay triangulation, or of the furthest-site one; none if Qhull reports an error or
// had to merge facets.
test::Cells qhull_cells(std::vector<double> points, int dimension, bool furthest = false) {
  test::Cells cells;
  qhT state;
  qhT* qh = &state;
  qh_zero(qh, stderr);
  char nearest_sites[] = "qhull d Qbb", furthest_sites[] = "qhull d Qbb Qu";
  char* const command = furthest ? furthest_sites : nearest_sites;
  const int n = static_cast<int>(points.size()) / dimension;
  if (qh_new_qhull(qh, dimension, n, points.data(), False, command, nullptr, stderr) == 0) {
    facetT* facet;
    vertexT *vertex, **vertexp;
    FORALLfacets {
      if ((facet->upperdelaunay != 0) != furthest) continue;
      cells.emplace_back();
      FOREACHvertex_(facet->vertices) cells.back().push_back(qh_pointid(qh, vertex->point));
      std::sort(cells.back().begin(), cells.back().end());
      if (cells.back().size() != static_cast<std::size_t>(dimension) + 1) {
        ADD_FAILURE() << "Qhull merged facets: the points are not in general position for it";
        break;
      }
    }
  }
  qh_freeqhull(qh, !qh_ALL);
  int current, total;
  qh_memfreeshort(qh, &current, &total);
  std::sort(cells.begin(), cells.end());
  return cells;
}
#endif

class QhullIn : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, QhullIn, ::testing::Range(2, 8), ::testing::PrintToStringParamName());

TEST_P(QhullIn, UniformPointsAgree) {
#if DELONE_HAVE_QHULL
  const int d = GetParam(), sizes[] = {2000, 1000, 400, 150, 70, 40};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    std::vector<double> points;
    test::Random random(seed);
    for (int i = 0; i < sizes[d - 2] * d; ++i) points.push_back(random.real());
    EXPECT_TRUE(test::same_cells(qhull_cells(points, d), test::sorted_cells(Delaunay<>(points, d).to_data())))
        << "seed " << seed << '\n'
        << test::to_text(points, d);
  }
#else
  GTEST_SKIP() << "this build found no Qhull";
#endif
}

TEST_P(QhullIn, FurthestSitesAgree) {
#if DELONE_HAVE_QHULL
  const int d = GetParam(), sizes[] = {2000, 1000, 400, 150, 70, 40};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    std::vector<double> points;
    test::Random random(seed);
    for (int i = 0; i < sizes[d - 2] * d; ++i) points.push_back(random.real());
    EXPECT_TRUE(test::same_cells(qhull_cells(points, d, true),
                                 test::sorted_cells(FurthestSite<>(points, d).to_data())))
        << "seed " << seed << '\n'
        << test::to_text(points, d);
  }
#else
  GTEST_SKIP() << "this build found no Qhull";
#endif
}

}  // namespace
}  // namespace delone
