// SPDX-License-Identifier: BSD-3-Clause
// The certified path of centers against the exact one, one cell at a time and in SIMD lanes.
#include "solve/cell_center.hpp"

#include "degenerate.hpp"

#include <delone/predicates.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace delone::solve {
namespace {

class CenterOfDimension : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, CenterOfDimension, ::testing::Range(1, 9));

// What the certified path answers must be the double that integers give, on easy and on nearly flat
// simplices.
TEST_P(CenterOfDimension, CertifiedEqualsExact) {
  const int d = GetParam();
  const auto size = static_cast<std::size_t>(d);
  std::vector<int> axes(size);
  std::iota(axes.begin(), axes.end(), 0);
  CenterFinder fast(d, axes, true), slow(d, axes, false);
  test::Random random(static_cast<std::uint64_t>(d));
  std::uint64_t num_easy = 0;
  for (int run = 0; run < 400; ++run) {
    std::vector<double> x, weights;
    const int kind = run % 4;
    for (std::size_t i = 0; i <= size; ++i) {
      for (std::size_t j = 0; j < size; ++j)
        x.push_back(kind == 0   ? random.real()
                    : kind == 1 ? random.integer(-3, 3)
                    : kind == 2 ? 1e6 + random.real()
                    : j == 0    ? std::ldexp(random.real(), -40)  // nearly flat
                                : random.real() - 0.5);
      weights.push_back(run % 8 < 4 ? 0 : random.real());
    }
    if (orientation(x, d) == Sign::zero) continue;
    std::vector<const double*> points;
    for (std::size_t i = 0; i <= size; ++i) points.push_back(x.data() + i * size);
    std::vector<double> a(size), b(size);
    const std::uint64_t before = fast.num_exact();
    fast.find(points.data(), weights.data(), a.data());
    if (kind == 0) num_easy += fast.num_exact() - before;
    slow.find(points.data(), weights.data(), b.data());
    EXPECT_EQ(a, b) << "run " << run;
    EXPECT_TRUE(fast.on_sphere(points.data(), weights.data(), points[0], weights[0]));
    EXPECT_FALSE(fast.on_sphere(points.data(), weights.data(), points[0], weights[0] + 0x1p-30));
  }
  EXPECT_GT(slow.num_exact(), 0u);
  // The middle of two doubles is often halfway between two doubles, which no bound on an error can decide.
  EXPECT_LE(num_easy, d == 1 ? 50u : 2u) << "the certified path gives up on random simplices";
}

// At both ends of the range, and with magnitudes of all kinds in one cell.
TEST_P(CenterOfDimension, ExtremeCells) {
  const int d = GetParam();
  const auto size = static_cast<std::size_t>(d);
  std::vector<int> axes(size);
  std::iota(axes.begin(), axes.end(), 0);
  CenterFinder fast(d, axes, true), slow(d, axes, false);
  test::Random random(static_cast<std::uint64_t>(d) + 200);
  for (int run = 0; run < 60; ++run) {
    std::vector<double> x, weights;
    for (std::size_t i = 0; i <= size; ++i) {
      for (std::size_t j = 0; j < size; ++j)
        x.push_back(run % 6 == 0   ? 1e300 * (random.real() - 0.5)
                    : run % 6 == 1 ? 1e-300 * random.real()
                    : run % 6 == 2 ? std::ldexp(random.integer(-9, 9), -1074)  // denormal
                    : run % 6 == 3 ? std::ldexp(random.real(), random.integer(-400, 400))
                    : run % 6 == 4 ? 1 + std::ldexp(random.integer(-3, 3), -52)
                                   : random.integer(-1, 1) * (run % 4 < 2 ? 1e-150 : 1e150));
      weights.push_back(run % 4 == 0 ? 1e300 : std::ldexp(random.real(), random.integer(-1000, 1000)));
    }
    if (orientation(x, d) == Sign::zero) continue;
    std::vector<const double*> points;
    for (std::size_t i = 0; i <= size; ++i) points.push_back(x.data() + i * size);
    for (const double* w :
         {static_cast<const double*>(nullptr), static_cast<const double*>(weights.data())}) {
      std::vector<double> one(size), block(size), exact(size);
      fast.find(points.data(), w, one.data());
      fast.find_block(1, points.data(), w, block.data());
      slow.find(points.data(), w, exact.data());
      EXPECT_EQ(one, exact) << "run " << run;
      EXPECT_EQ(block, exact) << "run " << run;
    }
  }
}

