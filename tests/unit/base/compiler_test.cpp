// SPDX-License-Identifier: BSD-3-Clause
// What is there for every compiler, by another route: of the build with DELONE_PORTABLE its fallbacks.
#include "base/compiler.hpp"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <cstdint>
#include <limits>
#include <random>

namespace delone::internal {
namespace {

using Integer = boost::multiprecision::cpp_int;

constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();

/// Words whose halves are often all zeros or all ones.
class Words {
 public:
  std::uint64_t operator()() { return half() << 32 | half(); }

 private:
  std::uint64_t half() {
    switch (random_() % 4) {
      case 0:
        return random_() % 2;
      case 1:
        return 0xffffffff - random_() % 2;
      default:
        return random_();
    }
  }
  std::mt19937 random_{1};
};

TEST(Compiler, SwapsBytes) {
  EXPECT_EQ(byte_swap(0x0102030405060708), 0x0807060504030201u);
  EXPECT_EQ(byte_swap(0xff), 0xff00000000000000u);
}

TEST(Compiler, MultipliesAndAddsWithoutOverflow) {
  const TwoWords largest = multiply_add(most, most, most, most);
  EXPECT_EQ(largest.low, most);
  EXPECT_EQ(largest.high, most);
  Words word;
  for (int i = 0; i < 10000; ++i) {
    const std::uint64_t a = word(), b = word(), c = word(), d = word();
    const TwoWords found = multiply_add(a, b, c, d);
    EXPECT_EQ((Integer(found.high) << 64) + found.low, Integer(a) * b + c + d);
  }
}

TEST(Compiler, AddsAndSubtractsWithCarry) {
  Words word;
  for (int i = 0; i < 10000; ++i) {
    const std::uint64_t a = word(), b = i % 3 == 0 ? ~a : i % 3 == 1 ? a : word(), carry = word() % 2;
    const TwoWords sum = add(a, b, carry), difference = subtract(a, b, carry);
    EXPECT_EQ((Integer(sum.high) << 64) + sum.low, Integer(a) + b + carry);
    EXPECT_EQ(Integer(difference.low) - (Integer(difference.high) << 64), Integer(a) - b - carry);
  }
}

TEST(Compiler, ComputesInLanes) {
  using Pair = Lanes<double, 2>;
  const Pair a{1, -2}, b{3, 5};
  Pair sum = a + b;
  sum += a * b - (-b);
  EXPECT_EQ(sum[0], 1.0 + 3 + (3 + 3));
  EXPECT_EQ(sum[1], -2.0 + 5 + (-10 + 5));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Pair least = select(Pair{nan, 1} < Pair{1, nan}, Pair{1, 2}, Pair{3, 4});
  EXPECT_EQ(least[0], 3);
  EXPECT_EQ(least[1], 4);
  EXPECT_EQ(select(a > b, a, b)[1], 5);
  EXPECT_EQ(select(a >= a, a, b)[1], -2);
  EXPECT_EQ(select(b <= a, a, b)[0], 3);
  EXPECT_EQ(select(true, 1.0, 2.0), 1.0);

  using Ids = Lanes<std::uint32_t, 4>;
  Ids bits{};
  const Ids places = Ids{0, 1, 2, 3} + 4u;
  bits |= select(places == Ids{4, 4, 6, 6}, Ids{1, 2, 4, 8} << 4u, Ids{});
  bits |= select(places < 5u, Ids{1, 1, 1, 1}, Ids{});
  EXPECT_EQ(bits[0] | bits[1] << 8 | bits[2] << 16 | bits[3] << 24, 17u | 64u << 16);
}

TEST(Compiler, PrefetchesAnyAddress) {
  prefetch(nullptr);
  prefetch_for_writing(reinterpret_cast<const void*>(std::uintptr_t{16}));
}

}  // namespace
}  // namespace delone::internal
