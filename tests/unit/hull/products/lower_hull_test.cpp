// SPDX-License-Identifier: BSD-3-Clause
// Envelopes of few points, of flat compositions and of heights at the ends of the range.
#include <delone/lower_hull.hpp>

#include "error_code.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace delone::hull {
namespace {

using test::code_of;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Numbers = std::vector<double>;

constexpr double inf = std::numeric_limits<double>::infinity(), largest = std::numeric_limits<double>::max();

TEST(LowerHull, OfNoPointHasNoPolytope) {
  const LowerHull<> none(Numbers{}, 3);
  EXPECT_EQ(none.composition_dimension(), -1);
  EXPECT_EQ(none.num_cells(), 0u);
  EXPECT_THAT(none.heights(Numbers{0, 0}), ElementsAre(inf));
  EXPECT_THAT(none.height_above(Numbers{0, 0, 1}), ElementsAre(-inf));
  EXPECT_EQ(none.find_cell(Numbers{0, 0}), std::nullopt);
  EXPECT_EQ(code_of([&] { none.polytope(); }), Errc::invalid_argument);
}

TEST(LowerHull, OverOneCompositionIsItsLowestPoint) {
  const Numbers points{1, 5, 1, 3, 1, 4};
  const LowerHull<> lower(points, 2), upper(points, 2, HullSide::upper);
  EXPECT_EQ(lower.composition_dimension(), 0);
  EXPECT_THAT(lower.vertices(), ElementsAre(1));
  EXPECT_THAT(upper.vertices(), ElementsAre(0));
  EXPECT_THAT(lower.heights(Numbers{1, 2}), ElementsAre(3, inf));
  EXPECT_THAT(upper.heights(Numbers{1, 2}), ElementsAre(5, -inf));
  EXPECT_THAT(lower.height_above(Numbers{1, 7, 1, 3, 1, 1, 2, 7}), ElementsAre(4, 0, -2, -inf));
  EXPECT_THAT(upper.height_above(Numbers{1, 7, 1, 5, 1, 1}), ElementsAre(2, 0, -4));
  EXPECT_EQ(lower.find_cell(Numbers{1}), 0u);
}

TEST(LowerHull, TellsHeightsOnBothSides) {
  // A tent: 0 at the ends, −2 and +2 in the middle.
  const Numbers points{0, 0, 4, 0, 2, -2, 2, 2};
  const LowerHull<> lower(points, 2), upper(points, 2, HullSide::upper);
  EXPECT_EQ(lower.num_cells(), 2u);
  EXPECT_THAT(lower.heights(Numbers{0, 1, 2, 3, 5}), ElementsAre(0, -1, -2, -1, inf));
  EXPECT_THAT(upper.heights(Numbers{0, 1, 2, 3, 5}), ElementsAre(0, 1, 2, 1, -inf));
  EXPECT_THAT(lower.height_above(Numbers{1, 0, 1, -1, 1, -3, 5, 0}), ElementsAre(1, 0, -2, -inf));
  EXPECT_EQ(lower.to_data().kind, DataKind::lower_hull);
  EXPECT_EQ(upper.to_data().kind, DataKind::upper_hull);
}

TEST(LowerHull, OfAFlatIsInTheFlat) {
  // Compositions on the diagonal of the plane.
  const LowerHull<> hull(Numbers{0, 0, 1, 2, 2, 3, 1, 1, 0}, 3);
  EXPECT_EQ(hull.composition_dimension(), 1);
  EXPECT_THAT(hull.vertices(), ElementsAre(0, 1, 2));
  EXPECT_THAT(hull.heights(Numbers{0.5, 0.5, 1.5, 1.5, 0.5, 0.25}), ElementsAre(0.5, 1.5, inf));
  EXPECT_EQ(hull.find_cell(Numbers{0.5, 0.75}), std::nullopt);
}

TEST(LowerHull, OfTheLargestHeightsIsExact) {
  const LowerHull<> constant(Numbers{0, largest, 1, largest, 2, largest}, 2);
  EXPECT_EQ(constant.num_facets(), 1u);
  EXPECT_THAT(constant.heights(Numbers{0.5}), ElementsAre(largest));
  const LowerHull<> wide(Numbers{0, largest, 1, -largest, 2, largest}, 2);
  EXPECT_EQ(wide.num_cells(), 2u);
  EXPECT_THAT(wide.heights(Numbers{0.5, 1.5}), ElementsAre(0, 0));
}

TEST(LowerHull, RefusesWhatDoesNotFit) {
  EXPECT_EQ(code_of([] { LowerHull<>(Numbers{1}, 1); }), Errc::bad_dimension);
  EXPECT_EQ(code_of([] { LowerHull<>(Numbers{1, 2, 3}, 2); }), Errc::bad_dimension);
  EXPECT_EQ(code_of([] { LowerHull<>(Numbers{1, inf}, 2); }), Errc::not_finite);
  const LowerHull<> hull(Numbers{0, 0, 1, 1}, 2);
  EXPECT_EQ(code_of([&] { hull.find_cell(Numbers{0, 1}); }), Errc::bad_dimension);
  EXPECT_EQ(code_of([&] { hull.heights(Numbers{inf}); }), Errc::not_finite);
  EXPECT_EQ(code_of([&] { hull.height_above(Numbers{0, 1, 2}); }), Errc::bad_dimension);
  EXPECT_EQ(code_of([&] { hull.height_above(Numbers{0, 1}, -1); }), Errc::invalid_argument);
  EXPECT_THAT(hull.heights(Numbers{}), IsEmpty());
}

}  // namespace
}  // namespace delone::hull
