// SPDX-License-Identifier: BSD-3-Clause
// Points on a small grid of their own, in a set that is on no small grid: signs without bounds are the exact
// ones, and the perturbation is that of the general code.
#include "kernel/small_differences.hpp"

#include "kernel/stages.hpp"
#include "row_case.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace delone::kernel {
namespace {

/// Numbers of K + 2 rows: small integers times 2^exponent, far from zero or near it, of which some may have a
/// bit too many.
template <int K>
std::vector<double> numbers_on_a_grid(random::Generator& generator, std::size_t round) {
  const int bits = round % 3 == 0 ? 1 : round % 3 == 1 ? 2 : bits_of_small_differences<K>() + 1;
  const double unit = std::ldexp(1.0, static_cast<int>(generator.below(60)) - 30);
  const double origin = round % 4 == 0 ? unit * std::ldexp(generator.uniform() < 0.5 ? -3 : 5, 40) : 0;
  std::vector<double> numbers;
  for (int i = 0; i < (K + 2) * K; ++i) {
    numbers.push_back(origin + unit * static_cast<double>(generator.below(std::uint64_t{1} << bits)));
    if (round % 5 == 0 && generator.below(12) == 0) numbers.back() += unit * std::ldexp(1.0, -8);
  }
  return numbers;
}

template <int K>
void expect_exact_signs() {
  SCOPED_TRACE(testing::Message() << "dimension " << K);
  random::Generator generator(K);
  int num_small = 0, num_others = 0, num_ties = 0, num_negative = 0;
  for (std::size_t round = 0; round < test::scaled_count(3000); ++round) {
    RowCase c(RowForm::point, K, numbers_on_a_grid<K>(generator, round));
    c.grid.include(std::vector<double>(K, 1e30 / 3).data());
    ASSERT_FALSE(c.grid.is_small());
    double largest = 0;
    for (int i = 0; i <= K; ++i)
      for (int r = 0; r < K; ++r) largest = std::max(largest, std::fabs(c.rows[i][r] - c.q()[r]));
    if (!are_small_multiples<K>(c.rows.data(), K + 1, c.q(), largest)) {
      ++num_others;
      EXPECT_FALSE(perturbed_in_sphere_of_small<K>(c.rows.data(), c.q()).has_value());
      continue;
    }
    ++num_small;
    const Sign orientation = exact_orientation(c.flat(), c.rows.data() + 1, c.rows[0]);
    ASSERT_EQ((direct_orientation<K>(c.flat(), c.rows.data() + 1, c.rows[0], c.grid)), orientation);
    const Sign side = exact_sphere(c.flat(), c.rows.data(), c.q());
    ASSERT_EQ((direct_sphere<K>(c.flat(), c.rows.data(), c.q(), c.grid)), side);
    bool is_vertex = false;
    for (int i = 0; i <= K; ++i) is_vertex |= equal_points(c.rows[i], c.q(), K);
    if (side != Sign::zero || orientation == Sign::zero || is_vertex) continue;
    if (orientation == Sign::negative) std::swap(c.rows[0], c.rows[1]);
    const Sign perturbed = perturbed_in_sphere<0>(c.flat(), c.rows.data(), c.q(), c.grid);
    ASSERT_EQ(perturbed_in_sphere_of_small<K>(c.rows.data(), c.q()), perturbed);
    ASSERT_EQ(side_of_small<K>(c.rows.data(), c.q()), perturbed);
    ++num_ties;
    num_negative += perturbed == Sign::negative ? 1 : 0;
  }
  EXPECT_GT(num_small, 1000);
  EXPECT_GT(num_others, 100);
  if (K == 1) return;  // three points on a line are on no sphere
  EXPECT_GT(num_negative, 5);
  EXPECT_GT(num_ties, num_negative);
}

TEST(SmallDifferences, GiveExactSigns) {
  expect_exact_signs<1>();
  expect_exact_signs<2>();
  expect_exact_signs<3>();
  expect_exact_signs<4>();
  expect_exact_signs<5>();
}

/// The candidate that makes a positively oriented simplex in the place, and has no such one inside its
/// sphere.
template <int K>
std::size_t first_by_exact_predicates(const RowCase& c, int place,
                                      const std::vector<const double*>& candidates) {
  const auto corners_with = [&](const double* p) {
    std::vector<const double*> corners(c.rows.begin(), c.rows.begin() + K + 1);
    corners[static_cast<std::size_t>(place)] = p;
    return corners;
  };
  std::size_t first = candidates.size();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto corners = corners_with(candidates[i]);
    if (exact_orientation(c.flat(), corners.data() + 1, corners[0]) != Sign::positive) continue;
    if (first < candidates.size()) {
      const auto of_first = corners_with(candidates[first]);
      Sign side = exact_sphere(c.flat(), of_first.data(), candidates[i]);
      if (K % 2 == 0) side = -side;
      if (side == Sign::zero) side = perturbed_in_sphere<0>(c.flat(), of_first.data(), candidates[i], c.grid);
      if (side == Sign::positive) continue;
    }
    first = i;
  }
  return first;
}

