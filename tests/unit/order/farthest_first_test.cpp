// SPDX-License-Identifier: BSD-3-Clause
// Farthest points first: SIMD chooses the same points as a scalar loop.
#include "order/farthest_first.hpp"
#include "base/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace delone::order {
namespace {

/// The same without vectors, of integers so small that nothing is rounded.
std::vector<std::uint32_t> chosen_one_by_one(PointsView points, std::span<const Index> rows,
                                             std::size_t start, std::size_t count) {
  std::vector<double> distances(rows.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> chosen;
  for (std::size_t next = start; chosen.size() < count;) {
    chosen.push_back(static_cast<std::uint32_t>(next));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      double square = 0;
      for (int r = 0; r < points.dimension(); ++r) {
        const double edge =
            points[rows[i]][static_cast<std::size_t>(r)] - points[rows[next]][static_cast<std::size_t>(r)];
        square += edge * edge;
      }
      distances[i] = std::min(distances[i], square);
    }
    distances[next] = -1;
    next = static_cast<std::size_t>(std::max_element(distances.begin(), distances.end()) - distances.begin());
  }
  return chosen;
}

TEST(FarthestFirst, ChoosesWhatOneByOneIsChosen) {
  random::Generator generator(7);
  for (const int d : {1, 2, 3, 4, 5, 6, 9})
    for (const std::size_t n : {1u, 2u, 15u, 16u, 17u, 100u, 257u})
      for (const std::uint64_t bound : {3u, 257u}) {  // many ties and duplicates, or few
        std::vector<double> x((n + 3) * static_cast<std::size_t>(d));
        for (double& c : x) c = static_cast<double>(generator.below(bound));
        // The extent is a power of two, so that scaling rounds nothing.
        for (std::size_t r = 0; r < static_cast<std::size_t>(d); ++r) x[r] = 0;
        x[0] = static_cast<double>(bound - 1);
        x[static_cast<std::size_t>(d)] = 0;
        const PointsView points(x, d);
        std::vector<Index> rows(n);
        std::iota(rows.begin(), rows.end(), Index{0});
        std::reverse(rows.begin(), rows.end());
        FarthestFirst farthest(d, n + 20);
        for (const std::size_t count : {std::size_t{1}, (n + 1) / 2, n}) {
          std::vector<std::uint32_t> chosen(count);
          const std::size_t start = generator.below(n);
          farthest.choose(points, rows, start, chosen);
          EXPECT_EQ(chosen, chosen_one_by_one(points, rows, start, count)) << d << " " << n << " " << count;
        }
      }
}

TEST(FarthestFirst, StopsBetweenAnyPoints) {
  constexpr int d = 300;
  constexpr std::size_t n = 2000, count = 50;
  random::Generator generator(7);
  std::vector<double> x(n * d);
  for (double& c : x) c = static_cast<double>(generator.below(65));
  x[0] = 64, x[d] = 0;
  const PointsView points(x, d);
  std::vector<Index> rows(n);
  std::iota(rows.begin(), rows.end(), Index{0});
  FarthestFirst farthest(d, n);
  std::vector<std::uint32_t> chosen(count);
  std::size_t asked = 0;
  farthest.choose(points, rows, 5, chosen, [&] { ++asked; });
  EXPECT_GE(asked, 5u);
  EXPECT_EQ(chosen, chosen_one_by_one(points, rows, 5, count));
  EXPECT_THROW(farthest.choose(points, rows, 5, chosen,
                               [&] {
                                 if (--asked == 1) throw 1;
                               }),
               int);
}

TEST(FarthestFirst, PointsWithoutAUsableExtentAreChosenInOrder) {
  const std::vector<Index> rows{0, 1, 2, 3};
  for (const double scale : {0.0, 0x1p-1074, 1.7e308}) {
    const std::vector<double> x{0, scale, -scale, 0};
    std::vector<std::uint32_t> chosen(4);
    FarthestFirst(1, 4).choose(PointsView(x, 1), rows, 2, chosen);
    EXPECT_EQ(chosen, (std::vector<std::uint32_t>{2, 0, 1, 3})) << scale;
  }
}

}  // namespace
}  // namespace delone::order
