// SPDX-License-Identifier: BSD-3-Clause
#include "base/growable_array.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>

namespace delone::internal {
namespace {

TEST(GrowableArray, KeepsEntriesAcrossHeapAndMappedMemory) {
  for (const auto& [is_prepared, pages] :
       {std::pair{false, Pages::usual}, {true, Pages::usual}, {true, Pages::large}}) {
    GrowableArray<std::uint32_t> array(pages);
    std::size_t filled = 0;
    for (std::size_t size = 10; size < 20'000'000; size = size * 5 / 2) {
      array.reserve(size);
      ASSERT_GE(array.capacity(), size);
      for (; filled < size; filled += 7) {
        if (is_prepared) array.prepare(filled + 1);
        array[filled] = static_cast<std::uint32_t>(filled);
      }
      if (is_prepared) array.prepare(array.capacity());
      for (std::size_t i = 0; i < filled; i += 7) ASSERT_EQ(array[i], i);
    }
    GrowableArray<std::uint32_t> moved = std::move(array);
    EXPECT_EQ(array.capacity(), 0u);
    EXPECT_EQ(moved[7], 7u);
    array = std::move(moved);
    array.prepare(array.capacity());
    EXPECT_EQ(array[7], 7u);
  }
}

// Entries whose size does not divide that of a page.
TEST(GrowableArray, HoldsEntriesOfAnySize) {
  GrowableArray<std::array<std::uint8_t, 7>> array(Pages::large);
  for (const std::size_t size :
       {std::size_t{2}, std::size_t{149'796}, std::size_t{149'797}, std::size_t{700'000}}) {
    array.reserve(size);
    array.prepare(size);
    array[0].fill(1);
    array[size - 1].fill(static_cast<std::uint8_t>(size));
    array.prepare(array.capacity());
    if (array.capacity() > size) array[array.capacity() - 1].fill(9);
    EXPECT_EQ(array[size - 1][6], static_cast<std::uint8_t>(size));
    EXPECT_EQ(array[0][0], 1);
  }
}

TEST(GrowableArray, ShrinksAndGrowsAgain) {
  for (const Pages pages : {Pages::usual, Pages::large}) {
    GrowableArray<std::uint32_t> array(pages);
    array.shrink(0);
    EXPECT_EQ(array.capacity(), 0u);
    array.reserve(6'000'000);
    array.prepare(6'000'000);
    for (std::uint32_t i = 0; i < 6'000'000; ++i) array[i] = i;
    array.shrink(7'000'000);
    EXPECT_GE(array.capacity(), 6'000'000u);
    for (const std::size_t size : {std::size_t{3'000'000}, std::size_t{1000}}) {
      array.shrink(size);
      EXPECT_GE(array.capacity(), size);
      EXPECT_LE(array.capacity(), size + 1'048'576);
      for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(array[i], i);
    }
    array.reserve(2'000'000);
    array.prepare(2'000'000);
    array[1'999'999] = 5;
    for (std::size_t i = 0; i < 1000; ++i) ASSERT_EQ(array[i], i);
  }
}

TEST(GrowableArray, DiscardsNothingBesides) {
  for (const std::size_t size : {std::size_t{1000}, std::size_t{1'000'000}}) {
    GrowableArray<std::uint32_t> array;
    array.reserve(size);
    for (std::size_t i = 0; i < size; ++i) array[i] = static_cast<std::uint32_t>(i);
    array.discard(0, 0);
    array.discard(size / 10 + 1, size / 2 + 1);
    array.discard(size / 2 + 1, size / 2 + 3);
    for (std::size_t i = 0; i < size; ++i)
      if (i <= size / 10 || i >= size / 2 + 3) {
        ASSERT_EQ(array[i], i);
      }
    array[size / 4] = 7;  // may be written again
    EXPECT_EQ(array[size / 4], 7u);
  }
}

TEST(GrowableArray, ImpossibleMemoryChangesNothing) {
  GrowableArray<double> array;
  array.reserve(100);
  array[99] = 1;
  EXPECT_THROW(array.reserve(static_cast<std::size_t>(-1) / 2), std::bad_alloc);
  EXPECT_THROW(array.reserve(std::size_t{1} << 50), std::bad_alloc);
  EXPECT_EQ(array[99], 1);
}

}  // namespace
}  // namespace delone::internal
