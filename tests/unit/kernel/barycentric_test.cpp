// SPDX-License-Identifier: BSD-3-Clause
// Barycentric coordinates: what binary64 proves is within its bound, and where it proves nothing it says so.
#include "kernel/barycentric.hpp"

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace delone::kernel {
namespace {

/// Rows of points, the query last.
struct BarycentricCase {
  std::vector<double> rows;
  std::vector<int> axes;
  std::size_t ambient;

  std::vector<const double*> points() const {
    std::vector<const double*> all;
    for (std::size_t i = 0; (i + 1) * ambient < rows.size(); ++i) all.push_back(rows.data() + i * ambient);
    return all;
  }
  const double* query() const { return rows.data() + rows.size() - ambient; }
  double certified(std::vector<double>& weights) const {
    return certified_barycentric(points(), axes, query(), weights);
  }
  Fractions exact() const { return exact_barycentric(points(), axes, query()); }
};

TEST(KernelBarycentric, ExponentsScaleToAQuarter) {
  for (const double x : {1.0, 0x1p-1074, 3e300, 0x1.fffffffffffffp+9, 7.0}) {
    const double scaled = std::ldexp(x, exponent_to_a_quarter(x));
    EXPECT_GE(scaled, 0.125) << x;
    EXPECT_LT(scaled, 0.25) << x;
  }
}

TEST(KernelBarycentric, ProvenBoundsHold) {
  test::Random random(1);
  std::size_t num_proved = 0;
  for (std::size_t run = 0; run < 300; ++run) {
    const std::size_t d = 1 + run % 5;
    const double scale = run % 3 == 0 ? 0x1p+800 : run % 3 == 1 ? 0x1p-700 : 1;
    BarycentricCase one{{}, std::vector<int>(d), d};
    std::iota(one.axes.begin(), one.axes.end(), 0);
    std::vector<double> q(d, 0.0);
    for (std::size_t i = 0; i <= d; ++i)
      for (std::size_t j = 0; j < d; ++j) {
        one.rows.push_back(scale * random.real());
        q[j] += one.rows.back() / static_cast<double>(d + 1);
      }
    one.rows.insert(one.rows.end(), q.begin(), q.end());
    const Fractions exact = one.exact();
    if (exact.denominator == 0) continue;
    std::vector<double> weights;
    const double bound = one.certified(weights);
    if (!std::isfinite(bound)) continue;
    ++num_proved;
    EXPECT_LT(bound, 1e-6);
    ASSERT_EQ(weights.size(), d + 1);
    for (std::size_t i = 0; i <= d; ++i)
      EXPECT_NEAR(weights[i], nearest_double(exact.numerators[i], exact.denominator, 0), bound);
  }
  EXPECT_GT(num_proved, 290u);
}

TEST(KernelBarycentric, NothingIsProvedOfThinOrMixedOnes) {
  std::vector<double> weights;
  // Thinner than rounding; dependent on the axes; an entry that scaling would lose.
  for (const BarycentricCase& one : {BarycentricCase{{0, 0, 1, 1, 3, 3 + 0x1p-51, 1, 1}, {0, 1}, 2},
                                     BarycentricCase{{0, 0, 1, 1, 2, 2, 1, 1}, {0, 1}, 2},
                                     BarycentricCase{{0, 0x1p+1000, 0x1p-100}, {0}, 1}})
    EXPECT_TRUE(std::isinf(one.certified(weights)));
  // Integers know.
  const Fractions thin = BarycentricCase{{0, 0, 1, 1, 3, 3 + 0x1p-51, 1, 1}, {0, 1}, 2}.exact();
  EXPECT_EQ(thin.numerators[1], thin.denominator);
  EXPECT_EQ(thin.numerators[0], 0);
  EXPECT_EQ((BarycentricCase{{0, 0, 1, 1, 2, 2, 1, 1}, {0, 1}, 2}.exact().denominator), 0);
}

TEST(KernelBarycentric, ExactOnesAreOnTheAxesAndSumToOne) {
  // On the third axis, and outside; a single point has the coordinate 1.
  const Fractions line = BarycentricCase{{1, 5, 0, 1, 5, 8, 1, 5, 12}, {2}, 3}.exact();
  EXPECT_EQ(nearest_double(line.numerators[0], line.denominator, 0), -0.5);
  EXPECT_EQ(nearest_double(line.numerators[1], line.denominator, 0), 1.5);
  const Fractions point = BarycentricCase{{7, 7}, {}, 1}.exact();
  ASSERT_EQ(point.numerators.size(), 1u);
  EXPECT_EQ(point.numerators[0], point.denominator);
}

}  // namespace
}  // namespace delone::kernel
