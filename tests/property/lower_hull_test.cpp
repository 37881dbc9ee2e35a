// SPDX-License-Identifier: BSD-3-Clause
// Lower hulls: against Delaunay triangulations of integer points, whose lifts are exact; distances of the
// points themselves; flat, vertical and constant input.
#include "compare.hpp"
#include "degenerate.hpp"
#include "scale.hpp"

#include <delone/delaunay.hpp>
#include <delone/lower_hull.hpp>
#include <delone/predicates.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace delone {
namespace {

using test::PointSet;

std::vector<double> lifted(const PointSet& set) {
  std::vector<double> result;
  const auto d = static_cast<std::size_t>(set.dimension);
  for (std::size_t row = 0; row < set.size(); ++row) {
    double norm = 0;
    for (std::size_t j = 0; j < d; ++j) {
      result.push_back(set.points[row * d + j]);
      norm += set.points[row * d + j] * set.points[row * d + j];
    }
    result.push_back(norm);
  }
  return result;
}

class LowerHullIn : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, LowerHullIn, ::testing::Range(1, 6),
                         ::testing::PrintToStringParamName());

TEST_P(LowerHullIn, OfLiftedPointsInGeneralPositionIsTheDelaunayTriangulation) {
  const int d = GetParam();
  for (std::uint64_t seed = 1; seed <= test::scaled_count(10); ++seed) {
    const PointSet set = test::small_integers(d, d <= 3 ? 60 : 30, -1000000, 1000000, seed);
    const LowerHull hull(lifted(set), d + 1);
    const Delaunay<> delaunay(set.points, d);
    if (delaunay.statistics().perturbed > 0) continue;
    const ComplexData data = hull.to_data(), expected = delaunay.to_data();
    EXPECT_EQ(data.affine_dimension, d);
    EXPECT_TRUE(test::same_cells(test::sorted_cells(expected), test::sorted_cells(data)));
    EXPECT_EQ(hull.num_facets(), delaunay.num_finite_cells());
    // Neighbors agree too: the borders have the same size.
    EXPECT_EQ(std::count(data.neighbors.begin(), data.neighbors.end(), -1), delaunay.num_infinite_cells());
    if (d <= 5) {
      for (std::size_t c = 0; c < data.num_cells(); ++c) {
        std::vector<double> simplex;
        for (int i = 0; i <= d; ++i)
          for (int j = 0; j < d; ++j)
            simplex.push_back(set.points[static_cast<std::size_t>(
                data.cells[c * static_cast<std::size_t>(d + 1) + static_cast<std::size_t>(i)] * d + j)]);
        EXPECT_EQ(orientation(simplex, d), Sign::positive);
      }
    }
  }
}

TEST_P(LowerHullIn, EveryPointIsOnOrAboveItAndVerticesAreOnIt) {
  const int d = GetParam() + 1;
  for (std::uint64_t seed = 0; seed < test::scaled_count(2); ++seed)
    for (const PointSet& set : test::degenerate_sets(d, 14, seed)) {
      SCOPED_TRACE(set.name + "\n" + test::to_text(set.points, d));
      for (const HullSide side : {HullSide::lower, HullSide::upper}) {
        const LowerHull hull(set.points, d, side);
        const double sign = side == HullSide::lower ? 1 : -1;
        EXPECT_EQ(hull.num_points(), set.size());
        const std::vector<double> above = hull.height_above(set.points);
        for (std::size_t row = 0; row < above.size(); ++row) EXPECT_GE(sign * above[row], 0) << "row " << row;
        for (const SignedIndex row : hull.cells())
          EXPECT_EQ(above[static_cast<std::size_t>(row)], 0) << "row " << row;
        EXPECT_EQ(hull.vertices().empty(), set.points.empty());
        // Moved up or down by the least amount, a point of the hull is off it.
        for (const SignedIndex row : hull.vertices()) {
          const auto first = set.points.begin() + row * d;
          std::vector<double> moved(first, first + d);
          moved.back() = std::nextafter(moved.back(), -sign * std::numeric_limits<double>::infinity());
          EXPECT_LT(sign * hull.height_above(moved)[0], 0);
          moved.pop_back();
          EXPECT_TRUE(hull.find_cell(moved));
        }
      }
      if (HasFailure()) return;
    }
}

