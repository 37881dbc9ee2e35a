// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/int128.hpp"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <cstdint>
#include <limits>

namespace delone::kernel {
namespace {

TEST(Int128, TellsItsMagnitude) {
  const Int128 one(1), large = (one << 100) + (one << 63) + 5;
  for (const Int128& x : {large, Int128(-large)}) {
    EXPECT_EQ(magnitude(x).low, (std::uint64_t{1} << 63) + 5);
    EXPECT_EQ(magnitude(x).high, std::uint64_t{1} << 36);
  }
  EXPECT_EQ(magnitude(Int128(0)).low, 0u);
  EXPECT_EQ(magnitude(Int128(-1)).low, 1u);
  EXPECT_EQ(magnitude(Int128(-1)).high, 0u);
}

TEST(Int128, HoldsProductsOfMantissas) {
  const std::int64_t a = -((std::int64_t{1} << 53) - 1), b = (std::int64_t{1} << 62) + 1;
  const Int128 product = static_cast<Int128>(a) * b;
  const auto [low, high] = magnitude(product);
  const boost::multiprecision::cpp_int expected = -boost::multiprecision::cpp_int(a) * b;
  EXPECT_EQ((boost::multiprecision::cpp_int(high) << 64) + low, expected);
  EXPECT_TRUE(product < 0);
  EXPECT_TRUE(product / a == b);
}

}  // namespace
}  // namespace delone::kernel
