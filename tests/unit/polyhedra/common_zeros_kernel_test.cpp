// SPDX-License-Identifier: BSD-3-Clause
// Overlaps of sets of bits against a loop, from any first set on and for every number of words.
#include "polyhedra/common_zeros_kernel.hpp"

#include "base/random.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

namespace delone::polyhedra {
namespace {

TEST(FindOverlaps, AgreesWithALoop) {
  random::Generator generator(1);
  for (const std::size_t words : {1u, 2u, 5u})
    for (const std::size_t size : {1u, 7u, 31u, 32u, 33u, 100u}) {
      const std::size_t stride = (size + 31) / 32 * 32;
      std::vector<std::uint64_t> sets(words * stride);
      // What is beyond the last set has all members, and is never found.
      for (std::size_t i = 0; i < sets.size(); ++i)
        sets[i] = i % stride < size ? generator.bits() & generator.bits() : ~std::uint64_t{0};
      std::vector<std::uint64_t> set(words);
      for (std::size_t w = 0; w < words; ++w) set[w] = w == 1 ? 0 : generator.bits();
      for (const std::size_t first : {std::size_t{0}, size / 2, size - 1, size})
        for (const std::uint32_t least : {0u, 1u, 14u, 40u}) {
          std::vector<Overlap> expected, found{{77, 88}};
          for (std::size_t i = first; i < size; ++i) {
            std::uint32_t count = 0;
            for (std::size_t w = 0; w < words; ++w)
              count += static_cast<std::uint32_t>(std::popcount(set[w] & sets[w * stride + i]));
            if (count >= least) expected.push_back({static_cast<std::uint32_t>(i), count});
          }
          find_overlaps(sets.data(), stride, size, set, first, least, found);
          ASSERT_EQ(found.size(), expected.size() + 1)
              << words << " " << size << " " << first << " " << least;
          EXPECT_EQ(found[0].set, 77u) << "what was there stays";
          for (std::size_t i = 0; i < expected.size(); ++i) {
            EXPECT_EQ(found[i + 1].set, expected[i].set);
            EXPECT_EQ(found[i + 1].count, expected[i].count);
          }
        }
    }
}

TEST(FindOverlaps, OfAnEmptySetAreZero) {
  const std::vector<std::uint64_t> sets(32, ~std::uint64_t{0}), none(1, 0);
  std::vector<Overlap> found;
  find_overlaps(sets.data(), 32, 3, none, 0, 1, found);
  EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace delone::polyhedra
