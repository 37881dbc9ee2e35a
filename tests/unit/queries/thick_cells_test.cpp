// SPDX-License-Identifier: BSD-3-Clause
#include "queries/thick_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <new>
#include <vector>

namespace delone::queries {
namespace {

std::vector<const double*> rows(const std::vector<double>& points, std::size_t d) {
  std::vector<const double*> result;
  for (std::size_t i = 0; i < points.size(); i += d) result.push_back(points.data() + i);
  return result;
}

TEST(ThickCells, LeastHeightsExactly) {
  // A triangle with sides 3, 4 and 5: the least height is 2.4, which is no binary fraction.
  const std::vector<double> triangle{0, 0, 3, 0, 0, 4};
  EXPECT_EQ(compare_least_height(rows(triangle, 2), 2, 2.4),
            2.4 < 12.0L / 5 ? Sign::positive : Sign::negative);
  EXPECT_EQ(compare_least_height(rows(triangle, 2), 2, 2.5), Sign::negative);
  EXPECT_EQ(compare_least_height(rows(triangle, 2), 2, 0), Sign::positive);
  // Sides of 5, 5 and 6: heights 4 and 4.8.
  const std::vector<double> tie{-3, 0, 3, 0, 0, 4};
  EXPECT_EQ(compare_least_height(rows(tie, 2), 2, 4), Sign::zero);
  EXPECT_EQ(compare_least_height(rows(tie, 2), 2, std::nextafter(4, 5)), Sign::negative);
  EXPECT_EQ(compare_least_height(rows(tie, 2), 2, std::nextafter(4, 3)), Sign::positive);
  // A segment in space of length 3.
  const std::vector<double> segment{1, 1, 1, 3, 2, 3};
  EXPECT_EQ(compare_least_height(rows(segment, 3), 3, 3), Sign::zero);
}

TEST(ThickCells, CellsAreDecidedOnceAndExactly) {
  const std::vector<double> tie{-3, 0, 3, 0, 0, 4}, sliver{0, 0, 10, 0, 5, 0x1p-60};
  kernel::NearestInHull work;
  const ThickCells equal(2, 4), less(2, std::nextafter(4, 3));
  EXPECT_FALSE(equal.is_known_thick(CellId{0}));
  EXPECT_FALSE(equal.is_thick(CellId{0}, rows(tie, 2), 2, work));
  EXPECT_FALSE(equal.is_known_thick(CellId{0}));
  EXPECT_TRUE(less.is_thick(CellId{0}, rows(tie, 2), 2, work));
  EXPECT_TRUE(less.is_known_thick(CellId{0}));
  const ThickCells fine(2, 0x1p-61), coarse(2, 0x1p-60);
  EXPECT_TRUE(fine.is_thick(CellId{1}, rows(sliver, 2), 2, work));
  EXPECT_FALSE(coarse.is_thick(CellId{1}, rows(sliver, 2), 2, work));
}

TEST(ThickCells, KeepOneList) {
  const ThickCells thick(4, 1);
  EXPECT_EQ(thick.list(), nullptr);
  EXPECT_THROW(thick.keep_list([]() -> std::vector<CellId> { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_EQ(thick.list(), nullptr);
  thick.keep_list([] { return std::vector{CellId{2}}; });
  thick.keep_list([] { return std::vector{CellId{1}, CellId{3}}; });
  ASSERT_NE(thick.list(), nullptr);
  EXPECT_EQ(*thick.list(), std::vector{CellId{2}});
}

}  // namespace
}  // namespace delone::queries
