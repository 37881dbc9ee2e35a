// SPDX-License-Identifier: BSD-3-Clause
// Intersections of halfspaces against Qhull, in general position, where rounding does not change Qhull's
// answer.
#include "halfspace_sets.hpp"

#include <delone/halfspaces.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#if DELONE_HAVE_QHULL
#include <libqhull_r/qhull_ra.h>
#endif

namespace delone {
namespace {

#if DELONE_HAVE_QHULL
using Rows = std::vector<SignedIndex>;

struct QhullResult {
  std::map<Rows, std::vector<double>> vertices;  // by the rows that meet there
  Rows facets;                                   // rows that are not redundant
};

// Seen from the origin; nothing if Qhull reports an error.
QhullResult qhull(std::vector<double> rows, int dimension) {
  QhullResult result;
  qhT state;
  qhT* qh = &state;
  qh_zero(qh, stderr);
  std::string command = "qhull H0";
  for (int j = 1; j < dimension; ++j) command += ",0";
  const int m = static_cast<int>(rows.size()) / (dimension + 1);
  if (qh_new_qhull(qh, dimension + 1, m, rows.data(), False, command.data(), nullptr, stderr) == 0) {
    facetT* facet;
    vertexT *vertex, **vertexp;
    FORALLfacets {
      Rows meeting;
      FOREACHvertex_(facet->vertices) meeting.push_back(qh_pointid(qh, vertex->point));
      std::sort(meeting.begin(), meeting.end());
      std::vector<double> x;
      for (int j = 0; j < dimension; ++j) x.push_back(facet->normal[j] / -facet->offset);
      result.vertices.emplace(std::move(meeting), std::move(x));
    }
    FORALLvertices result.facets.push_back(qh_pointid(qh, vertex->point));
    std::sort(result.facets.begin(), result.facets.end());
  }
  qh_freeqhull(qh, !qh_ALL);
  int current, total;
  qh_memfreeshort(qh, &current, &total);
  return result;
}
#endif

class HalfspacesQhullIn : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, HalfspacesQhullIn, ::testing::Range(2, 8),
                         ::testing::PrintToStringParamName());

TEST_P(HalfspacesQhullIn, RandomHalfspacesAgree) {
#if DELONE_HAVE_QHULL
  const int d = GetParam(), sizes[] = {1000, 500, 200, 80, 40, 25};
  const std::vector<double> rows = test::halfspaces_around_a_ball(d, sizes[d - 2], 51);
  const QhullResult expected = qhull(rows, d);
  for (const bool given : {true, false}) {
    const std::vector<double> origin(static_cast<std::size_t>(d), 0.0);
    const HalfspaceIntersection found =
        given ? HalfspaceIntersection(rows, d, origin) : HalfspaceIntersection(rows, d);
    const IntersectionData& data = found.data();
    EXPECT_TRUE(data.bounded);
    EXPECT_EQ(data.facet_halfspaces, expected.facets);
    EXPECT_LT(data.num_facets(), found.num_halfspaces());
    ASSERT_EQ(data.num_vertices(), expected.vertices.size());
    for (std::size_t v = 0; v < data.num_vertices(); ++v) {
      const auto meeting = data.halfspaces_of_vertex(v);
      const auto at = expected.vertices.find(Rows(meeting.begin(), meeting.end()));
      ASSERT_NE(at, expected.vertices.end()) << "vertex " << v;
      double size = 0;
      for (const double x : data.vertex(v)) size = std::max(size, std::abs(x));
      for (std::size_t j = 0; j < at->second.size(); ++j)
        EXPECT_NEAR(data.vertex(v)[j], at->second[j], 1e-9 * size * size);
    }
  }
#else
  GTEST_SKIP() << "this build found no Qhull";
#endif
}

}  // namespace
}  // namespace delone
