// SPDX-License-Identifier: BSD-3-Clause
#include "hull/site_normals.hpp"

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace delone::hull {
namespace {

HullState state_with_normals(int d, const std::vector<double>& points) {
  HullState state(d);
  state.insert_range(points, {});
  return state;
}

// In its direction a vertex is farther than all other points, also where cells lie in one face.
TEST(SiteNormals, PointOutwards) {
  for (const int d : {2, 3, 4}) {
    const std::vector<double> points = test::lattice(d, 3).points;
    const HullState state = state_with_normals(d, points);
    const std::vector<double> sums = sums_of_normals(state);
    const auto width = static_cast<std::size_t>(d);
    ASSERT_EQ(sums.size(), state.sites().size() * width);
    std::size_t num_corners = 0;
    for (Index v = 0; v < state.sites().size(); ++v) {
      const double* const p = state.sites().point(v);
      const double* const n = sums.data() + v * width;
      if (std::any_of(p, p + d, [](double x) { return x == 1; })) continue;
      ++num_corners;
      for (Index w = 0; w < state.sites().size(); ++w) {
        if (w == v) continue;
        EXPECT_GT(std::inner_product(n, n + d, p, 0.0),
                  std::inner_product(n, n + d, state.sites().point(w), 0.0));
      }
    }
    EXPECT_EQ(num_corners, std::size_t{1} << width);
  }
}

TEST(SiteNormals, OfFlatPointsThereAreNone) {
  EXPECT_TRUE(sums_of_normals(state_with_normals(3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0})).empty());
  EXPECT_TRUE(sums_of_normals(state_with_normals(1, {0, 1, 2})).empty());
}

}  // namespace
}  // namespace delone::hull
