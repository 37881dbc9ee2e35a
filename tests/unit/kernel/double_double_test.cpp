// SPDX-License-Identifier: BSD-3-Clause
// Numbers of twice the precision of binary64 against exact integers, and the determinants in binary64, by
// minors up to six columns, and by minors in these numbers against the exact stages: on points in general
// position, on nearly degenerate and degenerate ones, over wide ranges of exponents and with denormal
// numbers.
#include "kernel/double_double.hpp"

#include "base/random.hpp"
#include "kernel/direct.hpp"
#include "kernel/double_double_stage.hpp"
#include "kernel/exact.hpp"
#include "row_case.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace delone::kernel {
namespace {

// ---- Numbers

constexpr int lowest = -2200;  // exponents of the integers that sums and products are compared in

test::Integer exact(const DoubleDouble& x) { return integer_at(x.high, lowest) + integer_at(x.low, lowest); }

double random_double(random::Generator& generator, int range) {
  const double mantissa =
      generator.below(4) == 0 ? static_cast<double>(generator.below(9)) - 4 : 2 * generator.uniform() - 1;
  return std::ldexp(mantissa,
                    static_cast<int>(generator.below(static_cast<std::uint64_t>(2 * range))) - range);
}

/// The second of two numbers may nearly cancel the first.
DoubleDouble random_number(random::Generator& generator, const DoubleDouble& other) {
  const double high = random_double(generator, 80);
  switch (generator.below(4)) {
    case 0:
      return two_sum(-other.high, random_double(generator, 2) * std::ldexp(other.high, -53));
    case 1:
      return two_sum(std::nextafter(-other.high, 1e300), std::ldexp(high, -160));
    case 2:
      return {high, 0};
    default:
      return two_sum(high, std::ldexp(high * generator.uniform(), -50));
  }
}

TEST(DoubleDouble, SumsAndProductsKeepTheirBounds) {
  random::Generator generator(5);
  for (std::size_t round = 0; round < test::scaled_count(40000); ++round) {
    const DoubleDouble x = random_number(generator, {1, 0}), y = random_number(generator, x);
    const test::Integer a = exact(x), b = exact(y);
    for (const DoubleDouble& z : {x + y, x - y, x * y}) {
      EXPECT_EQ(z.high, z.high + z.low);
      EXPECT_LE(std::fabs(z.low), 0x1p-53 * std::fabs(z.high));
    }
    // 6u² and 9u², u² = 2^−106
    EXPECT_LE(abs(exact(x + y) - (a + b)) << 106, 6 * (abs(a) + abs(b)));
    EXPECT_LE(abs(exact(x - y) - (a - b)) << 106, 6 * (abs(a) + abs(b)));
    EXPECT_LE(abs(shifted(exact(x * y), -lowest) - a * b) << 106, 9 * abs(a * b));
  }
}

TEST(DoubleDouble, SumsAreBoundedAmongDenormalNumbers) {
  random::Generator generator(6);
  for (std::size_t round = 0; round < test::scaled_count(20000); ++round) {
    const auto tiny = [&] {
      return std::ldexp(2 * generator.uniform() - 1, -960 - static_cast<int>(generator.below(110)));
    };
    const DoubleDouble x = two_sum(tiny(), tiny()), y = two_sum(tiny(), tiny());
    const test::Integer a = exact(x), b = exact(y);
    EXPECT_LE(abs(exact(x + y) - (a + b)) << 106, 6 * (abs(a) + abs(b)));
    // A product of this size may be off by less than 2^−890, and stays a number with a small low part.
    const DoubleDouble product = DoubleDouble{std::ldexp(x.high, 300), std::ldexp(x.low, 300)} *
                                 DoubleDouble{std::ldexp(y.high, 200), std::ldexp(y.low, 200)};
    EXPECT_LE(std::fabs(product.high), 0x1p-890);
    EXPECT_LE(std::fabs(product.low), 0x1p-53 * std::fabs(product.high));
  }
}

// ---- Stages

enum class Kind {
  uniform,
  lattice,
  large_lattice,
  nudged_lattice,
  nudged_sphere,
  nudged_plane,
  wide,
  denormal,
  extreme
};
constexpr Kind kinds[] = {Kind::uniform,        Kind::lattice,       Kind::large_lattice,
                          Kind::nudged_lattice, Kind::nudged_sphere, Kind::nudged_plane,
                          Kind::wide,           Kind::denormal,      Kind::extreme};

double nudged(double x, random::Generator& generator) {
  const auto move = generator.below(3);
  return move == 0 ? x : std::nextafter(x, move == 1 ? 1e300 : -1e300);
}

/// k+2 rows of `ambient` coordinates and, if `weighted`, a weight.
std::vector<double> random_rows(Kind kind, int rows, int ambient, bool weighted,
                                random::Generator& generator) {
  std::vector<double> all;
  const double scale = std::ldexp(1 + generator.uniform(), static_cast<int>(generator.below(40)) - 20);
  for (int i = 0; i < rows; ++i) {
    std::vector<double> x;
    double square = 0;
    for (int j = 0; j < ambient; ++j) {
      const double u = generator.uniform();
      x.push_back(kind == Kind::uniform || kind == Kind::nudged_sphere || kind == Kind::nudged_plane
                      ? 2 * u - 1
                  : kind == Kind::lattice        ? std::floor(6 * u)
                  : kind == Kind::large_lattice  ? std::floor(3e6 * u)
                  : kind == Kind::nudged_lattice ? nudged(1 + std::floor(3 * u), generator)
                  : kind == Kind::wide           ? random_double(generator, 100)
                  : kind == Kind::denormal
                      ? std::ldexp(std::floor(9 * u) - 4, generator.below(2) == 0 ? -1074 : -1030)
                      : random_double(generator, 1000));
      square += x.back() * x.back();
    }
    if (kind == Kind::nudged_sphere)
      for (double& coordinate : x) coordinate = nudged(scale * (coordinate / std::sqrt(square)), generator);
    if (kind == Kind::nudged_plane) {
      double last = 0.5;
      for (int j = 0; j + 1 < ambient; ++j) last += (j + 1) * x[static_cast<std::size_t>(j)] / 3;
      x.back() = nudged(last, generator);
    }
    if (weighted) {
      const double u = generator.uniform();
      // Weights that cancel the squares lift all points to 0, but for rounding.
      x.push_back(generator.below(3) == 0 ? nudged(std::min(square, 1e308), generator)
                  : kind == Kind::lattice ? std::floor(9 * u)
                                          : scale * u);
    }
    all.insert(all.end(), x.begin(), x.end());
  }
  return all;
}

struct Decided {
  std::size_t by_minors = 0, by_pairs = 0, by_both = 0, nearly_degenerate = 0, nearly_degenerate_by_pairs = 0;

