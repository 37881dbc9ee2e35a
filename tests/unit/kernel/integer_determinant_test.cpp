// SPDX-License-Identifier: BSD-3-Clause
// Both ways to the sign of a determinant of integers, against sums over permutations and against each other.
#include "kernel/integer_determinant.hpp"

#include "degenerate.hpp"
#include "kernel/fractions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace delone::kernel {
namespace {

Sign sign_by_permutations(const std::vector<Integer>& a, int n) {
  std::vector<int> columns(static_cast<std::size_t>(n));
  std::iota(columns.begin(), columns.end(), 0);
  Integer sum(0);
  do {
    Integer product(1);
    for (int r = 0; r < n; ++r) {
      product *= a[static_cast<std::size_t>(r * n + columns[static_cast<std::size_t>(r)])];
      for (int s = 0; s < r; ++s)
        if (columns[static_cast<std::size_t>(s)] > columns[static_cast<std::size_t>(r)]) product = -product;
    }
    sum += product;
  } while (std::next_permutation(columns.begin(), columns.end()));
  return sign_of_integer(sum);
}

/// Entries in −range … range: of small ones many determinants are zero, and many pivots are.
TEST(IntegerDeterminant, SmallMatrices) {
  test::Random random(4);
  int zeros = 0;
  for (int n = 1; n <= 5; ++n)
    for (const int range : {1, 2, 1000})
      for (int round = 0; round < 60; ++round) {
        std::vector<Integer> a(static_cast<std::size_t>(n * n));
        for (Integer& x : a) x = random.integer(-range, range);
        const Sign expected = sign_by_permutations(a, n);
        EXPECT_EQ(sign_by_integer_minors(a, n), expected);
        EXPECT_EQ(sign_by_integer_elimination(a, n), expected);
        zeros += expected == Sign::zero ? 1 : 0;
      }
  EXPECT_GT(zeros, 50);
}

/// Large entries, and rows that are combinations of others: the sign is lost unless every digit counts.
TEST(IntegerDeterminant, NearlyDependentRows) {
  test::Random random(5);
  for (int n = 2; n <= 7; ++n)
    for (int round = 0; round < 10; ++round) {
      const auto size = static_cast<std::size_t>(n);
      std::vector<Integer> a(size * size);
      for (Integer& x : a) x = Integer(random.bits() >> 1) << random.integer(0, 40);
      for (std::size_t c = 0; c < size; ++c) a[c] = 3 * a[size + c] - (n > 2 ? a[2 * size + c] : Integer(0));
      EXPECT_EQ(sign_by_integer_minors(a, n), Sign::zero);
      EXPECT_EQ(sign_by_integer_elimination(a, n), Sign::zero);
      for (const int change : {1, -1}) {
        std::vector<Integer> b = a;
        b[static_cast<std::size_t>(random.integer(0, n - 1))] += change;
        const Sign sign = sign_by_integer_minors(b, n);
        EXPECT_EQ(sign_by_integer_elimination(b, n), sign);
        for (std::size_t c = 0; c < size; ++c) std::swap(b[c], b[size + c]);
        EXPECT_EQ(sign_by_integer_elimination(b, n), -sign);
      }
    }
}

}  // namespace
}  // namespace delone::kernel
