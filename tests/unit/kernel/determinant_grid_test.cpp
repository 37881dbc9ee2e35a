// SPDX-License-Identifier: BSD-3-Clause
// The grid of a determinant: the determinant is a multiple of it, and for fewer points it is not finer.
#include "kernel/determinant_grid.hpp"

#include "degenerate.hpp"
#include "kernel/fractions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace delone::kernel {
namespace {

TEST(DeterminantGrid, DeterminantsAreMultiples) {
  test::Random random(1);
  for (std::size_t run = 0; run < 300; ++run) {
    const std::size_t d = 1 + run % 3;
    const bool weighted = run % 2 == 0, has_lifts = run % 4 < 2;
    const std::size_t width = d + (weighted ? 1 : 0), count = d + (has_lifts ? 1 : 0);
    std::vector<int> axes(d);
    std::iota(axes.begin(), axes.end(), 0);
    const Flat flat{static_cast<int>(d), axes, weighted ? RowForm::weighted_point : RowForm::point};
    std::vector<double> rows((count + 1) * width);
    for (double& x : rows) x = std::ldexp(random.integer(-9, 9), random.integer(-4, 4));
    if (weighted && run % 3 == 0)
      for (std::size_t i = 0; i <= count; ++i) rows[i * width + d] = 0x1p-30;  // equal: they cancel
    Grid grid(static_cast<int>(d), weighted);
    std::vector<const double*> points;
    for (std::size_t i = 0; i <= count; ++i) {
      points.push_back(rows.data() + i * width);
      grid.include(points.back());
    }
    std::vector<Integer> matrix;  // in units that all entries are multiples of
    constexpr int fine = -4, fine_lift = -40;
    for (std::size_t i = 0; i < count; ++i) {
      Integer lift = 0;
      for (std::size_t j = 0; j < d; ++j) {
        const Integer x = scaled_integer(points[i][j], fine) - scaled_integer(points[count][j], fine);
        matrix.push_back(x);
        lift += (x * x) << (2 * fine - fine_lift);
      }
      if (weighted)
        lift -= scaled_integer(points[i][d], fine_lift) - scaled_integer(points[count][d], fine_lift);
      if (has_lifts) matrix.push_back(lift);
    }
    const Integer determinant = exact_determinant(matrix, count);
    const std::int64_t unit = static_cast<std::int64_t>(d) * fine + (has_lifts ? fine_lift : 0);
    const std::int64_t of_set = determinant_exponent(flat, grid, has_lifts),
                       of_points = determinant_exponent(flat, points.data(), count, points[count], has_lifts);
    EXPECT_GE(of_points, of_set);
    if (determinant == 0) continue;
    for (const std::int64_t exponent : {of_set, of_points}) {
      if (exponent <= unit) continue;
      EXPECT_EQ(determinant % (Integer(1) << static_cast<unsigned>(exponent - unit)), 0) << run;
    }
  }
}

TEST(DeterminantGrid, EqualWeightsCancelAndOthersDoNot) {
  const std::vector<int> axes{0};
  const Flat flat{1, axes, RowForm::weighted_point};
  const double a[] = {0, 0x1p-30}, b[] = {1, 0x1p-30}, c[] = {2, 0x1p-20};
  const double* const equal[] = {b, b};
  const double* const other[] = {b, c};
  EXPECT_EQ(determinant_exponent(flat, equal, 2, a, true), 0);
  EXPECT_EQ(determinant_exponent(flat, other, 2, a, true), -30);
  EXPECT_EQ(determinant_exponent(flat, other, 2, a, false), 0) << "without lifts weights do not count";
}

}  // namespace
}  // namespace delone::kernel
