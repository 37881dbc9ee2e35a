// SPDX-License-Identifier: BSD-3-Clause
// Random rounds and random permutations: permutations, determined by the seed, rounds sorted.
#include "order/insertion_order.hpp"

#include "base/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace delone::order {
namespace {

std::vector<double> uniform_points(int d, std::size_t n, std::uint64_t seed) {
  random::Generator generator(seed);
  std::vector<double> x(n * static_cast<std::size_t>(d));
  for (double& v : x) v = generator.uniform();
  return x;
}

bool is_permutation(std::vector<Index> rows, std::size_t n) {
  if (rows.size() != n) return false;
  std::sort(rows.begin(), rows.end());
  for (std::size_t i = 0; i < n; ++i)
    if (rows[i] != i) return false;
  return true;
}

TEST(ShuffledOrder, IsAPermutationDeterminedByTheSeed) {
  for (std::size_t n : {0u, 1u, 2u, 3u, 1000u}) EXPECT_TRUE(is_permutation(shuffled_order(n, 5), n));
  EXPECT_EQ(shuffled_order(1000, 1), shuffled_order(1000, 1));
  EXPECT_NE(shuffled_order(1000, 1), shuffled_order(1000, 2));
}

TEST(ShuffledOrder, TheSameBitsOnEveryPlatform) {
  EXPECT_EQ(shuffled_order(8, 42), (std::vector<Index>{7, 0, 1, 4, 3, 5, 2, 6}));
}

TEST(ShuffledOrder, EveryPermutationIsAboutEquallyLikely) {
  std::vector<int> count(24);
  for (std::uint64_t seed = 0; seed < 24000; ++seed) {
    const auto p = shuffled_order(4, seed);
    std::size_t rank = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      rank *= 4 - i;
      for (std::size_t j = i + 1; j < 4; ++j) rank += p[j] < p[i];
    }
    ++count[rank];
  }
  double chi_squared = 0;
  for (int c : count) chi_squared += (c - 1000.0) * (c - 1000.0) / 1000.0;
  EXPECT_LT(chi_squared,
            50);  // 23 degrees of freedom: exceeded once in a thousand seeds, and the seeds are fixed
}

TEST(BrioOrder, IsAPermutationDeterminedByTheSeed) {
  for (int d : {1, 2, 3, 4, 5, 8, 100})
    for (std::size_t n : {0u, 1u, 2u, 3u, 191u, 1000u, 20000u}) {
      if (d == 100 && n == 20000) continue;
      const auto x = uniform_points(d, n, 3);
      const auto rows = brio_order(PointsView(x, d), 9);
      EXPECT_TRUE(is_permutation(rows, n)) << d << " " << n;
      EXPECT_EQ(rows, brio_order(PointsView(x, d), 9));
      if (n >= 1000 && d <= 8) {  // one round, when there are few points, is the same for every seed
        EXPECT_NE(rows, brio_order(PointsView(x, d), 10));
      }
    }
}

TEST(BrioOrder, AllPointsEqual) {
  const std::vector<double> x(3 * 5000, 1.0);
  EXPECT_TRUE(is_permutation(brio_order(PointsView(x, 3), 1), 5000));
}

TEST(BrioOrder, TheLastRoundIsSortedAndTheFirstPointsAreSpread) {
  const std::size_t n = 10000;
  const auto x = uniform_points(2, n, 21);
  const auto rows = brio_order(PointsView(x, 2), 4);
  double last_half = 0;
  for (std::size_t i = n / 2; i < n; ++i)
    last_half += std::hypot(x[2 * rows[i]] - x[2 * rows[i - 1]], x[2 * rows[i] + 1] - x[2 * rows[i - 1] + 1]);
  EXPECT_LT(last_half / (n / 2.0), 0.02);
  // Random rounds: the first 156 points (10000/64) reach into all quarters of the square, although each round
  // is sorted.
  int quarter[4] = {};
  for (std::size_t i = 0; i < 156; ++i) ++quarter[(x[2 * rows[i]] < 0.5) + 2 * (x[2 * rows[i] + 1] < 0.5)];
  for (int count : quarter) EXPECT_GT(count, 20);
}

