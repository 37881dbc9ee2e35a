// SPDX-License-Identifier: BSD-3-Clause
// The pieces of Voronoi diagrams one by one: correct rounding of fractions, the certified path of centres
// against the exact one, volumes of simple polytopes.
#include "voronoi/cell_center.hpp"
#include "degenerate.hpp"
#include "kernel/fractions.hpp"
#include "voronoi/simple_polytope.hpp"

#include <delone/predicates.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace delone::internal {
namespace {

TEST(NearestDouble, RoundsLikeTheHardware) {
  test::Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const auto a = static_cast<double>(random.integer(-1000000, 1000000)),
               b = static_cast<double>(random.integer(1, 1000000));
    EXPECT_EQ(kernel::nearest_double(kernel::Integer(a), kernel::Integer(b), 0), a / b + 0.0);
    EXPECT_EQ(kernel::nearest_double(kernel::Integer(-a), kernel::Integer(-b), 0), a / b + 0.0);
  }
  EXPECT_EQ(kernel::nearest_double(kernel::Integer(1) << 53 | 1, 1, 0), 0x1p53);        // a tie goes to even
  EXPECT_EQ(kernel::nearest_double((kernel::Integer(1) << 53) + 3, 1, 0), 0x1p53 + 4);  // upwards, too
  EXPECT_EQ(kernel::nearest_double((kernel::Integer(1) << 200) + 1, kernel::Integer(1) << 147, 0), 0x1p53);
  EXPECT_EQ(kernel::nearest_double((kernel::Integer(1) << 253) + (kernel::Integer(1) << 200) + 1,
                                   kernel::Integer(1) << 200, 0),
            0x1p53 + 2);
}

TEST(NearestDouble, EndsOfTheRange) {
  const double least = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max();
  EXPECT_EQ(kernel::nearest_double(1, 1, -1074), least);
  EXPECT_EQ(kernel::nearest_double(1, 2, -1074), 0);  // a tie
  EXPECT_FALSE(std::signbit(kernel::nearest_double(-1, 2, -1074)));
  EXPECT_EQ(kernel::nearest_double(-3, 4, -1074), -least);
  EXPECT_EQ(kernel::nearest_double(3, 2, -1074), 2 * least);
  EXPECT_EQ(kernel::nearest_double(1, 1, -1100), 0);
  EXPECT_EQ(kernel::nearest_double((kernel::Integer(1) << 53) - 1, 2, -1074),
            0x1p-1022);  // a tie between the last subnormal and the first normal
  EXPECT_EQ(kernel::nearest_double((kernel::Integer(1) << 53) - 1, 1, 971), most);
  EXPECT_EQ(kernel::nearest_double((kernel::Integer(1) << 54) - 1, 1, 970), INFINITY);
  EXPECT_EQ(kernel::nearest_double(1 - (kernel::Integer(1) << 54), 1, 970), -INFINITY);
}

TEST(SolveExactly, InAnyPivotOrder) {
  test::Random random(1);
  for (std::size_t n = 1; n <= 6; ++n)
    for (int run = 0; run < 50; ++run) {
      std::vector<kernel::Integer> system, matrix;
      for (std::size_t i = 0; i < n * (n + 1); ++i) system.emplace_back(random.integer(-2, 2));
      for (std::size_t i = 0; i < n; ++i)
        matrix.insert(matrix.end(), system.begin() + static_cast<std::ptrdiff_t>(i * (n + 1)),
                      system.begin() + static_cast<std::ptrdiff_t>(i * (n + 1) + n));
      const kernel::Integer det = kernel::exact_determinant(matrix, n);
      if (det == 0) continue;
      const kernel::Fractions x = kernel::solve_exactly(system, n);
      EXPECT_EQ(x.denominator, det);
      for (std::size_t i = 0; i < n; ++i) {
        kernel::Integer sum = 0;
        for (std::size_t j = 0; j < n; ++j) sum += system[i * (n + 1) + j] * x.numerators[j];
        EXPECT_EQ(sum, system[i * (n + 1) + n] * det);
      }
    }
}

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
  EXPECT_LT(blocks.num_exact(), slow.num_exact());
}

TEST(SimplePolytope, CubesAndCoincidentCorners) {
  for (std::size_t d = 1; d <= 6; ++d) {
    SimplePolytope polytope;
    polytope.start(d, d);
    std::vector<std::vector<double>> corners;
    for (std::size_t c = 0; c < std::size_t{1} << d; ++c) {
      corners.emplace_back();
      for (std::size_t j = 0; j < d; ++j) corners.back().push_back((c >> j & 1) != 0 ? 3.0 : 1.0);
    }
    for (std::size_t c = 0; c < corners.size(); ++c) {
      std::vector<std::size_t> labels;
      for (std::size_t j = 0; j < d; ++j) labels.push_back(2 * j + (c >> j & 1));
      polytope.add_corner(corners[c].data(), labels);
    }
    EXPECT_NEAR(polytope.volume(), std::pow(2.0, static_cast<double>(d)), 1e-12);
    for (auto& corner : corners) corner[0] = 1;  // flattened: the same combinatorics, no volume
    EXPECT_EQ(polytope.volume(), 0);
  }
}

TEST(CompensatedSum, KeepsWhatWouldBeRoundedAway) {
  CompensatedSum sum;
  for (const double x : {1.0, 1e100, 1.0, -1e100}) sum.add(x);
  EXPECT_EQ(sum.value(), 2);
}

}  // namespace
}  // namespace delone::internal
