// SPDX-License-Identifier: BSD-3-Clause
// Each kind of integers gives what integers of any size give, or says that numbers are too large; up to its
// limits it does not say so.
#include "polyhedra/arithmetic.hpp"

#include "cone_support.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace delone::polyhedra {
namespace {

template <class T>
std::vector<T> converted(const Row& row) {
  std::vector<T> numbers(row.size());
  for (std::size_t i = 0; i < row.size(); ++i) EXPECT_TRUE(Arithmetic<T>::try_convert(row[i], numbers[i]));
  return numbers;
}

template <class T>
class ArithmeticTest : public ::testing::Test {};
using Limited = ::testing::Types<std::int64_t, Int128>;
TYPED_TEST_SUITE(ArithmeticTest, Limited);

TYPED_TEST(ArithmeticTest, ConvertsUpToItsLimit) {
  TypeParam x;
  const Integer limit = Integer(1) << Arithmetic<TypeParam>::most_bits;
  for (const Integer& fits : {Integer(0), Integer(limit - 1), Integer(1 - limit)}) {
    ASSERT_TRUE(Arithmetic<TypeParam>::try_convert(fits, x));
    EXPECT_EQ(Integer(x), fits);
  }
  EXPECT_FALSE(Arithmetic<TypeParam>::try_convert(limit, x));
  EXPECT_FALSE(Arithmetic<TypeParam>::try_convert(-limit, x));
}

TYPED_TEST(ArithmeticTest, CombinesAsIntegersOfAnySizeDo) {
  using Numbers = Arithmetic<TypeParam>;
  random::Generator generator(2);
  int combined = 0, refused = 0, products = 0;
  for (int round = 0; round < 20000; ++round) {
    const std::size_t d = 1 + generator.below(6);
    const int bits_of_row =
        1 + static_cast<int>(generator.below(static_cast<std::uint64_t>(Numbers::most_bits_of_rows)));
    const int bits = 1 + static_cast<int>(generator.below(static_cast<std::uint64_t>(Numbers::most_bits)));
    Row row, p, n;
    for (std::size_t i = 0; i < d; ++i) {
      row.push_back(random_integer(generator, (Integer(1) << bits_of_row) - 1));
      p.push_back(random_integer(generator, (Integer(1) << bits) - 1));
      n.push_back(random_integer(generator, (Integer(1) << bits) - 1));
    }
    Integer at_p = scalar_product(row, p), at_n = scalar_product(row, n);
    if (at_p == 0 || at_n == 0) continue;
    for (Integer& x : p) x *= at_p.sign();
    for (Integer& x : n) x *= -at_n.sign();
    at_p = abs(at_p);
    at_n = -abs(at_n);
    Integer largest = 0;  // of the combination, which is not 0 for two rays
    for (std::size_t i = 0; i < d; ++i)
      largest = std::max(largest, Integer(abs(Integer(at_p * n[i] - at_n * p[i]))));
    if (largest == 0) continue;
    const std::vector<TypeParam> a = converted<TypeParam>(row), x = converted<TypeParam>(p),
                                 y = converted<TypeParam>(n);
    Numbers numbers;
    numbers.set_rows(bits_of_row, d);
    typename Numbers::Product of_p, of_n;
    if (!numbers.try_product(a.data(), x.data(), d, of_p) ||
        !numbers.try_product(a.data(), y.data(), d, of_n)) {
      EXPECT_GT(std::max(bit_length(at_p), bit_length(at_n)), 120);
      continue;
    }
    ++products;
    ASSERT_EQ(Integer(of_p), at_p);
    ASSERT_EQ(Integer(of_n), at_n);
    std::vector<Integer> expected(d);
    Arithmetic<Integer>().try_combine(p.data(), n.data(), at_p, Integer(-at_n), 0, d, expected.data());
    std::vector<TypeParam> out(d);
    bool fits = true;
    for (const Integer& entry : expected) fits = fits && bit_length(entry) <= Numbers::most_bits;
    if (!numbers.try_combine(x.data(), y.data(), of_p, typename Numbers::Product(-of_n), 0, d, out.data())) {
      ++refused;
      if (std::is_same_v<TypeParam, Int128>) {  // the other refuses large factors, too
        EXPECT_FALSE(fits);
      }
      continue;
    }
    ++combined;
    ASSERT_TRUE(fits);
    for (std::size_t i = 0; i < d; ++i) ASSERT_EQ(Integer(out[i]), expected[i]);
  }
  EXPECT_GT(combined, 1000);
  EXPECT_GT(refused, 1000);
  EXPECT_GT(products, 5000);
}

/// Whatever divisor is proposed, the result is a multiple of the primitive vector, and that itself when made
/// primitive.
TYPED_TEST(ArithmeticTest, DivisorsThatAreRightOrWrong) {
  using Numbers = Arithmetic<TypeParam>;
  random::Generator generator(5);
  int multiples = 0;
  for (int round = 0; round < 20000; ++round) {
    const std::size_t d = 2 + generator.below(5);
    const int bits = 1 + static_cast<int>(generator.below(Numbers::most_bits / 2));
    Row p, n;
    for (std::size_t i = 0; i < d; ++i)
      for (Row* row : {&p, &n}) row->push_back(random_integer(generator, (Integer(1) << bits) - 1));
    const Integer content = 1 + generator.below(12), other = 1 + generator.below(12);
    for (Integer& x : p) x *= content;
    for (Integer& x : n) x *= other;
    const Integer at_p = content * (1 + abs(random_integer(generator, Integer(1) << bits))),
                  at_n = other * (1 + abs(random_integer(generator, Integer(1) << bits))),
                  divisor = (content * other) / (1 + generator.below(3));
    std::vector<Integer> expected(d), large(d);
    for (std::size_t i = 0; i < d; ++i) large[i] = at_p * n[i] + at_n * p[i];
    if (is_zero(large)) continue;  // not of two rays
    Arithmetic<Integer>::try_combine(p.data(), n.data(), at_p, at_n, 0, d, expected.data());
    const std::vector<TypeParam> x = converted<TypeParam>(p), y = converted<TypeParam>(n);
    std::vector<TypeParam> out(d);
    using Product = typename Numbers::Product;
    Numbers numbers;
    numbers.set_rows(bits, d);
    if (!numbers.try_combine(x.data(), y.data(), static_cast<Product>(at_p), static_cast<Product>(at_n),
                             static_cast<Product>(divisor), d, out.data()))
      continue;
    Arithmetic<Integer>::try_combine(p.data(), n.data(), at_p, at_n, divisor, d, large.data());
    multiples += large != expected;
    Numbers::make_primitive(out.data(), d);
    Arithmetic<Integer>::make_primitive(large.data(), d);
    ASSERT_EQ(large, expected);
    for (std::size_t i = 0; i < d; ++i) ASSERT_EQ(Integer(out[i]), expected[i]);
  }
  EXPECT_GT(multiples, 1000);
}

/// Products that are small or zero although all entries are large.
TYPED_TEST(ArithmeticTest, SignsOfWhatIsOpen) {
  using Numbers = Arithmetic<TypeParam>;
  random::Generator generator(3);
  for (int round = 0; round < 2000; ++round) {
    const int bits_of_row =
        2 + static_cast<int>(generator.below(static_cast<std::uint64_t>(Numbers::most_bits_of_rows - 2)));
    const Integer large = (Integer(1) << Numbers::most_bits) - 1, of_row = (Integer(1) << bits_of_row) - 1;
    const Integer u = random_integer(generator, of_row), x = random_integer(generator, large);
    const int step = static_cast<int>(generator.below(3)) - 1;
    // u·x − u·x + step
    const Row row{u, -u, Integer(step), 0}, ray{x, x, 1, large};
    Numbers numbers;
    numbers.set_rows(bits_of_row, 4);
    const std::vector<TypeParam> a = converted<TypeParam>(row), b = converted<TypeParam>(ray);
    EXPECT_EQ(numbers.sign_of_open(a.data(), b.data(), 4), step);
  }
}

}  // namespace
}  // namespace delone::polyhedra
