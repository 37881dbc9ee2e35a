// SPDX-License-Identifier: BSD-3-Clause
// Elimination: the reduced basis depends on the span alone, and the kernel is orthogonal to it.
#include "polyhedra/integer_rows.hpp"

#include "cone_support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace delone::polyhedra {
namespace {

using ::testing::ElementsAre;

TEST(IntegerRows, BecomePrimitive) {
  Row row{6, 0, -9}, zero{0, 0}, one{0, -5};
  make_primitive(row);
  make_primitive(zero);
  make_primitive(one);
  EXPECT_THAT(row, ElementsAre(2, 0, -3));
  EXPECT_THAT(zero, ElementsAre(0, 0));
  EXPECT_THAT(one, ElementsAre(0, -1));
}

TEST(IntegerRows, EchelonDependsOnTheSpan) {
  random::Generator generator(1);
  for (int round = 0; round < 200; ++round) {
    const std::size_t width = 1 + generator.below(6);
    Rows rows =
        random_rows(generator, generator.below(8), width, round % 2 == 0 ? Integer(3) : Integer(1) << 90);
    const Echelon echelon(width, rows);
    EXPECT_EQ(echelon.rank(), width - brute_force::null_space(as_fractions(rows), width).size());
    const Rows kernel = echelon.kernel();
    EXPECT_EQ(kernel.size(), width - echelon.rank());
    for (const Row& x : kernel)
      for (const Row& row : rows) EXPECT_EQ(scalar_product(row, x), 0);
    std::reverse(rows.begin(), rows.end());
    for (Row& row : rows)
      for (Integer& x : row) x *= -3;
    EXPECT_EQ(Echelon(width, rows).sorted_rows(), echelon.sorted_rows());
    for (const Row& row : rows) {
      Row rest = row;
      echelon.reduce(rest);
      EXPECT_TRUE(is_zero(rest));
    }
  }
}

TEST(IntegerRows, PivotsMayBeLimited) {
  Echelon echelon(2);
  EXPECT_TRUE(echelon.add({2, 4, 1, 0}));
  EXPECT_TRUE(echelon.add({1, 1, 0, 1}));
  EXPECT_FALSE(echelon.add({3, 5, 7, 7}));
  EXPECT_THAT(echelon.sorted_rows(), ElementsAre(ElementsAre(2, 0, -1, 4), ElementsAre(0, 2, 1, -2)));
}

}  // namespace
}  // namespace delone::polyhedra