template <int K>
void expect_the_first_in_a_pencil() {
  SCOPED_TRACE(testing::Message() << "dimension " << K);
  random::Generator generator(10 + K);
  int num_found = 0, num_beyond = 0;
  for (std::size_t round = 0; round < test::scaled_count(2000); ++round) {
    const int bits = round % 3 == 0 ? 1 : round % 3 == 1 ? 2 : bits_of_small_differences<K>() - 1;
    const double unit = std::ldexp(1.0, static_cast<int>(generator.below(60)) - 30);
    std::vector<double> numbers;
    for (int i = 0; i < (K + 9) * K; ++i)
      numbers.push_back(unit * static_cast<double>(generator.below(std::uint64_t{1} << bits)));
    RowCase c(RowForm::point, K, numbers);
    c.grid.include(std::vector<double>(K, 1e30 / 3).data());
    const int place = static_cast<int>(generator.below(K + 1));
    std::vector<const double*> candidates;
    for (std::size_t i = K + 1; i < c.rows.size(); ++i) {
      const auto is_equal = [&](const double* p) { return equal_points(p, c.rows[i], K); };
      if (std::none_of(candidates.begin(), candidates.end(), is_equal)) candidates.push_back(c.rows[i]);
    }
    const auto found =
        first_in_pencil_of_small<K>(c.rows.data(), place, candidates.data(), candidates.size());
    ASSERT_TRUE(found.has_value());
    ASSERT_EQ(*found, first_by_exact_predicates<K>(c, place, candidates)) << "round " << round;
    ++num_found;
    num_beyond += *found < candidates.size() ? 1 : 0;
  }
  EXPECT_GT(num_beyond, num_found / 10);
  EXPECT_LT(num_beyond, num_found);
}

TEST(SmallDifferences, FindTheFirstInAPencil) {
  expect_the_first_in_a_pencil<2>();
  expect_the_first_in_a_pencil<3>();
  expect_the_first_in_a_pencil<4>();
  expect_the_first_in_a_pencil<5>();
  const double corners[][2] = {{0, 0}, {1, 0}, {0, 1}, {1.0 / 3, 1}};
  const double* const points[] = {corners[0], corners[1], corners[2]};
  const double* const candidates[] = {corners[2], corners[3]};
  EXPECT_EQ(first_in_pencil_of_small<2>(points, 2, candidates, 1), std::size_t{0});
  EXPECT_FALSE(first_in_pencil_of_small<2>(points, 2, candidates, 2).has_value());
}

TEST(SmallDifferences, HaveAsManyBitsAsMinorsAllow) {  // docs/predicates.md, "Small lattices"
  EXPECT_EQ(bits_of_small_differences<1>(), 17);
  EXPECT_EQ(bits_of_small_differences<2>(), 12);
  EXPECT_EQ(bits_of_small_differences<3>(), 9);
  EXPECT_EQ(bits_of_small_differences<4>(), 7);
  EXPECT_EQ(bits_of_small_differences<5>(), 5);
}

TEST(SmallDifferences, AreThoseOfMultiplesAlone) {
  const auto are_small = [](double p, double q) {
    const double* const points[] = {&p};
    return are_small_multiples<1>(points, 1, &q, std::fabs(p - q));
  };
  EXPECT_TRUE(are_small(3, 1));
  EXPECT_TRUE(are_small(0x1p40 + 3, 0x1p40));
  EXPECT_FALSE(are_small(1.0 / 3, 0));
  EXPECT_FALSE(are_small(1 + 0x1p-40, 0x1p-40));
  // Half a unit off a multiple, where a sum with the number that rounds to units would be small itself.
  const double unit = 0x1p-16, x = -(0x1p52 * unit - unit / 2);
  EXPECT_FALSE(are_small(x, x + 1));
  EXPECT_FALSE(are_small(-x, -x - 1));
  // Beyond the range in which products of differences neither underflow nor overflow, and no difference.
  EXPECT_FALSE(are_small(0x1p-100, 0));
  EXPECT_FALSE(are_small(0x1p61, 0));
  EXPECT_FALSE(are_small(0x1p1023, -0x1p1023));
  EXPECT_FALSE(are_small(5, 5));
}

}  // namespace
}  // namespace delone::kernel
