// SPDX-License-Identifier: BSD-3-Clause
// What is called wide is wider, whatever the simplex; most of what is wide is called so.
#include "kernel/width_test.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace delone::kernel {
namespace {

std::vector<const double*> rows(const std::vector<double>& x, std::size_t d) {
  std::vector<const double*> result;
  for (std::size_t i = 0; i < x.size(); i += d) result.push_back(x.data() + i);
  return result;
}

// A cube of side s has width s, also if most of it is stretched.
TEST(WidthTest, OfBoxes) {
  WidthTest test;
  for (std::size_t m = 1; m <= 5; ++m) {
    std::vector<double> box;
    for (std::size_t corner = 0; corner < std::size_t{1} << m; ++corner) {
      for (std::size_t j = 0; j < m; ++j)
        box.push_back((corner >> j & 1u) != 0 ? std::pow(10.0, static_cast<double>(j)) : 0);
      box.push_back(7);
    }
    EXPECT_FALSE(test.is_wide(rows(box, m + 1), m, m + 1, 1.0));
    EXPECT_TRUE(test.is_wide(rows(box, m + 1), m, m + 1, 0.001));
  }
}

TEST(WidthTest, FlatAndFewPoints) {
  WidthTest test;
  const std::vector<double> line{0, 0, 1, 1, 2, 2};
  EXPECT_FALSE(test.is_wide(rows(line, 2), 2, 2, 1e-100));
  EXPECT_TRUE(test.is_wide(rows(line, 2), 1, 2, 0.1));
  const std::vector<double> two{0, 0, 1, 1};
  EXPECT_FALSE(test.is_wide(rows(two, 2), 2, 2, 1e-100));
  const std::vector<double> far{0, 0, 1, std::numeric_limits<double>::infinity(), 2, 7};
  EXPECT_FALSE(test.is_wide(rows(far, 2), 2, 2, 1e-9));
}

TEST(WidthTest, OfTrianglesInSpace) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double nan = std::nan("");
  int wide = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const double height = std::pow(10.0, -17 * std::abs(uniform(random))), offset = trial % 2 == 0 ? 0 : 1e3;
    const double p[] = {offset, 0, 0}, q[] = {offset + 1, 1, 0}, r[] = {offset + 0.5, 0.5, height};
    EXPECT_FALSE(is_wide_triangle(p, q, r, height));
    if (is_wide_triangle(p, q, r, height / 4)) ++wide;
    if (offset == 0 && height > 1e-10) {
      EXPECT_TRUE(is_wide_triangle(p, q, r, height / 4));
    }
  }
  EXPECT_GT(wide, 1000);
  const double p[] = {0, 0, 0}, q[] = {1, 0, 0}, far[] = {0, nan, 1};
  EXPECT_FALSE(is_wide_triangle(p, q, far, 1e-9));
}

TEST(WidthTest, IsNeverWrongAboutThinTriangles) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  WidthTest test;
  for (int trial = 0; trial < 3000; ++trial) {
    const double height = std::pow(10.0, -17 * std::abs(uniform(random)));
    const std::vector<double> triangle{0, 0, 1, 0, 0.5 + uniform(random) / 4, height};
    EXPECT_FALSE(test.is_wide(rows(triangle, 2), 2, 2, height));
  }
}

}  // namespace
}  // namespace delone::kernel