  void count(Kind kind, Sign truth, std::optional<Sign> minors, std::optional<Sign> pairs) {
    if (minors) {
      EXPECT_EQ(*minors, truth);
    }
    if (pairs) {
      EXPECT_EQ(*pairs, truth);
    }
    by_minors += minors ? 1 : 0;
    by_pairs += pairs ? 1 : 0;
    if (truth == Sign::zero || kind == Kind::wide || kind == Kind::denormal || kind == Kind::extreme) return;
    by_both += minors && pairs ? 1 : 0;
    EXPECT_TRUE(pairs || !minors) << "twice the precision and yet less certain";
    if (minors) return;
    ++nearly_degenerate;
    nearly_degenerate_by_pairs += pairs ? 1 : 0;
  }
};

template <int K>
std::optional<Sign> binary64_orientation(const RowCase& c) {
  if constexpr (tabulates_minors<K>)
    return detail::orientation_by_minors<K>(c.flat(), c.rows.data(), c.q(), c.grid);
  return detail::orientation_by_elimination<K>(c.flat(), c.rows.data(), c.q(), c.grid);
}

template <int K>
std::optional<Sign> binary64_sphere(const RowCase& c) {
  if constexpr (tabulates_minors<K + 1>)
    return detail::sphere_by_minors<K>(c.flat(), c.rows.data(), c.q(), c.grid);
  return detail::sphere_by_elimination<K>(c.flat(), c.rows.data(), c.q(), c.grid);
}

template <int K>
void expect_stages_agree(std::size_t rounds) {
  random::Generator generator(100 + K);
  std::size_t nearly_cospherical = 0;
  for (const auto& [form, ambient] :
       {std::pair{RowForm::point, K}, {RowForm::weighted_point, K}, {RowForm::point, K + 1}}) {
    Decided orientations, spheres;
    for (std::size_t round = 0; round < test::scaled_count(rounds); ++round)
      for (const Kind kind : kinds) {
        std::vector<int> axes(K);
        std::iota(axes.begin(), axes.end(), 0);
        const RowCase c(form, ambient,
                        random_rows(kind, K + 2, ambient, form == RowForm::weighted_point, generator), axes);
        const Flat flat = c.flat();
        orientations.count(kind, exact_orientation(flat, c.rows.data(), c.q()), binary64_orientation<K>(c),
                           double_double_orientation(flat, c.rows.data(), c.q(), c.grid));
        spheres.count(kind, exact_sphere(flat, c.rows.data(), c.q()), binary64_sphere<K>(c),
                      double_double_sphere(flat, c.rows.data(), c.q(), c.grid));
      }
    for (const Decided& decided : {orientations, spheres}) {
      EXPECT_GT(decided.by_both, 0u);
      EXPECT_GE(decided.nearly_degenerate_by_pairs, decided.nearly_degenerate * 8 / 10);
    }
    nearly_cospherical += spheres.nearly_degenerate;
  }
  if (K > 1) {
    EXPECT_GT(nearly_cospherical, 0u);
  }
}

TEST(StagesByMinors, AgreeWithIntegers1) { expect_stages_agree<1>(1500); }
TEST(StagesByMinors, AgreeWithIntegers2) { expect_stages_agree<2>(1500); }
TEST(StagesByMinors, AgreeWithIntegers3) { expect_stages_agree<3>(1500); }
TEST(StagesByMinors, AgreeWithIntegers4) { expect_stages_agree<4>(1500); }
TEST(StagesByMinors, AgreeWithIntegers5) { expect_stages_agree<5>(1500); }
TEST(StagesByMinors, AgreeWithIntegers6) { expect_stages_agree<6>(300); }
TEST(StagesByMinors, AgreeWithIntegers7) { expect_stages_agree<7>(150); }
TEST(StagesByMinors, AgreeWithIntegers8) { expect_stages_agree<8>(80); }
TEST(StagesByMinors, AgreeWithIntegers9) { expect_stages_agree<9>(40); }

TEST(StagesByMinors, PairsProveZerosOnLargeLattices) {
  constexpr double r = 200000;  // a multiple of 5
  const RowCase c(RowForm::point, 3,
                  {r, 0, 0, 0, -r, 0, 0, 0, r, r * 3 / 5, r * 4 / 5, 0, 0, r * 3 / 5, r * 4 / 5});
  EXPECT_EQ(detail::sphere_by_minors<3>(c.flat(), c.rows.data(), c.q(), c.grid), std::nullopt);
  EXPECT_EQ(double_double_sphere(c.flat(), c.rows.data(), c.q(), c.grid), Sign::zero);
}

TEST(StagesByMinors, EqualCoordinatesAreAnExactZero) {
  const RowCase c(RowForm::point, 2, {0.1, 0.7, 1.3, 0.7, 0.4, 0.7, 0.2, 0.7});
  EXPECT_EQ(direct_orientation<2>(c.flat(), c.rows.data(), c.q(), c.grid), Sign::zero);
  EXPECT_EQ(direct_sphere<2>(c.flat(), c.rows.data(), c.q(), c.grid), Sign::zero);
}

TEST(StagesByMinors, PassOnWhatIsBeyondRange) {
  constexpr double huge = std::numeric_limits<double>::max();
  const RowCase c(RowForm::point, 2, {huge, 0, -huge, 1, 0, huge, 3, -huge});
  EXPECT_EQ(direct_orientation<2>(c.flat(), c.rows.data(), c.q(), c.grid), std::nullopt);
  EXPECT_EQ(direct_sphere<2>(c.flat(), c.rows.data(), c.q(), c.grid), std::nullopt);
}

TEST(StagesByMinors, PairsTakeNoMoreThanTenColumns) {
  const std::vector<double> rows(static_cast<std::size_t>(12 * 11), 0.5);
  const RowCase c(RowForm::point, 11, rows);
  EXPECT_EQ(double_double_orientation(c.flat(), c.rows.data(), c.q(), c.grid), std::nullopt);
  EXPECT_EQ(double_double_sphere(c.flat(), c.rows.data(), c.q(), c.grid), std::nullopt);
}

}  // namespace
}  // namespace delone::kernel
