// SPDX-License-Identifier: BSD-3-Clause
#include "hull/site_normals.hpp"

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <random>
#include <vector>

namespace delone::hull {
namespace {

HullState state_with_normals(int d, const std::vector<double>& points) {
  HullState state(d);
  state.insert_range(points, {});
  return state;
}

/// For each vertex, whether it is farther in its direction than all other points; expects that none is
/// farther.
std::vector<bool> are_farthest(int d, const std::vector<double>& points) {
  const HullState state = state_with_normals(d, points);
  const std::vector<double> sums = sums_of_normals(state);
  const auto width = static_cast<std::size_t>(d);
  EXPECT_EQ(sums.size(), state.sites().size() * width);
  std::vector<char> is_corner(state.sites().size(), 0);
  for (const Index site : state.hull().cells) is_corner[site] = 1;
  std::vector<bool> are;
  for (Index v = 0; v < state.sites().size(); ++v) {
    if (is_corner[v] == 0) continue;
    const double* const n = sums.data() + v * width;
    const auto value = [&](Index w) { return std::inner_product(n, n + d, state.sites().point(w), 0.0); };
    double largest = -1e300;
    for (Index w = 0; w < state.sites().size(); ++w)
      if (w != v) largest = std::max(largest, value(w));
    EXPECT_GE(value(v), largest - 1e-12);
    are.push_back(value(v) > largest + 1e-12);
  }
  return are;
}

TEST(SiteNormals, PointOutwards) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (const int d : {2, 3, 4}) {
    std::vector<double> points(static_cast<std::size_t>(50 * d));
    for (double& x : points) x = normal(random);
    const std::vector<bool> are = are_farthest(d, points);
    EXPECT_EQ(std::count(are.begin(), are.end(), true), std::ssize(are)) << d;
    are_farthest(d, test::lattice(d, 3).points);
  }
}

TEST(SiteNormals, OfFlatPointsThereAreNone) {
  EXPECT_TRUE(sums_of_normals(state_with_normals(3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0})).empty());
  EXPECT_TRUE(sums_of_normals(state_with_normals(1, {0, 1, 2})).empty());
}

}  // namespace
}  // namespace delone::hull
