// SPDX-License-Identifier: BSD-3-Clause
#include "base/platform.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace delone::internal {
namespace {

constexpr std::size_t page = platform::usual_page;

TEST(Platform, MappedMemoryIsZeroAndKeepsItsContentsWhenItGrows) {
  if (!platform::maps_memory) GTEST_SKIP();
  auto* memory = static_cast<unsigned char*>(platform::map(2 * page));
  ASSERT_NE(memory, nullptr);
  EXPECT_EQ(std::count(memory, memory + 2 * page, 0), static_cast<std::ptrdiff_t>(2 * page));
  std::fill(memory, memory + 2 * page, static_cast<unsigned char>(7));
  memory = static_cast<unsigned char*>(platform::remap(memory, 2 * page, 100 * page));
  ASSERT_NE(memory, nullptr);
  EXPECT_EQ(std::count(memory, memory + 2 * page, 7), static_cast<std::ptrdiff_t>(2 * page));
  EXPECT_EQ(std::count(memory + 2 * page, memory + 100 * page, 0), static_cast<std::ptrdiff_t>(98 * page));
  platform::unmap(memory, 100 * page);
}

TEST(Platform, PopulatedMemoryKeepsItsContentsAndDiscardsOnlyWhatItShould) {
  if (!platform::maps_memory) GTEST_SKIP();
  auto* const memory = static_cast<unsigned char*>(platform::map(4 * page));
  ASSERT_NE(memory, nullptr);
  std::fill(memory, memory + 3 * page, static_cast<unsigned char>(7));
  platform::use_large_pages(memory, 4 * page, true);
  platform::populate(memory, 4 * page);
  platform::use_large_pages(memory, 4 * page, false);
  EXPECT_EQ(std::count(memory, memory + 4 * page, 7), static_cast<std::ptrdiff_t>(3 * page));
  platform::discard(memory + page, page);
  EXPECT_EQ(std::count(memory, memory + page, 7), static_cast<std::ptrdiff_t>(page));
  EXPECT_EQ(std::count(memory + 2 * page, memory + 3 * page, 7), static_cast<std::ptrdiff_t>(page));
  memory[page] = 8;  // may be written again
  EXPECT_EQ(memory[page], 8);
  platform::unmap(memory, 4 * page);
}

TEST(Platform, ImpossibleMemoryIsRefused) {
  if (!platform::maps_memory) GTEST_SKIP();
  EXPECT_EQ(platform::map(std::size_t{1} << 60), nullptr);
  auto* const memory = static_cast<unsigned char*>(platform::map(page));
  memory[0] = 7;
  EXPECT_EQ(platform::remap(memory, page, std::size_t{1} << 60), nullptr);
  EXPECT_EQ(memory[0], 7);
  platform::unmap(memory, page);
}

TEST(Platform, ClocksGoForward) {
  const double clock = platform::clock_seconds(), thread = platform::thread_seconds();
  volatile double work = 0;
  while (platform::thread_seconds() - thread < 1e-3) work = work + 1;
  EXPECT_GE(platform::clock_seconds() - clock, 0.5e-3);
  EXPECT_LT(platform::thread_seconds() - thread, 100);
}

TEST(Platform, TheFirstLevelCacheHasAPlausibleSize) {
  const std::size_t bytes = platform::first_level_cache();
  if (bytes != 0) {
    EXPECT_GE(bytes, std::size_t{4} << 10);
    EXPECT_LE(bytes, std::size_t{4} << 20);
  }
}

TEST(PriceOfLargePages, FewDearPagesAmongManyAreAccepted) {
  PriceOfLargePages price;
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(price.pay(i % 10 == 0 ? 3e-3 : 0.1e-3, 1, 0)) << i;
  EXPECT_TRUE(price.pay(50e-3, 100, 0));  // a long time, but for many
}

TEST(PriceOfLargePages, DearPagesAreSoonTooMuchForAll) {
  PriceOfLargePages price;
  int accepted = 0;
  while (price.pay(2e-3, 1, -100)) ++accepted;
  EXPECT_EQ(accepted, 2);
  EXPECT_FALSE(PriceOfLargePages::are_worth_trying(-99.5));
  EXPECT_TRUE(PriceOfLargePages::are_worth_trying(-98));
}

}  // namespace
}  // namespace delone::internal
