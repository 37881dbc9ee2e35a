// SPDX-License-Identifier: BSD-3-Clause
// Boxes near points, against all boxes.
#include "queries/box_tree.hpp"

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace delone::queries {
namespace {

/// How often each box is visited.
std::vector<int> visits(const BoxTree& tree, std::size_t n, const std::vector<double>& q, double radius) {
  std::vector<int> counts(n, 0);
  tree.visit(q.data(), radius, [&](std::size_t item) { ++counts[item]; });
  return counts;
}

TEST(BoxTree, VisitsEveryBoxThatIsNearOnce) {
  test::Random random(5);
  for (const std::size_t d : {1u, 2u, 3u, 6u})
    for (const std::size_t n : {1u, 4u, 5u, 100u})
      for (const bool is_lattice : {false, true}) {  // of small integers: many ties, and flat boxes
        const auto number = [&] { return is_lattice ? random.integer(0, 3) : random.real(); };
        std::vector<double> boxes;
        for (std::size_t i = 0; i < n; ++i) {
          std::vector<double> low, high;
          for (std::size_t j = 0; j < d; ++j) {
            const double a = number(), b = number();
            low.push_back(std::min(a, b));
            high.push_back(std::max(a, b));
          }
          boxes.insert(boxes.end(), low.begin(), low.end());
          boxes.insert(boxes.end(), high.begin(), high.end());
        }
        const BoxTree tree(boxes, d);
        for (int repeat = 0; repeat < 30; ++repeat) {
          std::vector<double> q;
          for (std::size_t j = 0; j < d; ++j) q.push_back(number());
          const double radius = repeat % 3 == 0 ? 0 : is_lattice ? 1 : 0.2 * random.real();
          const std::vector<int> found = visits(tree, n, q, radius);
          for (std::size_t i = 0; i < n; ++i) {
            double distance = 0;
            for (std::size_t j = 0; j < d; ++j)
              distance = std::max({distance, boxes[i * 2 * d + j] - q[j], q[j] - boxes[i * 2 * d + d + j]});
            EXPECT_EQ(found[i], distance <= radius ? 1 : 0) << i;
          }
        }
      }
}

TEST(BoxTree, OfNoBox) { EXPECT_TRUE(visits(BoxTree({}, 3), 0, {0, 0, 0}, 1e300).empty()); }

TEST(BoxTree, OfTheWholeRange) {
  constexpr double largest = std::numeric_limits<double>::max();
  // Sides and distances are beyond the largest double.
  std::vector<double> boxes;
  for (int i = 0; i < 9; ++i) boxes.insert(boxes.end(), {-largest, i < 5 ? -largest : largest});
  const BoxTree tree(boxes, 1);
  EXPECT_EQ(visits(tree, 9, {largest}, 0), (std::vector<int>{0, 0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(visits(tree, 9, {-largest}, 0), std::vector<int>(9, 1));
  // Half a unit in the last place is not told from none, and never in the wrong way.
  const BoxTree one({1, 2}, 1);
  const double below = std::nextafter(1.0, 0.0);
  EXPECT_EQ(visits(one, 1, {below}, 1 - below), std::vector<int>{1});
  EXPECT_EQ(visits(one, 1, {below}, 0), std::vector<int>{0});
}

}  // namespace
}  // namespace delone::queries
