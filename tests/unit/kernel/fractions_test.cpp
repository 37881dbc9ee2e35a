// SPDX-License-Identifier: BSD-3-Clause
// Fractions without error: rounding at every border between two doubles, determinants and linear systems.
#include "kernel/fractions.hpp"

#include "base/random.hpp"
#include "brute_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace delone::kernel {
namespace {

using Limits = std::numeric_limits<double>;

TEST(Fractions, IntegersOfAGrid) {
  EXPECT_EQ(scaled_integer(0, 5), 0);
  EXPECT_EQ(scaled_integer(-12, 2), -3);
  EXPECT_EQ(scaled_integer(0.75, -3), 6);
  EXPECT_EQ(scaled_integer(Limits::denorm_min(), -1074), 1);
  EXPECT_EQ(scaled_integer(Limits::max(), -1074), ((Integer(1) << 53) - 1) << (971 + 1074));
}

TEST(Fractions, RoundingUp) {
  const double infinity = Limits::infinity();
  for (const double x : {1.0, -1.0, 2.0, -0.75, 1e300, -1e-300, Limits::max(), -Limits::max(),
                         Limits::denorm_min(), -Limits::denorm_min(), Limits::min(), 0.0}) {
    SCOPED_TRACE(x);
    const Integer exact = scaled_integer(x, -1074), little = 1;
    EXPECT_EQ(double_above(exact, 1, -1074), x);
    EXPECT_EQ(double_above(-exact, -1, -1074), x);
    EXPECT_EQ(double_above(exact * 8 + little, 8, -1074), std::nextafter(x, infinity));
    EXPECT_EQ(double_above(exact * 8 - little, 8, -1074), x);
    EXPECT_EQ(double_above((exact * 8 + little) << 100, 8, -1174), std::nextafter(x, infinity));
  }
  EXPECT_FALSE(std::signbit(double_above(-1, 3, -1074)));
  EXPECT_EQ(double_above(1, 3, 2000), infinity);
  EXPECT_EQ(double_above(-1, 3, 2000), -Limits::max());
}

TEST(Fractions, SquareExponentsRoundDown) {
  EXPECT_EQ(square_exponent(12), 1);
  EXPECT_EQ(square_exponent(8), 1);
  EXPECT_EQ(square_exponent(-1), 0);
  EXPECT_EQ(square_exponent(0.5), -1);
  EXPECT_EQ(square_exponent(0.125), -2);
  EXPECT_EQ(square_exponent(0x1p-1073), -537);
  EXPECT_EQ(square_exponent(0), std::numeric_limits<int>::max());
}

/// The fraction halfway between x and the next double rounds to the even one, and what is a little less or
/// more to the nearest. x is not negative.
void expect_correct_rounding(double x) {
  SCOPED_TRACE(x);
  const double next = std::nextafter(x, Limits::infinity());
  const int grid = -1080;
  const Integer low = scaled_integer(x, grid), step = std::isinf(next)
                                                          ? Integer(1) << (971 - grid)
                                                          : Integer(scaled_integer(next, grid) - low);
  const Integer middle = 2 * low + step;  // over 2
  const double even = (scaled_integer(x, grid) / step) % 2 == 0 ? x : next;
  for (const int denominator : {2, -14}) {
    const Integer scale = denominator / 2;
    EXPECT_EQ(nearest_double(middle * scale, denominator, grid), even);
    EXPECT_EQ(nearest_double(-middle * scale, denominator, grid), even == 0 ? 0 : -even);
    EXPECT_FALSE(std::signbit(nearest_double(-middle * scale * 0, denominator, grid)));
  }
  const Integer many = Integer(1) << 200;
  EXPECT_EQ(nearest_double(middle * many - 1, 2 * many, grid), x);
  EXPECT_EQ(nearest_double(middle * many + 1, 2 * many, grid), next);
  EXPECT_EQ(nearest_double(low * 3, 3, grid), x);
}

TEST(Fractions, AreRoundedToTheNearestDouble) {
  for (const double x : {1.0, std::nextafter(1.0, 2.0), std::nextafter(1.0, 0.0), 0.1, 1e300, 1e-300, 0.0,
                         Limits::denorm_min(), 2 * Limits::denorm_min(), std::nextafter(Limits::min(), 0.0),
                         Limits::min(), Limits::max(), std::nextafter(Limits::max(), 0.0)})
    expect_correct_rounding(x);
  random::Generator generator(1);
  for (int i = 0; i < 200; ++i)
    expect_correct_rounding(std::ldexp(generator.uniform(), static_cast<int>(generator.below(2000)) - 1000));
}

TEST(Fractions, BeyondTheLargestDoubleAreInfinite) {
  EXPECT_EQ(nearest_double(1, 1, 1024), Limits::infinity());
  EXPECT_EQ(nearest_double(-1, 1, 5000), -Limits::infinity());
  EXPECT_EQ(nearest_double(1, 1, -1076), 0);
  EXPECT_EQ(nearest_double(-1, 1, -5000), 0);
  EXPECT_FALSE(std::signbit(nearest_double(-1, 1, -5000)));
}

std::vector<Integer> random_matrix(std::size_t rows, std::size_t columns, random::Generator& generator) {
  std::vector<Integer> a;
  for (std::size_t i = 0; i < rows * columns; ++i)
    a.push_back(generator.below(3) == 0 ? Integer(0) : Integer(generator.bits()) - Integer(generator.bits()));
  return a;
}

TEST(Fractions, DeterminantsAreThoseOfIndependentCode) {
  random::Generator generator(2);
  for (std::size_t n = 1; n <= 6; ++n)
    for (int round = 0; round < 30; ++round) {
      const std::vector<Integer> a = random_matrix(n, n, generator);
      test::Matrix m;
      for (std::size_t i = 0; i < n; ++i) {
        m.emplace_back();
        for (std::size_t j = 0; j < n; ++j) m.back().push_back(test::Integer(a[i * n + j]));
      }
      EXPECT_EQ(exact_determinant(a, n), Integer(test::determinant(m)));
    }
  EXPECT_EQ(exact_determinant({1, 2, 2, 4}, 2), 0);
}

TEST(Fractions, SolutionsSolveTheSystem) {
  random::Generator generator(3);
  for (std::size_t n = 1; n <= 6; ++n)
    for (int round = 0; round < 30; ++round) {
      const std::vector<Integer> augmented = random_matrix(n, n + 1, generator);
      std::vector<Integer> a;
      for (std::size_t i = 0; i < n; ++i)
        a.insert(a.end(), augmented.begin() + static_cast<std::ptrdiff_t>(i * (n + 1)),
                 augmented.begin() + static_cast<std::ptrdiff_t>(i * (n + 1) + n));
      if (exact_determinant(a, n) == 0) continue;
      const Fractions x = solve_exactly(augmented, n);
      ASSERT_EQ(x.numerators.size(), n);
      EXPECT_EQ(x.denominator, exact_determinant(a, n));
      for (std::size_t i = 0; i < n; ++i) {
        Integer sum = 0;
        for (std::size_t j = 0; j < n; ++j) sum += a[i * n + j] * x.numerators[j];
        EXPECT_EQ(sum, augmented[i * (n + 1) + n] * x.denominator);
      }
    }
}

TEST(NearestDouble, RoundsLikeTheHardware) {
  random::Generator generator(3);
  for (int i = 0; i < 20000; ++i) {
    const auto a = static_cast<double>(generator.below(2'000'001)) - 1e6,
               b = static_cast<double>(generator.below(1'000'000)) + 1;
    EXPECT_EQ(nearest_double(Integer(a), Integer(b), 0), a / b + 0.0);
    EXPECT_EQ(nearest_double(Integer(-a), Integer(-b), 0), a / b + 0.0);
  }
  EXPECT_EQ(nearest_double(Integer(1) << 53 | 1, 1, 0), 0x1p53);        // a tie goes to even
  EXPECT_EQ(nearest_double((Integer(1) << 53) + 3, 1, 0), 0x1p53 + 4);  // upwards, too
  EXPECT_EQ(nearest_double((Integer(1) << 200) + 1, Integer(1) << 147, 0), 0x1p53);
  EXPECT_EQ(nearest_double((Integer(1) << 253) + (Integer(1) << 200) + 1, Integer(1) << 200, 0), 0x1p53 + 2);
}

TEST(NearestDouble, EndsOfTheRange) {
  const double least = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max();
  EXPECT_EQ(nearest_double(1, 1, -1074), least);
  EXPECT_EQ(nearest_double(1, 2, -1074), 0);  // a tie
  EXPECT_FALSE(std::signbit(nearest_double(-1, 2, -1074)));
  EXPECT_EQ(nearest_double(-3, 4, -1074), -least);
  EXPECT_EQ(nearest_double(3, 2, -1074), 2 * least);
  EXPECT_EQ(nearest_double(1, 1, -1100), 0);
  EXPECT_EQ(nearest_double((Integer(1) << 53) - 1, 2, -1074),
            0x1p-1022);  // a tie between the last subnormal and the first normal
  EXPECT_EQ(nearest_double((Integer(1) << 53) - 1, 1, 971), most);
  EXPECT_EQ(nearest_double((Integer(1) << 54) - 1, 1, 970), INFINITY);
  EXPECT_EQ(nearest_double(1 - (Integer(1) << 54), 1, 970), -INFINITY);
}

TEST(RootAbove, IsTheLeastDoubleNotBelow) {
  EXPECT_EQ(root_above(0, 5, 3), 0);
  EXPECT_EQ(root_above(9, 4, 0), 1.5);
  EXPECT_EQ(root_above(9, 4, -1), 0.75);
  EXPECT_EQ(root_above(1, 1, 1023), 0x1p1023);
  EXPECT_EQ(root_above(4, 1, 1023), INFINITY);
  EXPECT_EQ(root_above((Integer(1) << 106) + 1, Integer(1) << 106, 0), std::nextafter(1.0, 2.0));
  EXPECT_EQ(root_above(2, 1, -1074), 2 * Limits::denorm_min());
  EXPECT_EQ(root_above(9, 1, -1074), 3 * Limits::denorm_min());
  EXPECT_EQ(root_above(10, 1, -1074), 4 * Limits::denorm_min());
  EXPECT_EQ(root_above(1, 16, -1074), Limits::denorm_min());
  EXPECT_EQ(root_above(1, 1, -3000), Limits::denorm_min());
  EXPECT_EQ(root_above(Integer(1) << 2000, 1, -2074), Limits::denorm_min());
  for (const std::int64_t units : {1LL, 5LL, 123456789LL, (1LL << 52) - 1, 1LL << 52, (1LL << 53) - 1}) {
    const double x = std::ldexp(static_cast<double>(units), -1074);
    const Integer square = Integer(units) * units;
    EXPECT_EQ(root_above(square, 1, -1074), x);
    EXPECT_EQ(root_above(square * 9 - 1, 9, -1074), x);
    EXPECT_EQ(root_above(square * 9 + 1, 9, -1074), std::nextafter(x, 1.0));
  }
  random::Generator generator(5);
  for (int i = 0; i < 5000; ++i) {
    const Integer a = Integer(generator.below(1'000'000'000) + 1) << generator.below(200),
                  b = Integer(generator.below(1'000'000'000) + 1) << generator.below(200);
    const double root = root_above(a, b, 0), before = std::nextafter(root, 0.0);
    constexpr int grid = -400;
    const Integer up = scaled_integer(root, grid), down = scaled_integer(before, grid);
    EXPECT_GE(up * up * b, a << -2 * grid);
    EXPECT_LT(down * down * b, a << -2 * grid);
    EXPECT_EQ(root_above(a * 6, b * 6, 0), root);
  }
}

}  // namespace
}  // namespace delone::kernel
