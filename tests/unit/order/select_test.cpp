// SPDX-License-Identifier: BSD-3-Clause
// Selection on arrays of every shape, at every place.
#include "order/select.hpp"
#include "scale.hpp"

#include "base/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace delone::order {
namespace {

/// Distinct numbers, as no two elements may be equal.
std::vector<int> numbers(int shape, std::size_t n, random::Generator& generator) {
  std::vector<int> x(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto up = static_cast<int>(i), down = static_cast<int>(n - i);
    x[i] = shape == 1   ? down
           : shape == 2 ? (i % 2 == 0 ? up : -up)
           : shape == 3 ? (up < down ? 2 * up : 2 * down - 1)
                        : up;
  }
  if (shape == 4)
    for (std::size_t i = n; i > 1; --i) std::swap(x[i - 1], x[generator.below(i)]);
  return x;
}

TEST(Select, SplitsAtEveryPlace) {
  random::Generator generator(1);
  for (int shape = 0; shape < 5; ++shape)
    for (const std::size_t n :
         {std::size_t{2}, std::size_t{3}, std::size_t{8}, std::size_t{9}, std::size_t{10}, std::size_t{128},
          std::size_t{129}, std::size_t{1000}, std::size_t{5000}, test::scaled_size(70'000, 10'000)}) {
      const std::vector<int> original = numbers(shape, n, generator);
      std::vector<int> sorted = original;
      std::sort(sorted.begin(), sorted.end());
      ASSERT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end());
      for (std::size_t nth = 1; nth < n; nth = n <= 10 ? nth + 1 : nth * 3 + 1) {
        std::vector<int> x = original;
        split_at(x.data(), x.data() + nth, x.data() + n, std::less<>());
        const auto middle = x.begin() + static_cast<std::ptrdiff_t>(nth);
        ASSERT_LT(*std::max_element(x.begin(), middle), *std::min_element(middle, x.end()))
            << shape << ' ' << n;
        std::sort(x.begin(), x.end());
        ASSERT_EQ(x, sorted);
      }
    }
}

TEST(Select, PartitionsBelowThePivot) {
  std::vector<int> x{5, 1, 4, 2, 3, 0};
  for (const int pivot : {-1, 0, 3, 5, 9}) {
    int* const boundary = partition_below(x.data(), x.data() + x.size(), pivot, std::less<>());
    EXPECT_TRUE(std::all_of(x.data(), boundary, [&](int y) { return y < pivot; }));
    EXPECT_TRUE(std::all_of(boundary, x.data() + x.size(), [&](int y) { return y >= pivot; }));
  }
}

}  // namespace
}  // namespace delone::order