TEST(SpreadOrder, IsAPermutationDeterminedByTheSeed) {
  for (int d : {1, 2, 3, 4, 5, 6, 8, 100})
    for (std::size_t n : {0u, 1u, 2u, 3u, 7u, 8u, 9u, 191u, 383u, 384u, 385u, 1000u, 6143u, 6145u, 20000u}) {
      if (d == 100 && n > 1000) continue;
      const auto x = uniform_points(d, n, 3);
      const auto rows = spread_order(PointsView(x, d), 9);
      EXPECT_TRUE(is_permutation(rows, n)) << d << " " << n;
      EXPECT_EQ(rows, spread_order(PointsView(x, d), 9));
      if (n >= 1000) {
        EXPECT_NE(rows, spread_order(PointsView(x, d), 10));
      }
    }
}

TEST(SpreadOrder, AnyFinitePoints) {
  for (const double scale : {0.0, 0x1p-1074, 1e-320, 1e-300, 1e300, 1.7e308}) {
    auto x = uniform_points(3, 3000, 5);
    for (double& c : x) c = scale * (2 * c - 1);
    EXPECT_TRUE(is_permutation(spread_order(PointsView(x, 3), 1), 3000)) << scale;
  }
  auto far_away = uniform_points(3, 3000, 6);
  far_away[0] = 1.7e308;
  far_away[3] = -1.7e308;
  EXPECT_TRUE(is_permutation(spread_order(PointsView(far_away, 3), 1), 3000));
}

/// The mean distance of the first m points to the nearest other one of them.
double spacing(const std::vector<double>& x, int d, const std::vector<Index>& rows, std::size_t m) {
  double sum = 0;
  for (std::size_t i = 0; i < m; ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < m; ++j) {
      double square = 0;
      for (std::size_t r = 0; r < static_cast<std::size_t>(d); ++r) {
        const double edge =
            x[rows[i] * static_cast<std::size_t>(d) + r] - x[rows[j] * static_cast<std::size_t>(d) + r];
        square += edge * edge;
      }
      if (i != j) least = std::min(least, square);
    }
    sum += std::sqrt(least);
  }
  return sum / static_cast<double>(m);
}

TEST(SpreadOrder, TheFirstPointsAreFurtherApartThanAtRandom) {
  for (int d : {3, 4, 5}) {
    const auto x = uniform_points(d, 4000, 8);
    const PointsView points(x, d);
    const auto spread = spread_order(points, 1), random = shuffled_order(4000, 1);
    for (const std::size_t m : {60u, 500u})  // the first points, and those before the last pass
      EXPECT_GT(spacing(x, d, spread, m), 1.2 * spacing(x, d, random, m)) << d << " " << m;
  }
}

TEST(SpreadOrder, ConsecutivePointsAreClose) {
  const std::size_t n = 20000;
  const auto x = uniform_points(3, n, 21);
  const auto rows = spread_order(PointsView(x, 3), 4);
  double sum = 0;
  for (std::size_t i = n / 2; i < n; ++i) {
    double square = 0;
    for (std::size_t r = 0; r < 3; ++r) square += std::pow(x[3 * rows[i] + r] - x[3 * rows[i - 1] + r], 2);
    sum += std::sqrt(square);
  }
  EXPECT_LT(sum / (n / 2.0), 0.1);  // at random 0.66
}

TEST(Generator, BelowIsInRangeForEveryKindOfBound) {
  random::Generator generator(1);
  for (std::uint64_t bound :
       {std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{3}, std::uint64_t{0xffffffffu},
        std::uint64_t{1} << 32, (std::uint64_t{1} << 32) + 1, ~std::uint64_t{0}})
    for (int i = 0; i < 1000; ++i) EXPECT_LT(generator.below(bound), bound);
}

TEST(Generator, MatchesTheReferenceImplementation) {
  // splitmix64 from state 1234567, as published with the algorithm; the first outputs seed the generator's
  // state.
  std::uint64_t state = 1234567;
  EXPECT_EQ(random::mix(state += 0x9e3779b97f4a7c15u), 6457827717110365317u);
  EXPECT_EQ(random::mix(state += 0x9e3779b97f4a7c15u), 3203168211198807973u);
}

}  // namespace
}  // namespace delone::order
