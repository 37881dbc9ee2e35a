// SPDX-License-Identifier: BSD-3-Clause
// The bound on the defect of an approximate inverse, against rationals.
#include "kernel/linear_bound.hpp"

#include "base/random.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace delone::kernel {
namespace {

using Rational = boost::multiprecision::cpp_rational;

/// The largest row sum of |I − inverse·A|, over all A whose entries differ from a's by at most a relative u.
Rational true_defect(const std::vector<double>& a, const std::vector<double>& inverse, std::size_t n) {
  Rational largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    Rational row = 0;
    for (std::size_t j = 0; j < n; ++j) {
      Rational entry = i == j ? 1 : 0, magnitudes = 0;
      for (std::size_t m = 0; m < n; ++m) {
        const Rational product = Rational(inverse[i * n + m]) * Rational(a[m * n + j]);
        entry -= product;
        magnitudes += abs(product);
      }
      row += abs(entry) + magnitudes * Rational(0x1p-53);
    }
    largest = std::max(largest, row);
  }
  return largest;
}

/// N is n, or 0 for run time.
template <int N>
void expect_bounded_defects(std::size_t n) {
  random::Generator generator(n);
  for (std::size_t round = 0; round < test::scaled_count(40); ++round) {
    std::vector<double> a(n * n), inverse(n * n);
    for (double& x : a) x = 2 * generator.uniform() - 1;
    if (round % 4 == 1)  // nearly singular
      for (std::size_t j = 0; j < n; ++j) a[j] = a[(n - 1) * n + j] * (1 + 1e-7 * generator.uniform());
    if (round % 4 == 2)  // rows of very different sizes
      for (std::size_t j = 0; j < n; ++j) a[j] *= 0x1p-20;
    std::vector<double> factored = a;
    ASSERT_TRUE((approximate_inverse<N>(factored.data(), inverse.data(), n)));
    const double defect = inverse_defect<N>(a.data(), inverse.data(), n);
    EXPECT_GE(Rational(defect), true_defect(a, inverse, n));
    if (round % 4 == 0) {
      EXPECT_LT(defect, 1e-8);
    }
  }
}

TEST(LinearBound, HoldsForTheTrueDefect) {
  expect_bounded_defects<2>(2);
  expect_bounded_defects<3>(3);
  expect_bounded_defects<5>(5);
  expect_bounded_defects<0>(1);
  expect_bounded_defects<0>(6);
}

TEST(LinearBound, NothingIsProvedOfSingularMatricesAndOfNaN) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> inverse(16);
  for (const std::vector<double>& singular :
       {std::vector<double>{1, 2, 2, 4}, {0, 0, 0, 0}, {1, 1, NAN, 1}, {1e-200, 0, 0, 1e-200}}) {
    std::vector<double> a = singular;
    if (approximate_inverse<2>(a.data(), inverse.data(), 2)) {
      EXPECT_EQ(inverse_defect<2>(singular.data(), inverse.data(), 2), infinity);
    }
    a = singular;
    if (approximate_inverse<0>(a.data(), inverse.data(), 2)) {
      EXPECT_TRUE(singular[0] == 1e-200 || inverse_defect<0>(singular.data(), inverse.data(), 2) == infinity);
    }
  }
  std::vector<double> zero_column{1, 0, 2, 0};
  EXPECT_FALSE(approximate_inverse<0>(zero_column.data(), inverse.data(), 2));
}

}  // namespace
}  // namespace delone::kernel
