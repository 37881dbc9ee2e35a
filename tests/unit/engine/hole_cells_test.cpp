// SPDX-License-Identifier: BSD-3-Clause
// Cells that fill a hole are linked, and wrong links are noticed.
#include "engine/hole/hole_cells.hpp"

#include "engine_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace delone::engine {
namespace {

/// A tetrahedron with vertex 5 inside, which leaves: one cell fills its place.
class HoleOfOneCell : public testing::Test {
 protected:
  HoleOfOneCell() : points_({0, 0, 0, 8, 0, 0, 0, 8, 0, 0, 0, 8, 1, 1, 1}, 3, 0, 2) {
    points_.seed();
    points_.build.insert(5);
    auto& cells = points_.build.cells();
    Index cell = 0;
    while (cells.is_vacant(cell) || points_.build.geometry().is_infinite(cell)) ++cell;
    hole_.open_star(cells, points_.build.geometry(), 5, cell, zone_);
  }
  /// Adds the cell whose facet is that of the first cell of the hole.
  void add(bool is_odd) {
    const Index* const inner = hole_.numbers_of_cell(0);
    Index apex = 1;
    while (std::find(inner, inner + 4, apex) != inner + 4) ++apex;
    found_.reserve_one();
    EXPECT_EQ(found_.add(inner, hole_.slot_of_leaving(0), apex, is_odd), 0u);
  }

  Points<3> points_;
  ConflictZone zone_;
  Hole<3> hole_;
  HoleCells<3> found_{3};
};

TEST_F(HoleOfOneCell, IsMatchedWithAllFacetsOfTheBorder) {
  ASSERT_EQ(hole_.border().size(), 4u);
  found_.begin(hole_);
  EXPECT_FALSE(found_.are_all_matched());
  add(false);
  found_.match_facets(0, true);
  EXPECT_TRUE(found_.are_all_matched());
  EXPECT_TRUE(found_.unmatched().empty());
  for (std::uint32_t f = 0; f < 4; ++f) EXPECT_EQ(found_.beside(found_.beyond_border(f)), f);
  EXPECT_TRUE(found_.are_matches_right(hole_));
  EXPECT_TRUE(found_.have_all_vertices(hole_));
}

TEST_F(HoleOfOneCell, IsNotFilledByACellOnTheOtherSide) {
  found_.begin(hole_);
  add(true);
  found_.match_facets(0, true);
  EXPECT_TRUE(found_.are_all_matched());
  EXPECT_FALSE(found_.are_matches_right(hole_));
}

TEST_F(HoleOfOneCell, IsNotMatchedWithOtherFacets) {
  found_.begin(hole_);
  add(false);
  found_.match_facets(0, true);
  std::array<std::uint32_t, 4> order{found_.beside(0), found_.beside(1), found_.beside(2), found_.beside(3)};
  std::sort(order.begin(), order.end());
  int num_right = 0;
  do {
    found_.begin(hole_);
    add(false);
    for (std::uint32_t here = 0; here < 4; ++here) found_.link(here, order[here]);
    num_right += found_.are_matches_right(hole_) ? 1 : 0;
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(num_right, 1);
}

TEST_F(HoleOfOneCell, IsNotFilledTwice) {
  found_.begin(hole_);
  for (std::size_t cell = 0; cell < 2; ++cell) {
    const std::vector<Index> numbers(hole_.numbers_of_cell(0), hole_.numbers_of_cell(0) + 4);
    found_.reserve_one();
    found_.add(numbers.data(), 0, numbers[0], false);
    found_.match_facets(cell, true);
  }
  EXPECT_FALSE(found_.are_all_matched());
}

}  // namespace
}  // namespace delone::engine
