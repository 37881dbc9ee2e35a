// SPDX-License-Identifier: BSD-3-Clause
// Determinants in binary64 and in pairs of doubles against the exact stages: on points in general position,
// on nearly degenerate and degenerate ones, over wide ranges of exponents and with denormal numbers.
#include "kernel/double_double_stage.hpp"

#include "base/random.hpp"
#include "brute_force.hpp"
#include "kernel/direct.hpp"
#include "kernel/double_double_determinant.hpp"
#include "kernel/exact.hpp"
#include "row_case.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace delone::kernel {
namespace {

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
                           double_double_orientation(flat, c.rows.data(), c.q()));
        spheres.count(kind, exact_sphere(flat, c.rows.data(), c.q()), binary64_sphere<K>(c),
                      double_double_sphere(flat, c.rows.data(), c.q()));
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

TEST(DoubleDoubleStage, AgreeWithIntegers1) { expect_stages_agree<1>(1500); }
TEST(DoubleDoubleStage, AgreeWithIntegers2) { expect_stages_agree<2>(1500); }
TEST(DoubleDoubleStage, AgreeWithIntegers3) { expect_stages_agree<3>(1500); }
TEST(DoubleDoubleStage, AgreeWithIntegers4) { expect_stages_agree<4>(1500); }
TEST(DoubleDoubleStage, AgreeWithIntegers5) { expect_stages_agree<5>(1500); }
TEST(DoubleDoubleStage, AgreeWithIntegers6) { expect_stages_agree<6>(300); }
TEST(DoubleDoubleStage, AgreeWithIntegers7) { expect_stages_agree<7>(150); }
TEST(DoubleDoubleStage, AgreeWithIntegers8) { expect_stages_agree<8>(80); }
TEST(DoubleDoubleStage, AgreeWithIntegers9) { expect_stages_agree<9>(40); }

TEST(DoubleDoubleStage, PairsProveZerosOnLargeLattices) {
  constexpr double r = 200000;  // a multiple of 5
  const RowCase c(RowForm::point, 3,
                  {r, 0, 0, 0, -r, 0, 0, 0, r, r * 3 / 5, r * 4 / 5, 0, 0, r * 3 / 5, r * 4 / 5});
  EXPECT_EQ(detail::sphere_by_minors<3>(c.flat(), c.rows.data(), c.q(), c.grid), std::nullopt);
  EXPECT_EQ(double_double_sphere(c.flat(), c.rows.data(), c.q()), Sign::zero);
}

TEST(DoubleDoubleStage, PairsTakeNoMoreThanTwelveColumns) {
  const std::vector<double> rows(static_cast<std::size_t>(14 * 12), 0.5);
  const RowCase c(RowForm::point, 12, rows);
  EXPECT_EQ(double_double_orientation(c.flat(), c.rows.data(), c.q()), std::nullopt);
  EXPECT_EQ(double_double_sphere(c.flat(), c.rows.data(), c.q()), std::nullopt);
}

/// Rows whose determinant is 0, or is not by the last bits of some entries.
std::vector<double> nearly_dependent_rows(Kind kind, int n, random::Generator& generator) {
  std::vector<double> all = random_rows(kind, n, n, false, generator);
  all.resize(static_cast<std::size_t>(n * n));
  if (n < 2 || generator.below(2) == 0) return all;
  double* const last = all.data() + (n - 1) * n;
  for (int c = 0; c < n; ++c) {
    double sum = 0;
    for (int i = 0; i + 1 < n; ++i) sum += all[static_cast<std::size_t>(i * n + c)] / 2;
    last[c] = generator.below(2) == 0 ? sum : nudged(sum, generator);
  }
  return all;
}

// What is certain is right, also that a determinant is zero; of nearly all others the sign is certain.
TEST(DoubleDoubleStage, DeterminantsOfRows) {
  const std::size_t repetitions = test::scaled_count(100);
  std::size_t certain = 0, zeros = 0, all = 0;
  for (const Kind kind : kinds)
    for (int n = 1; n <= 7; ++n) {
      random::Generator generator(static_cast<std::uint64_t>(100 * static_cast<int>(kind) + n));
      std::vector<int> axes;
      for (int c = 0; c < n; ++c) axes.push_back(c);
      for (std::size_t repetition = 0; repetition < repetitions; ++repetition) {
        const std::vector<double> entries = nearly_dependent_rows(kind, n, generator);
        std::vector<const double*> rows;
        for (int i = 0; i < n; ++i) rows.push_back(entries.data() + i * n);
        const test::Integer exact = test::determinant(test::scaled_to_integers(entries, n));
        const Sign expected = exact > 0 ? Sign::positive : exact < 0 ? Sign::negative : Sign::zero;
        EXPECT_EQ(exact_determinant(axes, rows.data()), expected);
        const auto sign = double_double_determinant(axes, rows.data());
        if (n > 6) {
          EXPECT_FALSE(sign);
          continue;
        }
        ++all;
        if (!sign) continue;
        ++certain;
        zeros += *sign == Sign::zero ? 1 : 0;
        EXPECT_EQ(*sign, expected) << "kind " << static_cast<int>(kind) << ", " << n << " rows";
      }
    }
  EXPECT_GT(certain, all * 3 / 4);
  EXPECT_GT(zeros, 0u);
}

}  // namespace
}  // namespace delone::kernel
