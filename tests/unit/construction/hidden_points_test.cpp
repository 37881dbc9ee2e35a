// SPDX-License-Identifier: BSD-3-Clause
// Lists of hidden points by cells, against a map.
#include "construction/hidden_points.hpp"

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

namespace delone::construction {
namespace {

std::vector<Index> points_of(const HiddenPoints& lists, Index cell) {
  std::vector<Index> points;
  lists.any_of(cell, [&](Index point) {
    points.push_back(point);
    return false;
  });
  std::sort(points.begin(), points.end());
  return points;
}

TEST(HiddenPoints, AreWhereTheyWerePut) {
  constexpr Index num_points = 40, num_cells = 5;
  HiddenPoints lists;
  lists.reserve(num_points, num_cells);
  std::map<Index, Index> cell_of;
  test::Random random(1);
  for (int step = 0; step < 3000; ++step) {
    const Index point = static_cast<Index>(random.integer(0, num_points - 1)),
                cell = static_cast<Index>(random.integer(0, num_cells - 1));
    if (step % 50 == 49) {
      std::vector<Index> taken{1000};
      lists.take(cell, taken);
      std::vector<Index> expected;
      for (const auto& [p, c] : cell_of)
        if (c == cell) expected.push_back(p);
      std::erase_if(cell_of, [&](const auto& entry) { return entry.second == cell; });
      EXPECT_EQ(taken.front(), 1000u) << "what was in the list stays";
      std::sort(taken.begin(), taken.end());
      taken.pop_back();
      EXPECT_EQ(taken, expected);
    } else if (cell_of.erase(point) > 0) {
      lists.remove(point);
    } else {
      lists.add(point, cell);
      cell_of[point] = cell;
    }
    ASSERT_EQ(lists.size(), cell_of.size());
    for (Index c = 0; c < num_cells; ++c)
      for (const Index p : points_of(lists, c)) ASSERT_EQ(cell_of.at(p), c);
    for (Index p = 0; p < num_points; ++p) ASSERT_EQ(lists.contains(p), cell_of.contains(p));
  }
}

TEST(HiddenPoints, OfCellsAndPointsBeyondTheRoomThereAreNone) {
  HiddenPoints lists;
  EXPECT_FALSE(lists.contains(7));
  EXPECT_FALSE(lists.any_of(7, [](Index) { return true; }));
  std::vector<Index> taken;
  lists.take(7, taken);
  EXPECT_TRUE(taken.empty());
  lists.reserve(3, 2);
  lists.add(2, 1);
  lists.reserve(30, 20);
  lists.add(29, 19);
  EXPECT_EQ(points_of(lists, 1), std::vector<Index>{2}) << "more room keeps what is there";
  EXPECT_TRUE(lists.any_of(19, [](Index point) { return point == 29; }));
  EXPECT_FALSE(lists.any_of(19, [](Index point) { return point == 2; }));
}

}  // namespace
}  // namespace delone::construction
