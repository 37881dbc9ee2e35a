// SPDX-License-Identifier: BSD-3-Clause
// Sums of keys tell sets of numbers apart, and fit their words.
#include "engine/hole/facet_keys.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace delone::engine {
namespace {

/// All sums of the digits of k numbers below p, in words that are divided before digit `second`.
template <int K>
void expect_different_sums(std::uint64_t p, int second) {
  std::set<std::pair<std::uint64_t, std::uint64_t>> sums;
  std::size_t num_sets = 0;
  const auto choose = [&](const auto& self, std::uint64_t from, int left, std::uint64_t one,
                          std::uint64_t two) -> void {
    if (left == 0) {
      ++num_sets;
      sums.insert({one, two});
      return;
    }
    for (std::uint64_t v = from; v < p; ++v)
      self(self, v + 1, left - 1, one + FacetKeys<K>::digits(v, p, 1, second - 1),
           two + FacetKeys<K>::digits(v, p, second, K));
  };
  choose(choose, 0, K, 0, 0);
  EXPECT_EQ(sums.size(), num_sets) << K << ", " << p << ", " << second;
}

TEST(FacetKeys, HaveDifferentSums) {
  expect_different_sums<1>(101, 2);
  expect_different_sums<2>(101, 3);
  expect_different_sums<2>(101, 2);
  expect_different_sums<3>(47, 4);
  expect_different_sums<3>(47, 3);
  expect_different_sums<4>(29, 5);
  expect_different_sums<4>(29, 3);
  expect_different_sums<5>(23, 6);
  expect_different_sums<5>(23, 4);
  expect_different_sums<6>(19, 7);
  expect_different_sums<7>(17, 5);
  expect_different_sums<8>(17, 5);
}

template <int K>
void expect_room() {
  for (const int words : {1, 2}) {
    const std::uint64_t p = FacetKeys<K>::prime(words);
    const long double base = static_cast<long double>(K) * static_cast<long double>(p - 1) + 1;
    const int digits = words == 1 ? K : (K + 1) / 2;
    long double largest = 1;
    for (int i = 0; i < digits; ++i) largest *= base;
    EXPECT_LE(largest, 0x1p63L) << K;
    for (std::uint64_t d = 2; d * d <= p; ++d) EXPECT_NE(p % d, 0u) << K;
    // The powers of −1 alternate, and the second of two words goes on where the first ends.
    std::uint64_t place = 1, word = 0;
    int which = 0;
    for (int j = 1; j <= K; ++j) {
      word += (j % 2 == 1 ? p - 1 : 1) * place;
      place *= static_cast<std::uint64_t>(base);
      if (j < K && (words == 1 || j != digits)) continue;
      EXPECT_EQ(FacetKeys<K>::word(p - 1, words, which), word) << K << ", word " << which << " of " << words;
      ++which;
      word = 0;
      place = 1;
    }
  }
}

TEST(FacetKeys, FitTheirWords) {
  expect_room<1>();
  expect_room<2>();
  expect_room<3>();
  expect_room<4>();
  expect_room<5>();
  expect_room<6>();
  expect_room<7>();
  expect_room<8>();
  EXPECT_EQ(FacetKeys<6>::prime(1), 241u);
  EXPECT_GT(FacetKeys<5>::prime(1), 1000u);
  EXPECT_GT(FacetKeys<8>::prime(2), 6000u);
}

}  // namespace
}  // namespace delone::engine