TEST_P(LowerHullIn, AffineHeightsMakeOneFacet) {
  const int c = GetParam();
  const PointSet set = test::lattice(c, 3);
  std::vector<double> points;
  for (std::size_t row = 0; row < set.size(); ++row) {
    double height = 7;
    for (int j = 0; j < c; ++j) {
      points.push_back(set.points[row * static_cast<std::size_t>(c) + static_cast<std::size_t>(j)]);
      height += (j + 1) * points.back();
    }
    points.push_back(height);
  }
  const LowerHull hull(points, c + 1);
  EXPECT_EQ(hull.num_facets(), 1u);
  EXPECT_EQ(hull.composition_dimension(), c);
  EXPECT_EQ(hull.vertices().size(), std::size_t{1} << c);  // the corners of the cube
  const std::vector<double> query(static_cast<std::size_t>(c), 0.5);
  EXPECT_DOUBLE_EQ(hull.heights(query)[0], 7 + 0.25 * c * (c + 1));
  EXPECT_EQ(hull.heights(std::vector<double>(static_cast<std::size_t>(c), 2.5))[0],
            std::numeric_limits<double>::infinity());
}

TEST(LowerHull, HasAKnownPhaseDiagram) {
  // A binary system: A at 0, B at 1 with energy 0; a stable compound at 1/2, one slightly above the tie line,
  // one far above.
  const std::vector<double> points = {0, 0, 1, 0, 0.5, -1, 0.25, -0.4375, 0.75, 2};
  const LowerHull hull(points, 2);
  EXPECT_EQ(hull.num_cells(), 2u);
  EXPECT_EQ(std::vector<SignedIndex>(hull.vertices().begin(), hull.vertices().end()),
            (std::vector<SignedIndex>{0, 1, 2}));
  EXPECT_EQ(hull.height_above(points), (std::vector<double>{0, 0, 0, 0.0625, 2.5}));
  EXPECT_EQ(hull.heights(std::vector<double>{0.25, 0.5, 0.75}), (std::vector<double>{-0.5, -1, -0.5}));
  const LowerHull upper(points, 2, HullSide::upper);
  EXPECT_EQ(std::vector<SignedIndex>(upper.vertices().begin(), upper.vertices().end()),
            (std::vector<SignedIndex>{0, 1, 4}));
}

TEST(LowerHull, OfOneCompositionIsTheLowestPoint) {
  const std::vector<double> points = {3, 4, 9, 3, 4, -2, 3, 4, 5, 3, 4, -2};
  const LowerHull hull(points, 3);
  EXPECT_EQ(hull.composition_dimension(), 0);
  EXPECT_EQ(hull.num_cells(), 1u);
  EXPECT_EQ(hull.cells()[0], 1);
  EXPECT_EQ(hull.height_above(points), (std::vector<double>{11, 0, 7, 0}));
  EXPECT_EQ(hull.heights(std::vector<double>{3, 4, 0, 0}),
            (std::vector<double>{-2, std::numeric_limits<double>::infinity()}));
}

TEST(LowerHull, TakesTheLargestDoubles) {
  constexpr double largest = std::numeric_limits<double>::max();
  const std::vector<double> points = {0, largest, 1, largest, 2, largest};
  EXPECT_EQ(LowerHull(points, 2).num_facets(), 1u);
  EXPECT_EQ(LowerHull(points, 2, HullSide::upper).num_facets(), 1u);
  EXPECT_EQ(LowerHull(std::vector<double>{0, -largest, 1, largest, 2, -largest}, 2).num_facets(), 1u);
}

TEST(LowerHull, RefusesWhatIsNoInput) {
  EXPECT_THROW(LowerHull(std::vector<double>{1, 2}, 1), Error);
  EXPECT_THROW(LowerHull(std::vector<double>{1, 2, 3}, 2), Error);
  EXPECT_THROW(LowerHull(std::vector<double>{1, std::nan("")}, 2), Error);
  const LowerHull empty(std::vector<double>{}, 2);
  EXPECT_EQ(empty.num_cells(), 0u);
  EXPECT_EQ(empty.composition_dimension(), -1);
  EXPECT_EQ(empty.heights(std::vector<double>{1})[0], std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace delone
