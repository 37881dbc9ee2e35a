// SPDX-License-Identifier: BSD-3-Clause
// Spread orders: permutations determined by the seed, early points far apart, consecutive ones close.
#include "order/insertion_order.hpp"
#include "order_support.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace delone::order {
namespace {

TEST(SpreadOrder, IsAPermutationDeterminedByTheSeed) {
  for (int d : {1, 2, 3, 4, 5, 6, 8, 100})
    for (std::size_t n : {0u, 1u, 2u, 3u, 7u, 8u, 9u, 191u, 383u, 384u, 385u, 1000u, 6143u, 6145u, 20000u}) {
      if (n > test::scaled_size(d == 100 ? 1000 : 20'000, d == 100 ? 200 : 1000)) continue;
      const auto x = uniform_points(d, n, 3);
      const auto rows = spread_order(PointsView(x, d), 9);
      EXPECT_TRUE(is_permutation(rows, n)) << d << " " << n;
      EXPECT_EQ(rows, spread_order(PointsView(x, d), 9));
      if (n >= 1000) {
        EXPECT_NE(rows, spread_order(PointsView(x, d), 10));
      }
    }
}

TEST(SpreadOrder, DoesNotDependOnThreads) {
  for (const int d : {1, 2, 3, 4, 5, 6})
    for (const std::size_t n : {40u, 3000u, 20000u}) {
      if (n > test::scaled_size(20'000, 3000)) continue;
      const auto x = uniform_points(d, n, 4);
      const PointsView points(x, d);
      std::vector<std::size_t> rounds, rounds_of_brio;
      const auto rows = spread_order(points, 1, &rounds),
                 rows_of_brio = brio_order(points, 1, &rounds_of_brio);
      for (const unsigned threads : {2u, 3u, 8u}) {
        std::vector<std::size_t> rounds_in_threads;
        EXPECT_EQ(spread_order(points, 1, &rounds_in_threads, threads), rows) << d << " " << n;
        EXPECT_EQ(rounds_in_threads, rounds);
        rounds_in_threads.clear();
        EXPECT_EQ(brio_order(points, 1, &rounds_in_threads, threads), rows_of_brio) << d << " " << n;
        EXPECT_EQ(rounds_in_threads, rounds_of_brio);
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

}  // namespace
}  // namespace delone::order
