// SPDX-License-Identifier: BSD-3-Clause
// Pairs may begin at any double, of which every second is not aligned for a vector of two.
#include "geometry/pair.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>

namespace delone::geometry {
namespace {

TEST(Pair, IsReadAndWrittenAtAnyDouble) {
  std::array<double, 4> numbers{0, 1, 2, 3};
  for (std::size_t i = 0; i < 3; ++i) {
    volatile std::size_t at = i;  // so that nothing about the address is known beforehand
    const Pair pair = load_pair(numbers.data() + at);
    EXPECT_EQ(pair[0], static_cast<double>(i));
    EXPECT_EQ(pair[1], static_cast<double>(i + 1));
    std::array<double, 4> copy{};
    store_pair(copy.data() + at, pair);
    EXPECT_EQ(copy[i], pair[0]);
    EXPECT_EQ(copy[i + 1], pair[1]);
  }
}

}  // namespace
}  // namespace delone::geometry
