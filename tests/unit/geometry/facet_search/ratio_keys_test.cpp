// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/facet_search/ratio_keys.hpp"

#include "base/random.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace delone::geometry {
namespace {

/// The key of h/v as the search computes it, with these lowest bits.
std::int32_t key_of(float h, float v, std::int32_t place) {
  return ((std::bit_cast<std::int32_t>(h) - std::bit_cast<std::int32_t>(v)) & ~place_mask) | place;
}

/// Numbers of all magnitudes that heights and values have; among them those whose logarithm is exact, and
/// those where its error is largest.
std::vector<float> samples() {
  const auto worst = static_cast<float>(1 / std::log(2.0));
  std::vector<float> numbers;
  for (int e = -39; e < 40; e += 13)
    for (const float m : {1.0f, std::nextafter(2.0f, 1.0f), worst, std::nextafter(worst, 2.0f), 1.25f})
      numbers.push_back(std::ldexp(m, e));
  random::Generator generator(1);
  for (int i = 0; i < 50; ++i)
    numbers.push_back(static_cast<float>(std::exp2(78 * generator.uniform() - 39)));
  return numbers;
}

TEST(RatioKeys, BoundRatiosFromBothSides) {
  for (const float h : samples())
    for (const float v : samples())
      for (const std::int32_t place : {0, 511, place_mask}) {
        const double ratio = static_cast<double>(h) / v;
        const std::int32_t key = key_of(h, v, place);
        ASSERT_LE(ratio_below(key - 1), ratio) << h << '/' << v;
        ASSERT_GE(ratio_below(key + doubt), ratio) << h << '/' << v;
        ASSERT_LE(key, key_above(h / v)) << h << '/' << v;
        // Not by far too much: three times the error of a logarithm.
        ASSERT_GE(ratio_below(key), ratio * 0.8) << h << '/' << v;
        ASSERT_GE(key + octave / 3, key_above(h / v)) << h << '/' << v;
      }
}

TEST(RatioKeys, TheLeastRatioIsWithinDoubtOfTheLeastKey) {
  const std::vector<float> numbers = samples();
  for (std::size_t i = 0; i + 3 < numbers.size(); ++i)
    for (std::size_t j = 0; j + 3 < numbers.size(); ++j) {
      // h/v and a ratio that is a little smaller.
      const float h = numbers[i], v = numbers[j], w = numbers[j + 1], g = std::nextafter(h / v * w, 0.0f);
      if (static_cast<double>(g) / w > static_cast<double>(h) / v) continue;
      ASSERT_LE(key_of(g, w, place_mask), key_of(h, v, 0) + doubt) << h << '/' << v << ' ' << g << '/' << w;
    }
}

TEST(RatioKeys, KeysOfVerticesThatAreNotBeyondAreOutOfReach) {
  const auto height = std::bit_cast<std::int32_t>(std::nextafter(least_height, 1.0f));
  EXPECT_GT(height & ~place_mask, largest_key);  // the value counts as 0
  EXPECT_GT(key_of(out_of_reach, 0x1p40f, 0), largest_key);
  EXPECT_EQ(key_above(-1), key_above(0));
}

}  // namespace
}  // namespace delone::geometry
