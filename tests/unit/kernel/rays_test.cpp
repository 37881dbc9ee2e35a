// SPDX-License-Identifier: BSD-3-Clause
// The order of rays, by hand and against rationals.
#include "kernel/rays.hpp"

#include "row_case.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace delone::kernel {
namespace {

constexpr double tiny = std::numeric_limits<double>::denorm_min();
constexpr double huge = std::numeric_limits<double>::max();

TEST(Rays, AreOrderedLikePointsAndWhateverTheirLength) {
  const auto less = [](std::vector<double> a, std::vector<double> b) {
    EXPECT_EQ(compare_rays(a.data(), b.data(), static_cast<int>(a.size())) < 0,
              compare_rays(b.data(), a.data(), static_cast<int>(a.size())) > 0);
    return compare_rays(a.data(), b.data(), static_cast<int>(a.size())) < 0;
  };
  const auto same = [](std::vector<double> a, std::vector<double> b) {
    return compare_rays(a.data(), b.data(), static_cast<int>(a.size())) == 0;
  };
  EXPECT_TRUE(less({1, 5, 1}, {2, 0, 1}));
  EXPECT_TRUE(less({2, 0, 2}, {3, 0, 2}));
  EXPECT_TRUE(less({2, 0, 2}, {1.5, 0, 1}));
  EXPECT_TRUE(less({9, 9, -1}, {0, 0, 1})) << "negative before positive";
  EXPECT_TRUE(less({9, 9, 0}, {0, 0, -1})) << "a zero at the end comes first";
  EXPECT_TRUE(less({-5, 0, 0}, {3, 0, 0}));
  EXPECT_TRUE(same({1, 2, 3}, {3, 6, 9}));
  EXPECT_TRUE(same({0.1, 0.3, 0}, {0x1p-900 * 0.1, 0x1p-900 * 0.3, 0}));
  EXPECT_TRUE(same({0, 0.0, 4}, {-0.0, 0, 1}));
  EXPECT_FALSE(same({1, 2, 3}, {-1, -2, -3}));
  EXPECT_TRUE(less({0.1, 0.3}, {std::nextafter(0.1, 1), 0.3}));
  EXPECT_TRUE(less({tiny, huge}, {2 * tiny, huge}));
  EXPECT_TRUE(less({tiny, huge}, {huge, tiny}));
  EXPECT_TRUE(less({-huge, tiny}, {-tiny, huge}));
  EXPECT_TRUE(same({3 * tiny, tiny}, {3e300, 1e300}))
      << "3e300 is three times 1e300 rounded: " << (3e300 == 3 * 1e300);
}

TEST(Rays, OrderAgreesWithRationals) {
  random::Generator generator(4);
  using Rational = boost::multiprecision::cpp_rational;
  for (std::size_t round = 0; round < test::scaled_count(3000); ++round) {
    std::vector<double> a = random_numbers(3, round % 6, generator),
                        b = random_numbers(3, (round / 6) % 6, generator);
    if (a[2] == 0 || b[2] == 0) continue;
    if (round % 2 == 0) b[0] = a[0], b[2] = a[2];  // decided later
    const auto key = [](const std::vector<double>& row) {
      const Rational unit = abs(Rational(row[2]));
      return std::vector<Rational>{Rational(row[2] < 0 ? -1 : 1), Rational(row[0]) / unit,
                                   Rational(row[1]) / unit};
    };
    const auto order = compare_rays(a.data(), b.data(), 3);
    EXPECT_EQ(order < 0, key(a) < key(b));
    EXPECT_EQ(order == 0, key(a) == key(b));
  }
}

}  // namespace
}  // namespace delone::kernel
