// SPDX-License-Identifier: BSD-3-Clause
// Which signs stage direct_ decides, and which it passes on.
#include "kernel/direct.hpp"

#include "base/random.hpp"
#include "kernel/exact.hpp"
#include "kernel/stages.hpp"
#include "row_case.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace delone::kernel {
namespace {

TEST(DirectStage, DecidesPointsInGeneralPosition) {
  const RowCase c(RowForm::point, 2, {0.1, 0.2, 1.3, 0.1, 0.4, 0.9, 0.5, 0.5});
  EXPECT_EQ(direct_orientation<2>(c.flat(), c.rows.data() + 1, c.rows[0], c.grid), Sign::positive);
  EXPECT_TRUE(direct_sphere<2>(c.flat(), c.rows.data(), c.q(), c.grid).has_value());
}

TEST(DirectStage, ProvesZerosOnIntegers) {
  const RowCase line(RowForm::point, 2, {0, 0, 3, 3, 7, 7});
  EXPECT_EQ(direct_orientation<2>(line.flat(), line.rows.data() + 1, line.rows[0], line.grid), Sign::zero);
  const RowCase square(RowForm::point, 2, {0, 0, 100, 0, 100, 100, 0, 100});
  EXPECT_EQ(direct_sphere<2>(square.flat(), square.rows.data(), square.q(), square.grid), Sign::zero);
  const RowCase scaled(
      RowForm::point, 2,
      {0, 0, std::ldexp(3, -500), 0, std::ldexp(3, -500), std::ldexp(5, -500), 0, std::ldexp(5, -500)});
  EXPECT_EQ(direct_sphere<2>(scaled.flat(), scaled.rows.data(), scaled.q(), scaled.grid), Sign::zero);
}

/// Signs of points with small integers, in a set that also has points of full precision. In every other
/// round they are corners of a cube, which lie on a sphere.
template <int K>
void expect_integers_are_decided(RowForm form) {
  random::Generator generator(K);
  const int row_size = K + (form == RowForm::weighted_point ? 1 : 0);
  for (std::size_t round = 0; round < test::scaled_count(300); ++round) {
    const bool are_corners = round % 2 == 0;
    std::vector<double> x;
    for (int i = 0; i < (K + 2) * row_size; ++i) {
      const bool is_weight = i % row_size == K;
      x.push_back(are_corners && is_weight ? 1 : static_cast<double>(generator.below(are_corners ? 2 : 3)));
    }
    RowCase c(form, K, std::move(x));
    const std::vector<double> fine(static_cast<std::size_t>(row_size), 1.0 / 3);
    c.grid.include(fine.data());
    const auto orientation = direct_orientation<K>(c.flat(), c.rows.data() + 1, c.rows[0], c.grid);
    ASSERT_EQ(orientation, exact_orientation(c.flat(), c.rows.data() + 1, c.rows[0]));
    if (std::any_of(c.rows.begin(), c.rows.end() - 1,
                    [&](const double* row) { return equal_points(row, c.q(), c.ambient); }))
      continue;
    const auto side = direct_sphere<K>(c.flat(), c.rows.data(), c.q(), c.grid);
    ASSERT_EQ(side, exact_sphere(c.flat(), c.rows.data(), c.q()));
    if (are_corners) {
      ASSERT_EQ(side, Sign::zero);
    }
  }
}

TEST(DirectStage, ProvesZerosOnIntegersBesidePointsOfFullPrecision) {
  for (const RowForm form : {RowForm::point, RowForm::weighted_point, RowForm::furthest_point}) {
    expect_integers_are_decided<2>(form);
    expect_integers_are_decided<3>(form);
    expect_integers_are_decided<5>(form);
    expect_integers_are_decided<6>(form);
    expect_integers_are_decided<8>(form);
  }
}

TEST(DirectStage, PassesOnWhatItCannotKnow) {
  // One unit in the last place off a line through points of full precision: beyond binary64, not beyond
  // integers.
  const double x = 1.0 / 3, y = std::nextafter(x, 1);
  const RowCase c(RowForm::point, 2, {0, 0, 1, 1, x, y});
  EXPECT_EQ(exact_orientation(c.flat(), c.rows.data() + 1, c.rows[0]), Sign::positive);
  const RowCase tilted(RowForm::point, 2, {0.1, 0.1, 0.3, 0.3, 1e17, 1e17});
  EXPECT_EQ(direct_orientation<2>(tilted.flat(), tilted.rows.data() + 1, tilted.rows[0], tilted.grid),
            std::nullopt);
  EXPECT_EQ(exact_orientation(tilted.flat(), tilted.rows.data() + 1, tilted.rows[0]), Sign::zero);
}

TEST(DirectStage, EqualCoordinatesAreAnExactZero) {
  const RowCase c(RowForm::point, 3, {0.1, 0.2, 0.7, 1.3, 0.1, 0.7, 0.4, 0.9, 0.7, 0.5, 0.5, 0.7});
  EXPECT_EQ(direct_orientation<3>(c.flat(), c.rows.data() + 1, c.rows[0], c.grid), Sign::zero);
}

TEST(DirectStage, EqualCoordinatesOfAllPointsAreAnExactZero) {
  const RowCase c(RowForm::point, 2, {0.1, 0.7, 1.3, 0.7, 0.4, 0.7, 0.2, 0.7});
  EXPECT_EQ(direct_orientation<2>(c.flat(), c.rows.data(), c.q(), c.grid), Sign::zero);
  EXPECT_EQ(direct_sphere<2>(c.flat(), c.rows.data(), c.q(), c.grid), Sign::zero);
}

TEST(DirectStage, PassesOnWhatIsBeyondRange) {
  constexpr double huge = std::numeric_limits<double>::max();
  const RowCase c(RowForm::point, 2, {huge, 0, -huge, 1, 0, huge, 3, -huge});
  const Sign exact = exact_orientation(c.flat(), c.rows.data(), c.q());
  EXPECT_EQ(direct_orientation<2>(c.flat(), c.rows.data(), c.q(), c.grid).value_or(exact), exact);
  EXPECT_EQ(direct_sphere<2>(c.flat(), c.rows.data(), c.q(), c.grid), std::nullopt);
}

TEST(DirectStage, IsNotMisledWhereProductsOfSmallColumnsUnderflow) {
  // Products of entries of the first two columns have a few bits only, and the third makes them large again.
  random::Generator generator(3);
  const int exponents[] = {-560, -560, 440};
  for (std::size_t round = 0; round < test::scaled_count(2000); ++round) {
    std::vector<double> x(12, 0.0);
    for (std::size_t i = 3; i < 9; ++i) x[i] = static_cast<double>(generator.below(1u << 30));
    for (std::size_t j = 0; j < 3; ++j) x[9 + j] = x[3 + j] + x[6 + j];
    x[9 + generator.below(3)] += static_cast<double>(generator.below(3)) - 1;
    for (std::size_t i = 0; i < 12; ++i) x[i] = std::ldexp(x[i], exponents[i % 3]);
    const RowCase c(RowForm::point, 3, std::move(x));
    const auto sign = direct_orientation<3>(c.flat(), c.rows.data() + 1, c.rows[0], c.grid);
    const Sign exact = exact_orientation(c.flat(), c.rows.data() + 1, c.rows[0]);
    ASSERT_EQ(sign.value_or(exact), exact);
  }
}

/// The signs of determinants of rows over all magnitudes: those that are known are right, and most are known.
template <int N>
void expect_right_determinants() {
  random::Generator generator(N);
  std::size_t known = 0, zeros = 0, all = 0;
  for (std::size_t round = 0; round < test::scaled_count(600); ++round) {
    RowCase c(RowForm::homogeneous, N, random_numbers(N * N, round % 6, generator));
    if (round % 7 == 0)  // the last row is the sum of the others, rounded
      for (std::size_t j = 0; j < N; ++j) {
        double sum = 0;
        for (std::size_t i = 0; i + 1 < N; ++i) sum += c.numbers[i * N + j];
        if (std::isfinite(sum)) c.numbers[(N - 1) * N + j] = sum;
      }
    const Sign truth = exact_determinant(c.axes, c.rows.data());
    for (const auto sign :
         {direct_determinant<N>(c.axes, c.rows.data()), direct_determinant<0>(c.axes, c.rows.data())}) {
      if (sign) {
        EXPECT_EQ(*sign, truth);
      }
      known += sign.has_value();
      zeros += sign == Sign::zero;
      ++all;
    }
  }
  EXPECT_GE(known, all * 7 / 10);
  EXPECT_GT(zeros, 0u);
}

TEST(DirectDeterminant, KnowsOnlyWhatIsTrue) {
  expect_right_determinants<1>();
  expect_right_determinants<2>();
  expect_right_determinants<4>();
  expect_right_determinants<7>();
}

TEST(DirectAffineForm, KnowsOnlyWhatIsTrue) {
  random::Generator generator(5);
  std::size_t known = 0;
  for (std::size_t round = 0; round < test::scaled_count(6000); ++round) {
    std::vector<double> row = random_numbers(4, round % 6, generator);
    const std::vector<double> p = random_numbers(3, round / 6 % 6, generator);
    if (round % 5 == 0) row[3] = -(row[0] * p[0] + row[1] * p[1] + row[2] * p[2]);
    if (!std::isfinite(row[3])) continue;
    const auto sign = direct_affine_form(row.data(), p.data(), 3);
    if (!sign) continue;
    ++known;
    EXPECT_EQ(*sign, exact_affine_form(row.data(), p.data(), 3));
  }
  EXPECT_GT(known, test::scaled_count(3000));
}

TEST(DirectStage, ScalesAreExact) {
  using detail::normalisation;
  using detail::power_of_two;
  using detail::upper_exponent;
  EXPECT_EQ(power_of_two(-1022), std::numeric_limits<double>::min());
  EXPECT_EQ(power_of_two(-1023), 0);
  EXPECT_EQ(power_of_two(1024), std::numeric_limits<double>::infinity());
  EXPECT_EQ(upper_exponent(1), 1);
  EXPECT_EQ(upper_exponent(-std::nextafter(1.0, 0)), 0);
  EXPECT_EQ(upper_exponent(std::numeric_limits<double>::denorm_min()), -1073);
  EXPECT_EQ(upper_exponent(std::numeric_limits<double>::max()), 1024);
  for (const double m : {1.0, 0.3, 1e-290, 1e300}) {
    const auto [scale, exponent] = normalisation(m);
    EXPECT_TRUE(m * scale >= 0.5 && m * scale < 1) << m;
    EXPECT_EQ(scale, std::ldexp(1.0, -exponent));
  }
}

}  // namespace
}  // namespace delone::kernel
