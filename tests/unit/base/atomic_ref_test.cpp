// SPDX-License-Identifier: BSD-3-Clause
#include "base/atomic_ref.hpp"

#include "base/parallel.hpp"

#include <delone/types.hpp>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::internal {
namespace {

constexpr auto relaxed = std::memory_order_relaxed;

TEST(AtomicRef, ReadsAndWritesTheObject) {
  std::uint8_t byte = 3;
  const AtomicRef<std::uint8_t> ref(byte);
  EXPECT_EQ(ref.load(std::memory_order_acquire), 3);
  ref.store(5, std::memory_order_release);
  EXPECT_EQ(byte, 5);
  EXPECT_EQ(ref.fetch_add(2, relaxed), 5);
  EXPECT_EQ(byte, 7);
}

TEST(AtomicRef, ExchangesWhatIsExpected) {
  CellId cell{4};
  const AtomicRef<CellId> ref(cell);
  CellId expected{5};
  EXPECT_FALSE(ref.compare_exchange_weak(expected, CellId{6}, relaxed));
  EXPECT_EQ(expected, CellId{4});
  while (!ref.compare_exchange_weak(expected, CellId{6}, relaxed)) {
  }
  EXPECT_EQ(cell, CellId{6});
}

TEST(AtomicRef, ThreadsLoseNoAddition) {
  std::vector<Index> counts(3, 0);
  parallel_for(4, 30000, 100, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) AtomicRef<Index>(counts[i % 3]).fetch_add(1, relaxed);
  });
  EXPECT_EQ(counts, std::vector<Index>(3, 10000));
}

}  // namespace
}  // namespace delone::internal
