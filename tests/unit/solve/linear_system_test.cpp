// SPDX-License-Identifier: BSD-3-Clause
// The certified solver, for doubles and for SIMD vectors, against fractions: what it settles is the nearest
// double, and the solution is within its radius, on random, nearly singular and extreme systems.
#include "degenerate.hpp"
#include "kernel/fractions.hpp"
#include "kernel/grid.hpp"

#include <gtest/gtest.h>

#include <hwy/highway.h>

#include "solve/linear_system-inl.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace delone::solve {
namespace HWY_NAMESPACE {
namespace {

using Lanes = hn::CappedTag<double, 8>;
using Numbers = hn::Vec<Lanes>;

std::vector<double> lanes_of(double x) { return {x}; }
std::vector<double> lanes_of(Numbers x) {
  std::vector<double> result(hn::Lanes(Lanes()));
  hn::StoreU(x, Lanes(), result.data());
  return result;
}

/// The same number in all lanes but the first, which has its negative.
template <class T>
T mixed(double x) {
  if constexpr (is_one_lane<T>) {
    return x;
  } else {
    std::vector<double> entries(hn::Lanes(Lanes()), x);
    entries[0] = -x;
    return hn::LoadU(Lanes(), entries.data());
  }
}

kernel::Integer in_units(double x, int exponent) { return kernel::scaled_integer(x, exponent); }

struct Outcome {
  int num_settled = 0, num_certain = 0;
};

/// Solves A·x = b and compares with fractions.
template <class T, int N>
Outcome expect_certified(const std::vector<double>& a, const std::vector<double>& b) {
  const std::size_t n = b.size();
  LinearSystem<T, N> system(n);
  for (std::size_t i = 0; i < n * n; ++i) system.a[i] = number<T>(a[i]);
  // Lane 0 has b, the others −b.
  for (std::size_t i = 0; i < n; ++i) system.b[i] = mixed<T>(is_one_lane<T> ? b[i] : -b[i]);
  Outcome outcome;
  const Mask<T> certain = system.solve(1e8, 1e8);
  if (!all<T>(certain)) return outcome;
  ++outcome.num_certain;
  for (std::size_t i = 0; i < n; ++i) {
    // In exact products, with the bound of common points of hyperplanes.
    T sum = system.b[i], rest = number<T>(0), magnitude = abs(system.b[i]);
    for (std::size_t j = 0; j < n; ++j) {
      const Pair<T> product = two_product(minus(system.a[i * n + j]), system.x[j]);
      const Pair<T> next = two_sum(sum, product.high);
      sum = next.high;
      rest = rest + (next.low + product.low);
      magnitude = magnitude + abs(product.high);
    }
    system.residual[i] = sum + rest;
    const double terms = static_cast<double>(n) + 1, u = kernel::unit_roundoff;
    system.error[i] = (1.01 * u) * (2 * abs(system.residual[i]) + (2 * terms * terms * u) * magnitude);
  }
  system.correct(1e-300);

  std::vector<kernel::Integer> exact;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) exact.push_back(in_units(a[i * n + j], -1074));
    exact.push_back(in_units(b[i], -1074));
  }
  const kernel::Fractions solution = kernel::solve_exactly(std::move(exact), n);
  EXPECT_NE(solution.denominator, 0) << "a bound below 1/2 proves that A is regular";
  for (std::size_t j = 0; j < n; ++j) {
    const std::vector<double> x = lanes_of(system.x[j]), correction = lanes_of(system.correction[j]),
                              radius = lanes_of(system.radius[j]);
    const Nearest<T> nearest =
        nearest_double<T>({system.x[j], number<T>(0)}, system.correction[j], system.radius[j]);
    const std::vector<double> value = lanes_of(nearest.value),
                              settled = lanes_of(select(nearest.is_settled, number<T>(1), number<T>(0)));
    const double expected = kernel::nearest_double(solution.numerators[j], solution.denominator, 0);
    for (std::size_t lane = 0; lane < x.size(); ++lane) {
      const double sign = lane == 0 ? 1 : -1;
      // |x⁰ + correction − x| ≤ radius, times 2^1074·denominator.
      const kernel::Integer sum = in_units(sign * x[lane], -1074) + in_units(sign * correction[lane], -1074);
      const kernel::Integer error = boost::multiprecision::abs(
          kernel::Integer(sum * solution.denominator - (solution.numerators[j] << 1074)));
      EXPECT_LE(error, in_units(radius[lane], -1074) * boost::multiprecision::abs(solution.denominator));
      if (settled[lane] == 0) continue;
      ++outcome.num_settled;
      EXPECT_EQ(value[lane], sign * expected);
    }
  }
  return outcome;
}

/// What all kinds of systems are tried with.
template <int N>
void expect_certified_of(std::size_t n) {
  test::Random random(n);
  int num_regular = 0, num_settled = 0, num_rounds = 0;
  for (int round = 0; round < 200; ++round) {
    const int kind = round % 5;
    std::vector<double> a(n * n), b(n);
    for (double& x : a)
      x = kind == 0   ? random.real() - 0.5
          : kind == 1 ? random.integer(-4, 4) / 8.0                        // many are singular
          : kind == 2 ? 0.5 + std::ldexp(random.real(), -10 - round % 40)  // nearly singular
          : kind == 3 ? std::ldexp(random.real() - 0.5, random.integer(-300, 0))
                      : 0.75 * random.integer(-1, 1);
    for (double& x : b)
      x = kind == 3 ? std::ldexp(random.real(), random.integer(-300, 0)) : random.real() - 0.5;
    const Outcome one = expect_certified<double, N>(a, b);
    num_regular += kind == 0 ? one.num_certain : 0;
    num_settled += kind == 0 ? one.num_settled : 0;
    num_rounds += kind == 0;
    if constexpr (N > 0) expect_certified<Numbers, N>(a, b);
  }
  EXPECT_GE(num_regular, num_rounds - 1);
  EXPECT_GE(num_settled, (num_rounds - 1) * static_cast<int>(n) - 1)
      << "random solutions are hardly ever ties";
}

