// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/lattice_reduction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace delone::periodic {
namespace {

using kernel::Integer;

Integer square(const std::vector<Integer>& rows, std::size_t rank, std::size_t i) {
  return gram_matrix(rows, rank)[i * rank + i];
}

TEST(LatticeReduction, DoublesAreIntegersOnTheirGrid) {
  const std::vector<double> numbers{1.5, -0.25, 0, 3};
  const IntegerRows rows = integers_of(numbers);
  EXPECT_EQ(rows.grid, -2);
  EXPECT_EQ(rows.entries, (std::vector<Integer>{6, -1, 0, 12}));
}

TEST(LatticeReduction, SkewedVectorsBecomeShort) {
  std::vector<Integer> rows{1, 0, 1000000007, 1};
  const std::vector<Integer> sums = reduce_lattice(rows, 2);
  EXPECT_EQ(square(rows, 2, 0), 1);
  EXPECT_EQ(square(rows, 2, 1), 1);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(sums[2 * i] + sums[2 * i + 1] * 1000000007, rows[2 * i]);
    EXPECT_EQ(sums[2 * i + 1], rows[2 * i + 1]);
  }
}

/// No vector of a reduced basis in space becomes shorter by sums of others with small factors, and the
/// determinant stays.
TEST(LatticeReduction, RandomBasesInSpace) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<Integer> rows;
    const int size = round % 2 == 0 ? 10 : 1000000;
    for (int i = 0; i < 9; ++i)
      rows.emplace_back(static_cast<int>(random() % static_cast<unsigned>(2 * size)) - size);
    const Integer before = kernel::exact_determinant(rows, 3);
    if (before == 0) continue;
    reduce_lattice(rows, 3);
    EXPECT_EQ(abs(kernel::exact_determinant(rows, 3)), abs(before));
    for (std::size_t i = 0; i < 3; ++i)
      for (int a = -2; a <= 2; ++a)
        for (int b = -2; b <= 2; ++b) {
          std::vector<Integer> changed = rows;
          for (std::size_t j = 0; j < 3; ++j)
            changed[3 * i + j] += a * rows[3 * ((i + 1) % 3) + j] + b * rows[3 * ((i + 2) % 3) + j];
          EXPECT_GE(square(changed, 3, i), square(rows, 3, i));
        }
  }
}

}  // namespace
}  // namespace delone::periodic
