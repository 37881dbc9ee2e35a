// SPDX-License-Identifier: BSD-3-Clause
// Which of two powers is less, against fractions.
#include "queries/powers.hpp"

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace delone::queries {
namespace {

using Fraction = boost::multiprecision::cpp_rational;

Fraction exact_power(const std::vector<double>& q, const std::vector<double>& p, double weight) {
  Fraction sum = -Fraction(weight);
  for (std::size_t j = 0; j < q.size(); ++j) {
    const Fraction difference = Fraction(q[j]) - Fraction(p[j]);
    sum += difference * difference;
  }
  return sum;
}

TEST(Powers, AreComparedAsFractionsAre) {
  test::Random random(6);
  int certain = 0, undecided = 0, ties = 0;
  for (int repeat = 0; repeat < 600; ++repeat) {
    const std::size_t d = 1 + static_cast<std::size_t>(repeat % 4);
    const double scale = std::ldexp(1.0, (repeat / 4 % 3 - 1) * 300);
    // Far from the origin or not; at few places, so that there are ties; now and then one unit beside them.
    const double offset = repeat % 5 == 0 ? 1e6 : 0;
    const auto number = [&] {
      const double x = offset + random.integer(-2, 2);
      return scale * (random.integer(0, 5) == 0 ? std::nextafter(x, 1e9) : x);
    };
    std::vector<double> q, a, b;
    for (std::size_t j = 0; j < d; ++j) {
      q.push_back(number());
      a.push_back(number());
      b.push_back(number());
    }
    const double weight_a = scale * scale * random.integer(-2, 2),
                 weight_b = scale * scale * random.integer(-2, 2);
    const Fraction of_a = exact_power(q, a, weight_a), of_b = exact_power(q, b, weight_b);
    const Power rounded_a = power(q.data(), a.data(), d, weight_a),
                rounded_b = power(q.data(), b.data(), d, weight_b);
    if (certainly_less(rounded_a, rounded_b, d)) {
      ASSERT_LT(of_a, of_b) << repeat;
      ++certain;
    } else if (of_a < of_b) {
      ++undecided;
    }
    const Sign sign = compare_exactly(q.data(), a.data(), b.data(), d, weight_a, weight_b);
    ASSERT_EQ(sign, of_a < of_b ? Sign::negative : of_b < of_a ? Sign::positive : Sign::zero) << repeat;
    ties += sign == Sign::zero ? 1 : 0;
  }
  EXPECT_GT(certain, 100);
  EXPECT_GT(ties, 10);
  EXPECT_LT(undecided, certain / 4);
}

TEST(Powers, BeyondTheRangeProveNothing) {
  const std::vector<double> q{1e200}, a{0.0}, b{-1e200};
  const Power of_a = power(q.data(), a.data(), 1, 0), of_b = power(q.data(), b.data(), 1, 0);
  EXPECT_FALSE(certainly_less(of_a, of_b, 1));
  EXPECT_FALSE(certainly_less(of_b, of_a, 1));
  EXPECT_EQ(compare_exactly(q.data(), a.data(), b.data(), 1, 0, 0), Sign::negative);
  // Squares that underflow.
  const std::vector<double> zero{0.0}, tiny{1e-170};
  const Power of_zero = power(zero.data(), zero.data(), 1, 0),
              of_tiny = power(zero.data(), tiny.data(), 1, 0);
  EXPECT_FALSE(certainly_less(of_zero, of_tiny, 1));
  EXPECT_EQ(compare_exactly(zero.data(), zero.data(), tiny.data(), 1, 0, 0), Sign::negative);
}

}  // namespace
}  // namespace delone::queries
