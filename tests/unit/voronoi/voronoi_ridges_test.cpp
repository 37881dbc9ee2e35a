// SPDX-License-Identifier: BSD-3-Clause
// Ridges of power diagrams between whose sites another one lies, in all ways that there are of collecting
// them.
#include <delone/regular.hpp>
#include <delone/voronoi.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace delone::voronoi {
namespace {

using Pair = std::pair<SignedIndex, SignedIndex>;

struct Ridges {
  std::set<Pair> between;
  std::set<std::vector<SignedIndex>> on_the_line;  // the vertices of those between the rows 0, 1 and 2
};

/// ±1 on the first axis, between them the origin with that weight, and two sites on each other axis.
Ridges ridges_around_a_line(std::size_t d, double weight) {
  std::vector<double> points(3 * d, 0), weights{0, 0, weight};
  points[0] = -1;
  points[d] = 1;
  for (std::size_t axis = 1; axis < d; ++axis)
    for (const double x : {3.0 + 0.125 * static_cast<double>(axis), -3.0}) {
      points.insert(points.end(), d, 0);
      points[points.size() - d + axis] = x;
      weights.push_back(0);
    }
  const PowerDiagram diagram(Regular<>(points, weights, static_cast<int>(d)));
  Ridges ridges;
  for (std::size_t r = 0; r < diagram.num_ridges(); ++r) {
    const Pair rows{diagram.ridge_points()[2 * r], diagram.ridge_points()[2 * r + 1]};
    EXPECT_TRUE(ridges.between.insert(rows).second);
    if (rows.second > 2) continue;
    std::vector<SignedIndex> vertices(diagram.ridge(r).begin(), diagram.ridge(r).end());
    std::sort(vertices.begin(), vertices.end());
    ridges.on_the_line.insert(vertices);
  }
  return ridges;
}

TEST(VoronoiRidges, ARegionWithoutInteriorLiesInARidge) {
  for (std::size_t d = 2; d <= 5; ++d) {
    // Its region is the ridge between the others: the three lifted points are on a line.
    const Ridges tied = ridges_around_a_line(d, -1);
    EXPECT_EQ(tied.on_the_line.size(), 1u) << d;
    EXPECT_TRUE(tied.between.count({0, 1}) == 1 ||
                (tied.between.count({0, 2}) == 1 && tied.between.count({1, 2}) == 1))
        << d;
    // Neither a little lighter nor a little heavier is there a tie.
    const Ridges without = ridges_around_a_line(d, -1.125), with = ridges_around_a_line(d, -0.875);
    EXPECT_EQ(without.between.count({0, 1}), 1u) << d;
    EXPECT_EQ(without.between.count({0, 2}) + without.between.count({1, 2}), 0u) << d;
    EXPECT_EQ(with.between.count({0, 1}), 0u) << d;
    EXPECT_EQ(with.between.count({0, 2}) + with.between.count({1, 2}), 2u) << d;
    EXPECT_EQ(with.on_the_line.size(), 2u) << d;
    // The sites around see what they see without it.
    for (const Pair& rows : without.between)
      if (rows.first > 2) {
        EXPECT_EQ(tied.between.count(rows), 1u) << d << ": " << rows.first << ", " << rows.second;
      }
  }
}

/// All cells of a cross-polytope share a sphere: ridges between all sites but those that are opposite.
TEST(VoronoiRidges, OfCrossPolytopes) {
  for (std::size_t d = 2; d <= 5; ++d) {
    std::vector<double> points;
    for (std::size_t axis = 0; axis < d; ++axis)
      for (const double x : {1.0, -1.0}) {
        points.insert(points.end(), d, 0);
        points[points.size() - d + axis] = x;
      }
    const PowerDiagram diagram(Regular<>(points, std::vector<double>(2 * d, 0), static_cast<int>(d)));
    EXPECT_EQ(diagram.num_vertices(), 1u);
    EXPECT_EQ(diagram.num_ridges(), 2 * d * (d - 1));
    for (std::size_t r = 0; r < diagram.num_ridges(); ++r)
      EXPECT_NE(diagram.ridge_points()[2 * r] / 2, diagram.ridge_points()[2 * r + 1] / 2);
  }
}

}  // namespace
}  // namespace delone::voronoi
