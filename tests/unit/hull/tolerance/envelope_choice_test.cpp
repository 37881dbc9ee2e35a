// SPDX-License-Identifier: BSD-3-Clause
#include "hull/tolerance/envelope_choice.hpp"
#include "scale.hpp"

#include <delone/lower_hull.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <random>
#include <vector>

namespace delone::hull {
namespace {

using ::testing::ElementsAre;

TEST(EnvelopeChoice, KeepsTheDomainAndWhatIsFarBelow) {
  const std::vector<double> points{0, 0, 1, -0.125, 2, -1, 3, -0.5, 4, 0};
  const std::vector<SignedIndex> all{0, 1, 2, 3, 4};
  EXPECT_THAT(choose_envelope(points, 2, all, 0.125, [] {}).rows, ElementsAre(0, 2, 4));
  EXPECT_THAT(choose_envelope(points, 2, all, 1, [] {}).rows, ElementsAre(0, 4));
  EXPECT_EQ(choose_envelope(points, 2, all, 1, [] {}).max_distance, 1);  // not above the tolerance
}

// Over each row, the exact height of the cell's plane less that of the row.
TEST(EnvelopeChoice, NoPointIsFartherBelow) {
  using Rational = boost::multiprecision::cpp_rational;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (std::size_t round = 0; round < test::scaled_size(6, 1); ++round) {
    std::vector<double> points;
    for (int i = 0; i < 400; ++i) {
      const double x = uniform(random), y = uniform(random);
      points.insert(points.end(), {x, y, x * x + y * y + 0.01 * uniform(random)});
    }
    const LowerHull<> exact(points, 3);
    std::size_t before = exact.vertices().size();
    for (const double tolerance : {1e-12, 0.01, 0.1, 0.5}) {
      const LowerHull<> hull(points, 3, HullSide::lower, {.tolerance = tolerance});
      EXPECT_LE(hull.vertices().size(), before);
      before = hull.vertices().size();
      EXPECT_LE(hull.max_distance(), tolerance);
      for (std::size_t row = 0; row < 400; ++row) {
        const double* p = points.data() + 3 * row;
        const auto cell = hull.find_cell(std::vector{p[0], p[1]});
        ASSERT_TRUE(cell);
        Rational m[3][2], h[3];
        for (std::size_t i = 0; i < 3; ++i) {
          const double* v = points.data() + 3 * static_cast<std::size_t>(hull.cells()[3 * *cell + i]);
          for (int j = 0; j < 2; ++j) m[i][j] = Rational(v[j]) - Rational(p[j]);
          h[i] = Rational(v[2]) - Rational(p[2]);
        }
        const auto area = [&](int a, int b) { return Rational(m[a][0] * m[b][1] - m[a][1] * m[b][0]); };
        const Rational w0 = area(1, 2), w1 = area(2, 0), w2 = area(0, 1);
        EXPECT_LE((w0 * h[0] + w1 * h[1] + w2 * h[2]) / (w0 + w1 + w2), Rational(hull.max_distance()));
      }
    }
    EXPECT_LT(before, exact.vertices().size());
  }
}

}  // namespace
}  // namespace delone::hull