TEST(LinearSystem, RadiusAndRoundingAreRight) {
  expect_certified_of<1>(1);
  expect_certified_of<2>(2);
  expect_certified_of<3>(3);
  expect_certified_of<4>(4);
  expect_certified_of<5>(5);
  expect_certified_of<0>(4);
  expect_certified_of<0>(7);
}

TEST(LinearSystem, SingularSystemsAreNotCertain) {
  for (const double x : {1.0, 0.1, 1e-8, 0x1p-1074}) {
    const std::vector<double> rank_one = {x, x / 2, x, x / 2}, b = {0.5, 0.25};
    EXPECT_EQ((expect_certified<double, 2>(rank_one, b).num_certain), 0);
    EXPECT_EQ((expect_certified<double, 0>(rank_one, b).num_certain), 0);
    EXPECT_EQ((expect_certified<Numbers, 2>(rank_one, b).num_certain), 0);
  }
  EXPECT_EQ((expect_certified<double, 1>({0}, {1}).num_certain), 0);
  EXPECT_EQ((expect_certified<Numbers, 4>(std::vector<double>(16), std::vector<double>(4)).num_certain), 0);
}

// x = 1 + 2⁻⁵³, halfway between doubles; and x = 1 + 2⁻⁵³ ± 2⁻⁹⁰, beside that.
TEST(LinearSystem, TiesAreNotSettled) {
  const auto is_settled = [](double low, double radius) {
    return nearest_double<double>({1, 0x1p-53}, low, radius).is_settled;
  };
  EXPECT_FALSE(is_settled(0, 1e-40));
  EXPECT_FALSE(is_settled(0x1p-90, 0x1p-89));
  EXPECT_TRUE(is_settled(0x1p-90, 0x1p-95));
  EXPECT_TRUE(is_settled(-0x1p-90, 0x1p-95));
  EXPECT_EQ(nearest_double<double>({1, 0x1p-53}, 0x1p-90, 0x1p-95).value, 1 + 0x1p-52);
  EXPECT_EQ(nearest_double<double>({1, 0x1p-53}, -0x1p-90, 0x1p-95).value, 1);
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_settled(none, 1e-40));
  EXPECT_FALSE(is_settled(0, none));
}

TEST(SphereResidual, IsWithinItsError) {
  test::Random random(1);
  for (int round = 0; round < 500; ++round) {
    const std::size_t d = 1 + round % 8;
    std::vector<double> high(d), low(d), z(d);
    kernel::Integer exact = 0;
    constexpr int grid = -260;
    Pair<double> weight{0, 0};
    if (round % 2 == 1) weight = two_sum(random.real(), 0x1p-55 * std::rint(64 * random.real()));
    exact -= (in_units(weight.high, grid) + in_units(weight.low, grid)) << -grid;
    for (std::size_t j = 0; j < d; ++j) {
      const Pair<double> edge = two_sum(random.real() - 0.5, std::ldexp(random.real(), -56));
      high[j] = edge.high;
      low[j] = edge.low;
      z[j] = round % 3 == 0 ? edge.high + std::ldexp(random.real(), -50) : 1000 * random.real();  // cancels
      const kernel::Integer a = in_units(edge.high, grid) + in_units(edge.low, grid);
      exact += a * (a - in_units(z[j], grid));
    }
    const Residual<double> residual = sphere_residual(d, high.data(), low.data(), z.data(), weight);
    const kernel::Integer error =
        boost::multiprecision::abs(kernel::Integer(exact - (in_units(residual.value, 2 * grid))));
    EXPECT_LE(kernel::nearest_double(error, 1, 2 * grid), residual.error) << round;
    EXPECT_LE(residual.error, 1e-12);
  }
}

TEST(Lanes, PowersOfTwo) {
  for (const double x : {1.0, 1.5, 0.75, 0x1p-1000, 0x1p1000, 1e-300, 1e300}) {
    const Powers<double> powers = powers_of_two(x);
    EXPECT_EQ(powers.power, std::ldexp(1.0, std::ilogb(x)));
    EXPECT_EQ(powers.scale, std::ldexp(1.0, -std::ilogb(x) - 1));
    const Powers<Numbers> of_lanes = powers_of_two(number<Numbers>(x));
    EXPECT_EQ(lanes_of(of_lanes.power)[0], powers.power);
    EXPECT_EQ(lanes_of(of_lanes.scale)[0], powers.scale);
  }
}

TEST(Lanes, HaveTheBitsOfDoubles) {
  test::Random random(2);
  for (int round = 0; round < 100; ++round) {
    const double a = std::ldexp(random.real() - 0.5, random.integer(-200, 200)),
                 b = std::ldexp(random.real() - 0.5, random.integer(-200, 200));
    const Pair<double> sum = two_sum(a, b), product = two_product(a, b);
    const Pair<Numbers> sums = two_sum(number<Numbers>(a), number<Numbers>(b)),
                        products = two_product(number<Numbers>(a), number<Numbers>(b));
    for (const double x : lanes_of(sums.high)) EXPECT_EQ(x, sum.high);
    for (const double x : lanes_of(sums.low)) EXPECT_EQ(x, sum.low);
    for (const double x : lanes_of(products.high)) EXPECT_EQ(x, product.high);
    for (const double x : lanes_of(products.low)) EXPECT_EQ(x, product.low);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace delone::solve
HWY_AFTER_NAMESPACE();
