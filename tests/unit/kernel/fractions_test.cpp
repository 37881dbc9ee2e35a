// SPDX-License-Identifier: BSD-3-Clause
// Correct rounding of fractions, and exact linear systems.
#include "kernel/fractions.hpp"

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace delone::internal {
namespace {

TEST(NearestDouble, RoundsLikeTheHardware) {
  test::Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const auto a = static_cast<double>(random.integer(-1000000, 1000000)),
               b = static_cast<double>(random.integer(1, 1000000));
    EXPECT_EQ(kernel::nearest_double(kernel::Integer(a), kernel::Integer(b), 0), a / b + 0.0);
    EXPECT_EQ(kernel::nearest_double(kernel::Integer(-a), kernel::Integer(-b), 0), a / b + 0.0);
  }
  EXPECT_EQ(kernel::nearest_double(kernel::Integer(1) << 53 | 1, 1, 0), 0x1p53);        // a tie goes to even
  EXPECT_EQ(kernel::nearest_double((kernel::Integer(1) << 53) + 3, 1, 0), 0x1p53 + 4);  // upwards, too
  EXPECT_EQ(kernel::nearest_double((kernel::Integer(1) << 200) + 1, kernel::Integer(1) << 147, 0), 0x1p53);
  EXPECT_EQ(kernel::nearest_double((kernel::Integer(1) << 253) + (kernel::Integer(1) << 200) + 1,
                                   kernel::Integer(1) << 200, 0),
            0x1p53 + 2);
}

TEST(NearestDouble, EndsOfTheRange) {
  const double least = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max();
  EXPECT_EQ(kernel::nearest_double(1, 1, -1074), least);
  EXPECT_EQ(kernel::nearest_double(1, 2, -1074), 0);  // a tie
  EXPECT_FALSE(std::signbit(kernel::nearest_double(-1, 2, -1074)));
  EXPECT_EQ(kernel::nearest_double(-3, 4, -1074), -least);
  EXPECT_EQ(kernel::nearest_double(3, 2, -1074), 2 * least);
  EXPECT_EQ(kernel::nearest_double(1, 1, -1100), 0);
  EXPECT_EQ(kernel::nearest_double((kernel::Integer(1) << 53) - 1, 2, -1074),
            0x1p-1022);  // a tie between the last subnormal and the first normal
  EXPECT_EQ(kernel::nearest_double((kernel::Integer(1) << 53) - 1, 1, 971), most);
  EXPECT_EQ(kernel::nearest_double((kernel::Integer(1) << 54) - 1, 1, 970), INFINITY);
  EXPECT_EQ(kernel::nearest_double(1 - (kernel::Integer(1) << 54), 1, 970), -INFINITY);
}

TEST(SolveExactly, InAnyPivotOrder) {
  test::Random random(1);
  for (std::size_t n = 1; n <= 6; ++n)
    for (int run = 0; run < 50; ++run) {
      std::vector<kernel::Integer> system, matrix;
      for (std::size_t i = 0; i < n * (n + 1); ++i) system.emplace_back(random.integer(-2, 2));
      for (std::size_t i = 0; i < n; ++i)
        matrix.insert(matrix.end(), system.begin() + static_cast<std::ptrdiff_t>(i * (n + 1)),
                      system.begin() + static_cast<std::ptrdiff_t>(i * (n + 1) + n));
      const kernel::Integer det = kernel::exact_determinant(matrix, n);
      if (det == 0) continue;
      const kernel::Fractions x = kernel::solve_exactly(system, n);
      EXPECT_EQ(x.denominator, det);
      for (std::size_t i = 0; i < n; ++i) {
        kernel::Integer sum = 0;
        for (std::size_t j = 0; j < n; ++j) sum += system[i * (n + 1) + j] * x.numerators[j];
        EXPECT_EQ(sum, system[i * (n + 1) + n] * det);
      }
    }
}

}  // namespace
}  // namespace delone::internal
