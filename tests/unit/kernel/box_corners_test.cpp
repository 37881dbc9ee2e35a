// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/box_corners.hpp"

#include "kernel/exact.hpp"
#include "kernel/fractions.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace delone::kernel {
namespace {

constexpr std::array axes{0, 1, 2};

/// A box with sides of many sizes, and all its corners.
class Box {
 public:
  Box(std::mt19937_64& random, int exponents) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int j = 0; j < 3; ++j)
      for (double& x : sides_[static_cast<std::size_t>(j)])
        x = std::ldexp(uniform(random), static_cast<int>(random() % 2048) * exponents / 2048);
    for (std::size_t c = 0; c < 8; ++c)
      for (std::size_t j = 0; j < 3; ++j) corners_[c][j] = sides_[j][c >> j & 1];
  }
  double side(std::size_t axis, std::size_t end) const { return sides_[axis][end]; }
  const double* corner(std::size_t c) const { return corners_[c].data(); }
  double& coordinate(std::size_t c, std::size_t axis) { return corners_[c][axis]; }

 private:
  std::array<std::array<double, 2>, 3> sides_{};
  std::array<std::array<double, 3>, 8> corners_{};
};

TEST(BoxCorners, AreOnOneSphere) {
  std::mt19937_64 random(1);
  const Flat flat{3, axes};
  for (const int exponents : {1, 60, -900, 900})
    for (int round = 0; round < 50; ++round) {
      Box box(random, exponents);
      const double* const corners[] = {box.corner(0), box.corner(1), box.corner(2), box.corner(4)};
      for (std::size_t c = 0; c < 8; ++c) {
        EXPECT_TRUE(are_corners_of_a_box(3, corners, 4, box.corner(c)));
        EXPECT_EQ(exact_sphere(flat, corners, box.corner(c)), Sign::zero);
      }
      double& moved = box.coordinate(7, random() % 3);
      moved = std::nextafter(moved, random() % 2 ? 4 : -4);
      EXPECT_FALSE(are_corners_of_a_box(3, corners, 4, box.corner(7)));
      EXPECT_NE(exact_sphere(flat, corners, box.corner(7)), Sign::zero);
    }
}

TEST(BoxCorners, MayShareCoordinates) {
  const double p[] = {0, 0, 0}, q[] = {1, 0, -0.0}, r[] = {0, 2, 0}, s[] = {1, 2, 0}, t[] = {3, 2, 0};
  const double* const points[] = {p, q, r};
  EXPECT_TRUE(are_corners_of_a_box(3, points, 3, s));
  EXPECT_TRUE(are_corners_of_a_box(3, points, 3, p));
  EXPECT_FALSE(are_corners_of_a_box(3, points, 3, t));
}

TEST(BoxCorners, CenterIsCorrectlyRounded) {
  std::mt19937_64 random(2);
  const auto expected = [](double a, double b) {
    constexpr int grid = -1100;
    return nearest_double(scaled_integer(a, grid) + scaled_integer(b, grid), 2, grid);
  };
  const auto expect = [&](double a, double b) {
    const double p[] = {a}, q[] = {b};
    const double* const points[] = {p, q};
    double center = 0;
    ASSERT_TRUE(find_center_of_box(1, points, 2, &center));
    EXPECT_EQ(center, expected(a, b)) << a << ' ' << b;
    EXPECT_EQ(std::signbit(center), std::signbit(expected(a, b) + 0.0)) << a << ' ' << b;
  };
  for (const int exponents : {1, 60, -900, 900})
    for (int round = 0; round < 100; ++round) {
      const Box box(random, exponents);
      for (std::size_t j = 0; j < 3; ++j) expect(box.side(j, 0), box.side(j, 1));
    }
  constexpr double tiny = 0x1p-1074, least = 0x1p-1022, largest = 0x1.fffffffffffffp1023;
  const std::array ends{0.0,          tiny,         3 * tiny, -tiny,     -3 * tiny,        least,
                        least - tiny, least + tiny, -least,   2 * least, 2 * least + tiny, 1.0,
                        -1.0,         1 + 0x1p-52,  largest,  -largest,  largest / 2};
  for (const double a : ends)
    for (const double b : ends) expect(a, b);
}

TEST(BoxCorners, OtherPointsHaveNoCenter) {
  const double p[] = {0, 0}, q[] = {1, 0}, r[] = {2, 1};
  const double* const points[] = {p, q, r};
  double center[2];
  EXPECT_FALSE(find_center_of_box(2, points, 3, center));
}

}  // namespace
}  // namespace delone::kernel