// Within the stated bound of integers, on easy and on nearly flat simplices far from the origin.
TEST_P(CenterOfDimension, OffsetsAreWithinTheirBound) {
  const int d = GetParam();
  const auto size = static_cast<std::size_t>(d);
  std::vector<int> axes(size);
  std::iota(axes.begin(), axes.end(), 0);
  const CenterFinder finder(d, axes, true);
  test::Random random(static_cast<std::uint64_t>(d));
  for (int run = 0; run < 200; ++run) {
    std::vector<double> x, offset(size);
    for (std::size_t i = 0; i < (size + 1) * size; ++i)
      x.push_back(run % 3 == 0    ? random.real()
                  : run % 3 == 1  ? 1e6 + random.real()
                  : i % size == 0 ? std::ldexp(random.real(), run % 60 - 70)
                                  : random.real());
    if (orientation(x, d) == Sign::zero) continue;
    std::vector<const double*> points;
    for (std::size_t i = 0; i <= size; ++i) points.push_back(x.data() + i * size);
    finder.find_offset(points.data(), offset.data());
    const CenterFinder::ExactOffset exact = finder.find_offset_exactly(points.data());
    for (std::size_t j = 0; j < size; ++j) {
      double extent = 0;
      for (const double* p : points) extent = std::max(extent, std::fabs(p[j] - points[0][j]));
      // The difference, times 2^1074 or the denominator.
      const kernel::Integer rounded = kernel::scaled_integer(offset[j], -1074) * exact.twice.denominator * 2;
      const kernel::Integer difference = (exact.twice.numerators[j] << (exact.grid + 1074)) - rounded;
      const double error = kernel::nearest_double(difference, exact.twice.denominator * 2, -1074);
      EXPECT_LE(std::fabs(error), 0x1p-53 * (1.25 * std::fabs(offset[j]) + 0.25 * extent) * 1.0001);
    }
  }
}

// Blocks of all sizes, by SIMD for d = 2, 3: from lattices, nearly flat cells and the ends of the range, all
// in one block.
TEST_P(CenterOfDimension, BlocksEqualSingleCells) {
  const int d = GetParam();
  const auto size = static_cast<std::size_t>(d);
  std::vector<int> axes(size);
  std::iota(axes.begin(), axes.end(), 0);
  CenterFinder blocks(d, axes, true), slow(d, axes, false);
  test::Random random(static_cast<std::uint64_t>(d) + 100);
  std::size_t kind = 0;
  for (std::size_t count = 1; count <= CenterFinder::block; ++count) {
    std::vector<std::vector<double>> cells;
    while (cells.size() < count) {
      const int scale = ++kind % 13 == 0 ? -900 : kind % 17 == 0 ? 480 : 0;
      std::vector<double> x;
      for (std::size_t i = 0; i < (size + 1) * size; ++i)
        x.push_back(kind % 4 == 0                    ? random.real()
                    : kind % 4 == 1                  ? std::ldexp(random.integer(-3, 3), scale)
                    : kind % 4 == 2                  ? 1e6 + random.real()
                    : i % size == 0 && kind % 8 == 3 ? std::ldexp(random.real(), -40)
                                                     : std::ldexp(random.real() - 0.5, scale));
      if (orientation(x, d) != Sign::zero) cells.push_back(x);
    }
    std::vector<const double*> points;
    for (const auto& x : cells)
      for (std::size_t i = 0; i <= size; ++i) points.push_back(x.data() + i * size);
    std::vector<double> found(count * size), expected(count * size);
    blocks.find_block(count, points.data(), nullptr, found.data());
    for (std::size_t c = 0; c < count; ++c)
      slow.find(points.data() + c * (size + 1), nullptr, expected.data() + c * size);
    EXPECT_EQ(found, expected) << count << " cells";
  }
  // Two points of a line are the corners of a box.
  if (size > 1)
    EXPECT_LT(blocks.num_exact(), slow.num_exact());
  else
    EXPECT_EQ(slow.num_exact(), 0u);
}

}  // namespace
}  // namespace delone::solve
