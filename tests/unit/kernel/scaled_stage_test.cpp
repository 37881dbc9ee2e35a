// SPDX-License-Identifier: BSD-3-Clause
// Determinants along the edges of trees against integers: points in clusters of many widths, in general
// position, nearly and exactly degenerate; coordinates of all magnitudes; integers whose determinant is −1, 0
// or 1.
#include "kernel/scaled_stage.hpp"

#include "base/random.hpp"
#include "kernel/exact.hpp"
#include "row_case.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace delone::kernel {
namespace {

struct Decided {
  std::size_t cases = 0, decided = 0, zeros = 0;
  void count(std::optional<Sign> sign, Sign truth) {
    ++cases;
    zeros += truth == Sign::zero ? 1 : 0;
    if (!sign) return;
    ++decided;
    EXPECT_EQ(*sign, truth);
  }
};

/// k + 2 rows in up to four clusters, each of its own width.
std::vector<double> clusters(int k, bool weighted, random::Generator& generator) {
  const auto d = static_cast<std::size_t>(k);
  const std::size_t num = 1 + generator.below(4);
  std::vector<double> centers, widths, all;
  for (std::size_t c = 0; c < num; ++c) {
    widths.push_back(std::ldexp(1.0, -static_cast<int>(generator.below(54))));
    for (std::size_t j = 0; j < d; ++j) centers.push_back(generator.uniform());
  }
  for (std::size_t i = 0; i < d + 2; ++i) {
    const std::size_t c = generator.below(num);
    for (std::size_t j = 0; j < d; ++j)
      all.push_back(centers[c * d + j] + widths[c] * (generator.uniform() - 0.5));
    if (weighted) all.push_back(widths[c] * generator.uniform());
  }
  return all;
}

/// The same, the last row moved to a combination of the others, or nearly.
void make_degenerate(std::vector<double>& rows, std::size_t size, random::Generator& generator) {
  const std::size_t n = rows.size() / size, a = generator.below(n - 1), b = (a + 1) % (n - 1);
  const double t = static_cast<double>(generator.below(5)) / 4;
  for (std::size_t j = 0; j < size; ++j) {
    double& x = rows[(n - 1) * size + j];
    x = rows[a * size + j] + t * (rows[b * size + j] - rows[a * size + j]);
    if (generator.below(8) == 0) x = std::nextafter(x, 2.0);
  }
}

TEST(ScaledStage, AgreesWithIntegersOnClusters) {
  random::Generator generator(7);
  for (const RowForm form : {RowForm::point, RowForm::weighted_point})
    for (int k = 2; k <= 9; ++k) {
      Decided general, degenerate;
      for (std::size_t round = 0; round < test::scaled_count(80); ++round) {
        std::vector<double> rows = clusters(k, form == RowForm::weighted_point, generator);
        const bool is_degenerate = generator.coin();
        if (is_degenerate) make_degenerate(rows, rows.size() / static_cast<std::size_t>(k + 2), generator);
        const RowCase c(form, k, rows);
        Decided& decided = is_degenerate ? degenerate : general;
        decided.count(scaled_orientation(c.flat(), c.rows.data(), c.q()),
                      exact_orientation(c.flat(), c.rows.data(), c.q()));
        decided.count(scaled_sphere(c.flat(), c.rows.data(), c.q()),
                      exact_sphere(c.flat(), c.rows.data(), c.q()));
      }
      EXPECT_GE(general.decided * 10, general.cases * 9) << k;
      EXPECT_GT(degenerate.cases, 0u);
    }
}

TEST(ScaledStage, AgreesWithIntegersOnAllMagnitudes) {
  random::Generator generator(8);
  for (const std::size_t kind : {std::size_t{3}, std::size_t{4}, std::size_t{5}})
    for (int k = 2; k <= 9; ++k) {
      Decided orientations, spheres;
      for (std::size_t round = 0; round < test::scaled_count(k < 8 ? 12 : 4); ++round) {
        const RowCase c(RowForm::point, k,
                        random_numbers(static_cast<std::size_t>(k * (k + 2)), kind, generator));
        orientations.count(scaled_orientation(c.flat(), c.rows.data(), c.q()),
                           exact_orientation(c.flat(), c.rows.data(), c.q()));
        spheres.count(scaled_sphere(c.flat(), c.rows.data(), c.q()),
                      exact_sphere(c.flat(), c.rows.data(), c.q()));
      }
      if (kind == 4) {
        EXPECT_EQ(orientations.decided, orientations.cases) << k;
      }
    }
}

// Points are the rows of unimodular matrices with entries of up to 45 bits, the last one replaced by a
// combination of the others in a third of the cases: no determinant is larger than 1.
TEST(ScaledStage, ClaimsNothingWrongOfDeterminantsAtMostOne) {
  random::Generator generator(9);
  for (int k = 3; k <= 9; ++k) {
    const auto d = static_cast<std::size_t>(k);
    Decided decided;
    for (std::size_t round = 0; round < test::scaled_count(150); ++round) {
      std::vector<double> rows((d + 2) * d, 0.0);  // the base is the origin
      for (std::size_t i = 0; i < d; ++i) rows[i * d + i] = 1;
      if (round % 3 == 0) rows[d * d - 1] = 0;
      const double most = std::ldexp(1.0, static_cast<int>(10 + generator.below(36)));
      for (double largest = 0; largest < most;) {
        const std::size_t a = generator.below(d), b = (a + 1 + generator.below(d - 1)) % d;
        const double factor = static_cast<double>(generator.below(7)) - 3;
        const bool of_rows = generator.coin();
        for (std::size_t j = 0; j < d; ++j) {
          double& x = of_rows ? rows[a * d + j] : rows[j * d + a];
          x += factor * (of_rows ? rows[b * d + j] : rows[j * d + b]);
          largest = std::max(largest, std::fabs(x));
        }
      }
      const RowCase c(RowForm::point, k, rows);
      const Sign truth = exact_orientation(c.flat(), c.rows.data(), c.q());
      ASSERT_EQ(truth == Sign::zero, round % 3 == 0);
      decided.count(scaled_orientation(c.flat(), c.rows.data(), c.q()), truth);
    }
    EXPECT_LT(decided.decided, decided.cases) << k;
  }
}

}  // namespace
}  // namespace delone::kernel
