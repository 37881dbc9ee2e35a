// SPDX-License-Identifier: BSD-3-Clause
// Known answers; nearest_in_hull_test.cpp checks the conditions of optimality on many inputs.
#include "kernel/exact_nearest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace delone::kernel {
namespace {

ExactNearest nearest(const std::vector<double>& points, const std::vector<double>& q,
                     std::vector<int> guess = {}) {
  std::vector<const double*> rows;
  for (std::size_t i = 0; i < points.size(); i += q.size()) rows.push_back(points.data() + i);
  return nearest_in_hull_exactly(rows, q.data(), static_cast<int>(q.size()), guess);
}

TEST(ExactNearest, FaceWeightsAndDistance) {
  // Between (3, 0) and (0, 4) the origin's foot is at 12/5: weights 16/25 and 9/25.
  const std::vector<double> triangle{3, 0, 0, 4, 9, 9};
  for (const std::vector<int>& guess : {std::vector<int>{}, {0}, {2}, {0, 1}, {0, 1, 2}}) {
    const ExactNearest found = nearest(triangle, {0, 0}, guess);
    EXPECT_EQ(found.face, (std::vector<int>{0, 1}));
    EXPECT_EQ(found.numerators[0] * 25, found.denominator * 16);
    EXPECT_EQ(found.numerators[1] * 25, found.denominator * 9);
    EXPECT_EQ(found.weight(0), 0.64);
    // 2.4 in binary is below or above 12/5; the neighbors tell.
    EXPECT_EQ(found.compare(2.39), Sign::positive);
    EXPECT_EQ(found.compare(2.41), Sign::negative);
  }
}

TEST(ExactNearest, ComparisonsAreExact) {
  const ExactNearest five = nearest({3, 4}, {0, 0}), same = nearest({8, -5, 8, 9}, {3, 0});
  EXPECT_EQ(five.compare(5), Sign::zero);
  EXPECT_EQ(five.compare(std::nextafter(5, 6)), Sign::negative);
  EXPECT_EQ(five.compare(std::nextafter(5, 4)), Sign::positive);
  EXPECT_EQ(five.compare(same), Sign::zero);
  EXPECT_EQ(five.compare(nearest({0x1p-1000, 5}, {0, 0})), Sign::negative);
  EXPECT_EQ(nearest({0, 0}, {0, 0}).compare(0), Sign::zero);
  EXPECT_EQ(nearest({0x1p-1074, 0}, {0, 0}).compare(0), Sign::positive);
}

TEST(ExactNearest, DependentPoints) {
  const ExactNearest found = nearest({1, -1, 1, 1, 1, 0, 1, 0.5}, {0, 0.25}, {0, 1, 2, 3});
  EXPECT_EQ(found.compare(1), Sign::zero);
}

// Those far behind are left out by binary64; the answer is that of all, whatever the scale.
TEST(ExactNearest, OfManyPointsIsThatOfAFew) {
  for (const double scale : {1.0, 0x1p1015, 0x1p-1060}) {
    std::vector<double> points{3 * scale, 0, 0, 4 * scale};
    const std::vector<double> q{-0x1p-52 * scale, 0};
    const ExactNearest few = nearest(points, q);
    for (int i = 0; i < 3000; ++i) points.insert(points.end(), {(4 + i % 60) * scale, (i / 60 - 1) * scale});
    points.insert(points.end(), {0x1p-10 * scale, 4 * scale, 2 * scale, 2 * scale});
    for (const std::vector<int>& guess : {std::vector<int>{}, {2500}, {0, 1}, {3002, 7}}) {
      const ExactNearest found = nearest(points, q, guess);
      EXPECT_EQ(found.compare(few), Sign::zero);
      EXPECT_EQ(found.face, few.face);
    }
    // One that is nearer by less than rounding.
    points.insert(points.end(), {std::nextafter(1.5, 1.0) * scale, 2 * scale});
    EXPECT_EQ(nearest(points, q, {0, 1}).compare(few), scale < 1e-300 ? Sign::zero : Sign::negative);
  }
}

}  // namespace
}  // namespace delone::kernel
