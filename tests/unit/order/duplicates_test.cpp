// SPDX-License-Identifier: BSD-3-Clause
// Exact duplicates: the lowest equal row, with −0 equal to +0 and nothing else equal to anything.
#include "order/insertion_order.hpp"
#include "random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace delone::order {
namespace {

TEST(FirstEqualRows, Small) {
  EXPECT_TRUE(first_equal_rows(PointsView(std::vector<double>{}, 3)).empty());
  const std::vector<double> x{0, 1, /**/ 0, 2, /**/ 0, 1, /**/ 1, 0, /**/ 0, 2, /**/ 0, 1};
  EXPECT_EQ(first_equal_rows(PointsView(x, 2)), (std::vector<Index>{0, 1, 0, 3, 1, 0}));
}

TEST(FirstEqualRows, MinusZeroEqualsZero) {
  const std::vector<double> x{0.0, -0.0, /**/ -0.0, 0.0, /**/ 0.0, 0.0, /**/ -0.0, 1};
  EXPECT_EQ(first_equal_rows(PointsView(x, 2)), (std::vector<Index>{0, 0, 0, 3}));
}

TEST(FirstEqualRows, NeighboringDoublesAndPermutedCoordinatesDiffer) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const std::vector<double> x{1,      2,    /**/ 2,     1, /**/ std::nextafter(1, 2), 2, /**/ 0, 0, /**/ tiny, 0,
                              /**/ 0, tiny, /**/ -tiny, 0};
  EXPECT_EQ(first_equal_rows(PointsView(x, 2)), (std::vector<Index>{0, 1, 2, 3, 4, 5, 6}));
}

TEST(FirstEqualRows, AgreesWithAMap) {
  random::Generator generator(2);
  for (int d : {1, 2, 3, 7}) {
    const auto k = static_cast<std::size_t>(d);
    std::vector<double> x(5000 * k);
    for (double& v : x) v = static_cast<double>(generator.below(d == 1 ? 2000 : 9)) - 4;
    const auto rows = first_equal_rows(PointsView(x, d));
    std::map<std::vector<double>, Index> seen;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::vector<double> key(x.begin() + static_cast<std::ptrdiff_t>(i * k),
                                    x.begin() + static_cast<std::ptrdiff_t>(i * k + k));
      EXPECT_EQ(rows[i], seen.try_emplace(key, static_cast<Index>(i)).first->second);
    }
  }
}

TEST(FirstEqualRows, AllEqualAndManyDimensions) {
  EXPECT_EQ(first_equal_rows(PointsView(std::vector<double>(100 * 300, 0.25), 100)), std::vector<Index>(300, 0));
}

}  // namespace
}  // namespace delone::order
