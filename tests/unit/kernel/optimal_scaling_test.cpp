// SPDX-License-Identifier: BSD-3-Clause
// Optimal scalings against all permutations.
#include "kernel/optimal_scaling.hpp"

#include "base/random.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace delone::kernel {
namespace {

/// The largest sum of exponents over all permutations without a zero, or exponent_of_zero.
std::int64_t largest_term(const std::vector<std::int64_t>& exponents, std::size_t n) {
  std::vector<std::size_t> column(n);
  std::iota(column.begin(), column.end(), std::size_t{0});
  std::int64_t largest = exponent_of_zero;
  do {
    std::int64_t sum = 0;
    bool has_zero = false;
    for (std::size_t i = 0; i < n; ++i) {
      sum += exponents[i * n + column[i]];
      has_zero = has_zero || exponents[i * n + column[i]] == exponent_of_zero;
    }
    if (!has_zero) largest = std::max(largest, sum);
  } while (std::next_permutation(column.begin(), column.end()));
  return largest;
}

TEST(OptimalScaling, IsThatOfTheLargestTerm) {
  random::Generator generator(1);
  std::size_t singular = 0;
  for (std::size_t round = 0; round < test::scaled_count(600); ++round) {
    const std::size_t n = 1 + generator.below(6);
    const std::uint64_t zeros = generator.below(4), range = generator.coin() ? 4 : 4000;
    std::vector<std::int64_t> exponents(n * n);
    for (auto& e : exponents)
      e = generator.below(4) < zeros ? exponent_of_zero
                                     : static_cast<std::int64_t>(generator.below(range)) - 2000;
    std::int64_t row[6], column[6];
    const std::int64_t largest = largest_term(exponents, n);
    const bool has_term = scale_optimally(exponents, static_cast<int>(n), row, column);
    ASSERT_EQ(has_term, largest != exponent_of_zero);
    singular += has_term ? 0 : 1;
    if (!has_term) continue;
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      sum += row[i] + column[i];
      for (std::size_t j = 0; j < n; ++j) ASSERT_LE(exponents[i * n + j], row[i] + column[j]);
    }
    ASSERT_EQ(sum, largest);  // so one permutation is tight
  }
  EXPECT_GT(singular, 0u);
}

}  // namespace
}  // namespace delone::kernel
