// SPDX-License-Identifier: BSD-3-Clause
// Hulls of few points and in flats, hulls of extreme points that grow, and what is refused.
#include <delone/convex_hull.hpp>

#include "error_code.hpp"

#include <delone/point_sets.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace delone::hull {
namespace {

using test::code_of;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Kind = Containment::Kind;
using Points = std::vector<double>;

TEST(ConvexHull, OfNoPointAndOfOne) {
  ConvexHull<> hull(2);
  EXPECT_FALSE(hull.contains(Points{0, 0}));
  EXPECT_EQ(hull.locate(Points{0, 0}).kind, Kind::outside_affine_hull);
  EXPECT_THAT(hull.visible_cells(Points{0, 0}), IsEmpty());
  hull.insert({3, 4});
  EXPECT_TRUE(hull.contains(Points{3, 4}));
  EXPECT_FALSE(hull.contains(Points{3, 5}));
  const Containment there = hull.locate(Points{3, 4});
  EXPECT_EQ(there.kind, Kind::on_boundary);
  EXPECT_THAT(there.face, ElementsAre(0));
  EXPECT_THAT(hull.visible_facets(Points{3, 4}), IsEmpty());
  const HullInsertResult twice = hull.insert({3, 4});
  EXPECT_TRUE(twice.duplicate);
  EXPECT_FALSE(twice.inserted);
  EXPECT_EQ(hull.num_duplicates(), 1u);
  EXPECT_TRUE(hull.insert({5, 4}).inserted) << "which raises the dimension";
  EXPECT_EQ(hull.affine_dimension(), 1);
}

TEST(ConvexHull, LocatesOnFacesAndInFlats) {
  const ConvexHull<> square(Points{0, 0, 4, 0, 0, 4, 4, 4, 2, 0, 1, 1}, 2);
  EXPECT_EQ(square.locate(Points{1, 2}).kind, Kind::inside);
  EXPECT_EQ(square.locate(Points{5, 2}).kind, Kind::outside);
  EXPECT_EQ(square.visible_facets(Points{5, 5}).size(), 2u);
  EXPECT_THAT(square.visible_facets(Points{4, 5}), ::testing::SizeIs(1)) << "another one lies in its line";
  Containment edge = square.locate(Points{3, 0});
  EXPECT_EQ(edge.kind, Kind::on_boundary);
  std::sort(edge.face.begin(), edge.face.end());
  EXPECT_THAT(edge.face, ElementsAre(0, 1)) << "the point between them is not extreme";
  EXPECT_THAT(square.locate(Points{4, 4}).face, ElementsAre(3));
  const ConvexHull<> flat(Points{0, 0, 1, 4, 0, 1, 0, 4, 1}, 3);
  EXPECT_EQ(flat.locate(Points{1, 1, 1}).kind, Kind::inside);
  EXPECT_EQ(flat.locate(Points{3, 3, 1}).kind, Kind::outside);
  EXPECT_EQ(flat.locate(Points{1, 1, 1.5}).kind, Kind::outside_affine_hull);
  EXPECT_FALSE(flat.contains(Points{1, 1, 1.5}));
  EXPECT_THAT(flat.visible_cells(Points{3, 3, 1.5}), IsEmpty());
  EXPECT_THAT(flat.visible_cells(Points{3, 3, 1}), ::testing::SizeIs(1));
}

TEST(ConvexHull, WithATolerancePointsNearAFlatAreInIt) {
  Options options;
  options.axis_tolerances = {0.001, 0.001, 0.5};
  const ConvexHull<> flat(Points{0, 0, 1, 4, 0, 1, 0, 4, 1}, 3, options);
  EXPECT_EQ(flat.locate(Points{1, 1, 1.25}).kind, Kind::inside);
  EXPECT_EQ(flat.locate(Points{1, 1, 3}).kind, Kind::outside_affine_hull);
  options.axis_tolerances.clear();
  options.tolerance = 0.125;
  const ConvexHull<> other(Points{0, 0, 1, 4, 0, 1, 0, 4, 1}, 3, options);
  EXPECT_TRUE(other.contains(Points{1, 1, 1.125}));
  EXPECT_FALSE(other.contains(Points{1, 1, 1.25}));
}

TEST(ConvexHull, OfExtremePointsGrowsToTheHullOfAll) {
  for (const double tolerance : {0.0, 0.01}) {
    Options options;
    options.tolerance = tolerance;
    const Points first = make_point_set("ball", 2, 300, 1), second = make_point_set("ball", 2, 300, 2);
    ConvexHull<> extreme(2, options);
    const std::vector<SignedIndex> rows = extreme.insert_extreme_points(first);
    EXPECT_EQ(extreme.num_points(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < 2; ++j)
        EXPECT_EQ(extreme.point(i)[j], first[2 * static_cast<std::size_t>(rows[i]) + j]);
    const ConvexHull<> all(first, 2, options);
    EXPECT_EQ(extreme.hash(), all.hash());
    EXPECT_LE(extreme.max_distance(), tolerance);
    EXPECT_EQ(extreme.clone().hash(), all.hash());
    EXPECT_EQ(code_of([&] { extreme.insert_extreme_points(second); }), Errc::invalid_argument);
    extreme.insert_range(second);
    EXPECT_EQ(extreme.num_points(), rows.size() + 300);
    if (tolerance > 0) continue;
    Points both = first;
    both.insert(both.end(), second.begin(), second.end());
    EXPECT_EQ(extreme.hash(), ConvexHull<>(both, 2).hash());
  }
  ConvexHull<> none(2);
  EXPECT_THAT(none.insert_extreme_points(Points{}), IsEmpty());
}

TEST(ConvexHull, RefusesWhatDoesNotFitAndStaysAsItWas) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  ConvexHull<> hull(make_point_set("uniform", 2, 30, 1), 2);
  const CanonicalHash hash = hull.hash();
  EXPECT_EQ(code_of([&] { hull.insert(Points{1, 2, 3}); }), Errc::bad_dimension);
  EXPECT_EQ(code_of([&] { hull.insert(Points{1, nan}); }), Errc::not_finite);
  EXPECT_EQ(code_of([&] { hull.insert_range(Points{1, 2, 3}); }), Errc::bad_dimension);
  EXPECT_EQ(code_of([&] { hull.insert_range(Points{9, 9, nan, 9}); }), Errc::not_finite);
  EXPECT_EQ(code_of([&] { hull.locate(Points{1}); }), Errc::bad_dimension);
  EXPECT_EQ(code_of([&] { hull.contains(Points{nan, 1}); }), Errc::not_finite);
  EXPECT_EQ(code_of([&] { hull.kind(30); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { hull.point(30); }), Errc::invalid_argument);
  EXPECT_EQ(hull.hash(), hash);
  EXPECT_EQ(hull.num_points(), 30u);
}

}  // namespace
}  // namespace delone::hull
