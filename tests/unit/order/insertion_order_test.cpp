// SPDX-License-Identifier: BSD-3-Clause
// Random rounds and random permutations: permutations, determined by the seed, rounds sorted.
#include "order/insertion_order.hpp"

#include "base/random.hpp"
#include "order_support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace delone::order {
namespace {

TEST(ShuffledOrder, IsAPermutationDeterminedByTheSeed) {
  for (std::size_t n : {0u, 1u, 2u, 3u, 1000u}) EXPECT_TRUE(is_permutation(shuffled_order(n, 5), n));
  EXPECT_EQ(shuffled_order(1000, 1), shuffled_order(1000, 1));
  EXPECT_NE(shuffled_order(1000, 1), shuffled_order(1000, 2));
}

TEST(ShuffledOrder, TheSameBitsOnEveryPlatform) {
  EXPECT_EQ(shuffled_order(8, 42), (std::vector<Index>{7, 0, 1, 4, 3, 5, 2, 6}));
}

TEST(ShuffledOrder, IsThatOfFisherAndYates) {
  for (const std::size_t n : {5u, 31u, 32u, 33u, 34u, 65u, 5000u}) {
    std::vector<Index> expected(n);
    std::iota(expected.begin(), expected.end(), Index{0});
    random::Generator generator(7);
    for (std::size_t i = n; i > 1; --i) std::swap(expected[i - 1], expected[generator.below(i)]);
    EXPECT_EQ(shuffled_order(n, 7), expected);
  }
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

TEST(InsertionOrder, IsTheOneThatOptionsName) {
  const auto x = uniform_points(3, 200, 3);
  const PointsView points(x, 3);
  Options options;
  options.seed = 5;
  options.order = InsertionOrder::as_given;
  const auto given = insertion_order(points, options);
  for (std::size_t i = 0; i < 200; ++i) EXPECT_EQ(given[i], i);
  options.order = InsertionOrder::shuffled;
  EXPECT_EQ(insertion_order(points, options), shuffled_order(200, 5));
  options.order = InsertionOrder::automatic;
  EXPECT_EQ(insertion_order(points, options), automatic_order(points, 5));
  EXPECT_EQ(automatic_order(points, 5), spread_order(points, 5));
  const PointsView in_plane({x.data(), 200}, 2);
  EXPECT_EQ(automatic_order(in_plane, 5), brio_order(in_plane, 5));
}

}  // namespace
}  // namespace delone::order
