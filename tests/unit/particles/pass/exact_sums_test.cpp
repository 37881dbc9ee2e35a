// SPDX-License-Identifier: BSD-3-Clause
// Exact sums give the same bits for every order of the terms, one by one and in SIMD lanes.
#include "particles/pass/exact_sums.hpp"

#include "particles/pass/pieces_kernel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace delone::particles {
namespace {

std::vector<double> terms_of(std::size_t count, int spread, std::mt19937& random) {
  std::vector<double> terms(count);
  for (double& x : terms)
    x = std::ldexp(std::uniform_real_distribution<>(-1, 1)(random),
                   std::uniform_int_distribution<>(-spread, 0)(random));
  return terms;
}

TEST(ExactSums, AnyOrder) {
  std::mt19937 random(1);
  for (const std::size_t count : {1, 2, 7, 24, 300, 5000})
    for (const int spread : {0, 10, 60}) {
      std::vector<double> terms = terms_of(count, spread, random);
      if (count > 2) terms[count - 1] = -terms[0];
      long double sum = 0;
      for (const double x : terms) sum += x;
      std::vector<double> copy = terms;
      const double first = exact_sum(copy);
      EXPECT_NEAR(first, static_cast<double>(sum),
                  1e-15 * std::max(1.0, std::sqrt(static_cast<double>(count))));
      for (int round = 0; round < 5; ++round) {
        std::shuffle(terms.begin(), terms.end(), random);
        copy = terms;
        EXPECT_EQ(exact_sum(copy), first);
      }
    }
  std::vector<double> none;
  EXPECT_EQ(exact_sum(none), 0);
  std::vector<double> tiny{0x1p-1074, -0x1p-1060, 0x1p-1074}, vast{0x1p1000, 0x1p999};
  EXPECT_EQ(exact_sum(tiny), 2 * 0x1p-1074 - 0x1p-1060);
  EXPECT_EQ(exact_sum(vast), 0x1p1000 + 0x1p999);
}

/// Sums of columns in SIMD lanes are those of single columns, and two levels leave only a tiny remainder.
TEST(ExactSums, Lanes) {
  std::mt19937 random(2);
  for (const std::size_t count : {1, 5, 8, 9, 24, 700}) {
    const std::size_t stride = (count + 7) / 8 * 8, k = 2, d = 2;
    std::vector<double> pieces((k + d) * stride, 1e10),
        first_parts(k * stride);  // what is behind the end is no term
    for (std::size_t i = 0; i < k + d; ++i)
      std::ranges::copy(terms_of(count, 30, random),
                        pieces.begin() + static_cast<std::ptrdiff_t>(i * stride));
    const std::vector<double> given = pieces;
    double moment[2];
    split_pieces(k, d, count, stride, pieces.data(), first_parts.data(), moment);
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t c = 0; c < count; ++c)
        EXPECT_NEAR(first_parts[i * stride + c] + pieces[i * stride + c], given[i * stride + c], 1e-17);
    for (std::size_t j = 0; j < d; ++j) {
      long double sum = 0;
      for (std::size_t c = 0; c < count; ++c) sum += given[(k + j) * stride + c];
      EXPECT_NEAR(moment[j], static_cast<double>(sum), 1e-14);
    }
  }
}

}  // namespace
}  // namespace delone::particles
