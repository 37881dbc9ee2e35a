// SPDX-License-Identifier: BSD-3-Clause
// The exact stage over the whole range of doubles, in every width of integers, against independent code.
#include "kernel/exact.hpp"

#include "base/random.hpp"
#include "kernel/stages.hpp"
#include "row_case.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace delone::kernel {
namespace {

TEST(ExactStage, HoldsOverTheWholeRangeOfDoubles) {
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  constexpr double huge = std::numeric_limits<double>::max();
  const RowCase c(RowForm::point, 2, {-huge, -huge, huge, huge, 0, tiny});
  EXPECT_EQ(orientation<2>(c.flat(), c.rows.data(), c.grid), Sign::positive);
  const RowCase on_it(RowForm::point, 2, {-huge, -huge, huge, huge, tiny, tiny});
  EXPECT_EQ(orientation<2>(on_it.flat(), on_it.rows.data(), on_it.grid), Sign::zero);
  StageCounts counts;
  const RowCase circle(RowForm::point, 2, {-huge, 0, huge, -tiny, 0, huge, 0, tiny});
  EXPECT_EQ(in_sphere<2>(circle.flat(), circle.rows.data(), circle.q(), circle.grid, counts), Sign::negative);
  EXPECT_EQ(counts.direct + counts.exact, 1u);
}

/// Integers of so many bits times a power of two: with the dimension they choose the width of the integers
/// that the determinant is computed in, and from 9 columns on elimination.
std::vector<double> integers_of(int bits, int exponent, std::size_t count, random::Generator& generator) {
  std::vector<double> all;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<double>(generator.bits() >> (64 - bits));
    all.push_back(
        std::ldexp(generator.coin() ? x : -x, exponent + static_cast<int>(generator.below(2)) * bits));
  }
  return all;
}

TEST(ExactStage, AgreesWithIntegersInEveryWidth) {
  random::Generator generator(1);
  for (const int k : {1, 2, 3, 5, 8, 9, 10})
    for (const int bits : {1, 3, 12, 24, 53})
      for (const bool weighted : {false, true})
        for (std::size_t round = 0; round < test::scaled_size(8, 2); ++round) {
          const RowForm form = weighted ? RowForm::weighted_point : RowForm::point;
          const auto size = static_cast<std::size_t>(k + weighted);
          std::vector<double> rows = integers_of(bits, -1074 + static_cast<int>(round % 4) * 300,
                                                 static_cast<std::size_t>(k + 2) * size, generator);
          if (round % 3 == 0)  // a point in the middle of two others
            for (std::size_t j = 0; j < size; ++j) rows[j] = rows[size + j] / 2 + rows[2 * size + j] / 2;
          const RowCase c(form, k, rows);
          const test::Matrix lifted = lifted_rows(c);
          EXPECT_EQ(exact_orientation(c.flat(), c.rows.data() + 1, c.rows[0]), true_orientation_of(lifted))
              << k << ' ' << bits;
          const Sign orientation = true_orientation_of(lifted);
          if (orientation == Sign::zero) continue;
          Sign side = exact_sphere(c.flat(), c.rows.data(), c.q()) * orientation;
          if (k % 2 == 0) side = -side;
          EXPECT_EQ(side, true_side_of_sphere(lifted)) << k << ' ' << bits;
        }
}

TEST(ExactStage, DeterminantsOfChosenColumnsAgreeWithIntegers) {
  random::Generator generator(2);
  for (const int n : {1, 2, 4, 9})
    for (std::size_t round = 0; round < test::scaled_count(60); ++round) {
      std::vector<int> axes;
      for (int j = 0; j < n; ++j) axes.push_back(j + (j > 0));  // without column 1
      const RowCase c(RowForm::homogeneous, n + 1,
                      random_numbers(static_cast<std::size_t>(n * (n + 1)), round % 6, generator), axes);
      test::Matrix m;
      int exponent = 0;
      for (const double x : c.numbers) exponent = std::min(exponent, x == 0 ? 0 : trailing_exponent(x));
      for (const double* row : c.rows) {
        m.emplace_back();
        for (const int axis : axes) m.back().push_back(integer_at(row[axis], exponent));
      }
      EXPECT_EQ(exact_determinant(axes, c.rows.data()), test::sign_of(test::determinant(m)));
    }
}

TEST(ExactStage, AffineFormsAgreeWithRationals) {
  random::Generator generator(3);
  using Rational = boost::multiprecision::cpp_rational;
  for (std::size_t round = 0; round < test::scaled_count(1000); ++round) {
    const std::vector<double> row = random_numbers(3, round % 6, generator),
                              p = random_numbers(2, round / 6 % 6, generator);
    const Rational sum =
        Rational(row[0]) * Rational(p[0]) + Rational(row[1]) * Rational(p[1]) + Rational(row[2]);
    EXPECT_EQ(exact_affine_form(row.data(), p.data(), 2), sum > 0   ? Sign::positive
                                                          : sum < 0 ? Sign::negative
                                                                    : Sign::zero);
  }
}

}  // namespace
}  // namespace delone::kernel
