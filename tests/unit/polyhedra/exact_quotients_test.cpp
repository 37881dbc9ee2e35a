// SPDX-License-Identifier: BSD-3-Clause
// Exact quotients against integers of any size: they are found where there are some, and only there.
#include "polyhedra/exact_quotients.hpp"

#include "cone_support.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace delone::polyhedra {
namespace {

using kernel::Int128;

#if DELONE_HAS_INT128

Integer power(int bits) { return Integer(1) << bits; }

Int256 as_256(const Integer& x) {
  const Integer rest = x < 0 ? Integer(x + power(256)) : x;
  return {static_cast<Int256::Word>(Integer(rest % power(128))),
          static_cast<Int256::Word>(Integer(rest / power(128)))};
}

TEST(ExactQuotients, ProductsAndSums) {
  random::Generator generator(1);
  for (int round = 0; round < 20000; ++round) {
    const auto factor = [&] {
      return random_integer(generator, power(static_cast<int>(generator.below(127))) - 1);
    };
    const Integer a = factor(), b = factor(), c = factor(), d = factor();
    const Int256 first = product_256(static_cast<Int128>(a), static_cast<Int128>(b)),
                 second = product_256(static_cast<Int128>(c), static_cast<Int128>(d));
    ASSERT_EQ(first, as_256(a * b));
    ASSERT_EQ(sum_256(first, second), as_256(a * b + c * d));
  }
}

TEST(ExactQuotients, QuotientsThatExist) {
  random::Generator generator(2);
  int others = 0;
  for (int round = 0; round < 20000; ++round) {
    const Integer quotient = random_integer(generator, power(static_cast<int>(generator.below(127))) - 1);
    Integer divisor = 1 + abs(random_integer(generator, power(static_cast<int>(generator.below(80)))));
    divisor <<= generator.below(40);
    const ExactDivisor by(static_cast<Int128>(divisor));
    Int128 found = 0;
    ASSERT_TRUE(by.try_divide(as_256(quotient * divisor), found));
    ASSERT_EQ(Integer(found), quotient);
    const Integer rest = Integer(generator.below(1000)) % divisor;
    if (rest == 0) continue;
    ++others;
    ASSERT_FALSE(by.try_divide(as_256(quotient * divisor + rest), found));
  }
  EXPECT_GT(others, 10000);
}

TEST(ExactQuotients, QuotientsThatAreTooLarge) {
  Int128 found = 0;
  for (const int shift : {0, 1, 63, 64, 100}) {
    const Integer divisor = Integer(3) << shift;
    const ExactDivisor by(static_cast<Int128>(divisor));
    EXPECT_TRUE(by.try_divide(as_256(divisor * (power(127) - 1)), found));
    EXPECT_TRUE(by.try_divide(as_256(divisor * -power(127)), found));
    EXPECT_FALSE(by.try_divide(as_256(divisor * power(127)), found));
    EXPECT_FALSE(by.try_divide(as_256(divisor * (power(127) * 5 + 2)), found));
    EXPECT_FALSE(by.try_divide(as_256(divisor * power(128)), found));
  }
}

TEST(ExactQuotients, OfCombinations) {
  const std::vector<std::int64_t> p{6, -9, 0, 12}, n{3, 3, 3, -3};
  std::vector<std::int64_t> out(4);
  EXPECT_TRUE(try_exact_quotients(p.data(), n.data(), 5, 2, 3, 4, 58, out.data()));
  EXPECT_EQ(out, (std::vector<std::int64_t>{9, -1, 5, 3}));
  EXPECT_FALSE(try_exact_quotients(p.data(), n.data(), 5, 2, 6, 4, 58, out.data()));
  EXPECT_TRUE(try_exact_quotients(p.data(), n.data(), 5, 2, 3, 4, 4, out.data()));
  EXPECT_FALSE(try_exact_quotients(p.data(), n.data(), 5, 2, 3, 4, 3, out.data()));
}

#endif

}  // namespace
}  // namespace delone::polyhedra
