// SPDX-License-Identifier: BSD-3-Clause
// Intersections of halfspaces against cddlib in rational numbers: which vertices and directions there are, on
// which facets, and which rows are redundant. General and degenerate, larger than what brute force can do.
#include "degenerate.hpp"
#include "double_description.hpp"
#include "halfspace_brute_force.hpp"
#include "halfspace_sets.hpp"

#include <delone/halfspaces.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace delone {
namespace {

#if DELONE_HAVE_CDDLIB
using Rows = test::DoubleDescription::Rows;

void expect_same(const std::vector<double>& rows, int d) {
  const auto truth = test::DoubleDescription::of_halfspaces(rows, d);
  const HalfspaceIntersection found(rows, d);
  const IntersectionData& data = found.data();
  ASSERT_EQ(found.state(), IntersectionState::full);
  ASSERT_EQ(static_cast<std::size_t>(data.rank) + truth.linearities, static_cast<std::size_t>(d));
  EXPECT_EQ(data.facet_halfspaces, truth.essential);
  if (data.rank < d) return;
  std::map<Rows, std::size_t> vertex_at, direction_at;
  for (std::size_t v = 0; v < data.num_vertices(); ++v)
    vertex_at.emplace(Rows(data.halfspaces_of_vertex(v).begin(), data.halfspaces_of_vertex(v).end()), v);
  for (std::size_t u = 0; u < data.num_directions(); ++u)
    direction_at.emplace(Rows(data.halfspaces_of_direction(u).begin(), data.halfspaces_of_direction(u).end()),
                         u);
  std::size_t vertices = 0, directions = 0;
  for (const auto& [z, on] : truth.found) {
    Rows facets;
    std::set_intersection(on.begin(), on.end(), truth.essential.begin(), truth.essential.end(),
                          std::back_inserter(facets));
    ++(z[0] == 0 ? directions : vertices);
    if (z[0] == 0) {
      const auto at = direction_at.find(facets);
      ASSERT_NE(at, direction_at.end());
      const auto u = data.direction(at->second);
      double square = 0;
      for (std::size_t j = 1; j < z.size(); ++j) square += static_cast<double>(z[j] * z[j]);
      for (std::size_t j = 0; j < u.size(); ++j)
        EXPECT_NEAR(u[j], static_cast<double>(z[j + 1]) / std::sqrt(square), 1e-14);
    } else {
      const auto at = vertex_at.find(facets);
      ASSERT_NE(at, vertex_at.end());
      for (std::size_t j = 0; j < z.size() - 1; ++j)
        EXPECT_TRUE(test::is_nearest(data.vertex(at->second)[j], z[j + 1]));
    }
  }
  EXPECT_EQ(data.num_vertices(), vertices);
  EXPECT_EQ(data.num_directions(), directions);
}
#endif

class HalfspacesCddlibIn : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, HalfspacesCddlibIn, ::testing::Range(2, 7),
                         ::testing::PrintToStringParamName());

TEST_P(HalfspacesCddlibIn, GeneralPosition) {
#if DELONE_HAVE_CDDLIB
  const int d = GetParam(), sizes[] = {80, 50, 30, 22, 18};
  expect_same(test::halfspaces_around_a_ball(d, sizes[d - 2], 41), d);
#else
  GTEST_SKIP() << "this build found no cddlib";
#endif
}

TEST_P(HalfspacesCddlibIn, SmallIntegers) {
#if DELONE_HAVE_CDDLIB
  const int d = GetParam();
  for (std::uint64_t repeat = 0; repeat < 6; ++repeat) {
    const std::vector<double> rows =
        test::halfspaces_of_small_integers(d, repeat % 2 == 0 ? 3 * d + 6 : d + 1, 42 + repeat);
    expect_same(rows, d);
    if (HasFailure()) FAIL() << "repeat " << repeat;
  }
#else
  GTEST_SKIP() << "this build found no cddlib";
#endif
}

}  // namespace
}  // namespace delone
