// SPDX-License-Identifier: BSD-3-Clause
// Signs that are called certain are right, whatever the size of the numbers, and rows before the first one
// that the ray is certainly beyond are all accounted for.
#include "polyhedra/sign_kernel.hpp"

#include "cone_support.hpp"
#include "polyhedra/bit_rows.hpp"
#include "polyhedra/ray_numbers.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace delone::polyhedra {
namespace {

TEST(SignKernel, CertainSignsAreRight) {
  random::Generator generator(5);
  int certain = 0, open_rows = 0, zero_rows = 0;
  for (int round = 0; round < 3000; ++round) {
    const std::size_t d = 1 + generator.below(7), m = 1 + generator.below(150);
    const Integer largest = Integer(1)
                            << std::vector<int>{1, 20, 60, 400, 514, 600, 1200}[generator.below(7)];
    Rows rows = random_rows(generator, m, d, largest);
    Row ray = random_rows(generator, 1, d, largest).front();
    if (generator.coin())  // few rows are beyond
      for (Row& row : rows)
        if (scalar_product(row, ray) < 0 && generator.below(40) != 0)
          for (Integer& x : row) x = -x;
    const RoundedRows rounded_rows(m, d,
                                   [&](std::size_t row, std::size_t c) { return rounded(rows[row][c]); });
    std::vector<double> rounded_ray;
    for (const Integer& x : ray) rounded_ray.push_back(rounded(x));
    const std::size_t first = generator.below(m);
    std::vector<std::uint64_t> zeros(words_for(m), 0), open(words_for(m), 0);
    const std::size_t end = find_signs(rounded_rows, rounded_ray, first, zeros, open);
    ASSERT_LE(end, m);
    for (std::size_t row = 0; row < m; ++row) {
      const int sign = scalar_product(rows[row], ray).sign();
      if (row < first || row >= end) {
        EXPECT_FALSE(test(zeros, row) || test(open, row));
        EXPECT_TRUE(row != end || sign < 0);
        continue;
      }
      if (test(open, row)) {
        ++open_rows;
        EXPECT_FALSE(test(zeros, row));
        continue;
      }
      ++certain;
      zero_rows += sign == 0;
      EXPECT_EQ(sign, test(zeros, row) ? 0 : 1);
    }
  }
  EXPECT_GT(certain, 1000);
  EXPECT_GT(zero_rows, 100);
  EXPECT_GT(open_rows, 1000);
}

}  // namespace
}  // namespace delone::polyhedra
