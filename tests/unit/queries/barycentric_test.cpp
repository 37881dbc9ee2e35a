// SPDX-License-Identifier: BSD-3-Clause
// Barycentric coordinates against exact rationals, and gradients of known functions.
#include "queries/barycentric.hpp"

#include "degenerate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <limits>
#include <numeric>

namespace delone::queries {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Points = std::vector<std::vector<double>>;
using ::testing::DoubleNear;
using ::testing::ElementsAre;

constexpr double least = std::numeric_limits<double>::min();

std::vector<const double*> pointers(const Points& points) {
  std::vector<const double*> result;
  for (const std::vector<double>& p : points) result.push_back(p.data());
  return result;
}

/// `face`: which vertices span the smallest face around q; all by default.
std::vector<double> weights_of(const Points& points, const std::vector<int>& axes,
                               const std::vector<double>& q, std::vector<unsigned char> face = {}) {
  if (face.empty()) face.assign(points.size(), 1);
  std::vector<double> weights;
  barycentric(pointers(points), face, axes, q.data(), weights);
  return weights;
}

TEST(Barycentric, OfKnownPoints) {
  EXPECT_THAT(weights_of({{0}, {4}}, {0}, {1}), ElementsAre(0.75, 0.25));
  EXPECT_THAT(weights_of({{0, 0}, {1, 0}, {0, 1}}, {0, 1}, {0.25, 0.5}), ElementsAre(0.25, 0.25, 0.5));
  EXPECT_THAT(weights_of({{7, 8}}, {}, {7, 8}), ElementsAre(1));  // k = 0
  // On a line of R³ that projects on its third axis.
  EXPECT_THAT(weights_of({{1, 5, 0}, {1, 5, 8}}, {2}, {1, 5, 6}), ElementsAre(0.25, 0.75));
}

TEST(Barycentric, AreZeroOffTheFaceAndPositiveOnIt) {
  EXPECT_THAT(weights_of({{0, 0}, {1, 0}, {0, 1}}, {0, 1}, {0.5, 0.5}, {0, 1, 1}), ElementsAre(0, 0.5, 0.5));
  EXPECT_THAT(weights_of({{0, 0}, {1, 0}, {0, 1}}, {0, 1}, {1, 0}, {0, 1, 0}), ElementsAre(0, 1, 0));
  // One third of the least double above the first edge: inside, though the third coordinate rounds to 0.
  EXPECT_THAT(weights_of({{0, 0}, {1, 0}, {0.5, 3}}, {0, 1}, {0.5, 0x1p-1074}), ElementsAre(0.5, 0.5, least));
  // What rounding leaves of a coordinate that is 0 does not show.
  EXPECT_THAT(weights_of({{0, 0}, {1, 0}, {0.5, 3}}, {0, 1}, {0.5, 0x1p-60}, {1, 1, 0}),
              ElementsAre(0.5, 0.5, 0));
}

/// The coordinates by elimination.
std::vector<Rational> exact_weights(const Points& points, const std::vector<double>& q) {
  const std::size_t n = q.size();
  std::vector<std::vector<Rational>> a(n, std::vector<Rational>(n + 1));
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t j = 0; j < n; ++j) a[r][j] = Rational(points[j + 1][r]) - Rational(points[0][r]);
    a[r][n] = Rational(q[r]) - Rational(points[0][r]);
  }
  for (std::size_t s = 0; s < n; ++s) {
    std::size_t pivot = s;
    while (pivot < n && a[pivot][s] == 0) ++pivot;
    if (pivot == n) return {};
    std::swap(a[s], a[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      const Rational factor = i == s ? Rational(0) : a[i][s] / a[s][s];
      for (std::size_t j = s; j <= n && factor != 0; ++j) a[i][j] -= factor * a[s][j];
    }
  }
  std::vector<Rational> weights(1, Rational(1));
  for (std::size_t s = 0; s < n; ++s) {
    weights.push_back(a[s][n] / a[s][s]);
    weights[0] -= weights.back();
  }
  return weights;
}

// Random simplices, thin ones, and some so thin that binary64 gives up.
TEST(Barycentric, AreWithinTheirBound) {
  test::Random random(1);
  for (int run = 0; run < 400; ++run) {
    const std::size_t d = 1 + run % 6;
    const double thin = run % 4 == 0 ? 0x1p-20 : run % 4 == 1 ? 0x1p-50 : 1;
    const double scale = run % 10 == 3 ? 0x1p-600 : run % 10 == 6 ? 0x1p600 : 1;
    Points points(d + 1);
    for (auto& p : points) {
      for (std::size_t j = 0; j < d; ++j)
        p.push_back(scale * (run % 3 == 0 ? random.integer(-3, 3) : random.real() - 0.5));
      if (d > 1) p[d - 1] = scale * (p[0] / scale + thin * random.real());
    }
    std::vector<double> q(d, 0.0);  // near the mean, or a vertex
    for (const auto& p : points)
      for (std::size_t j = 0; j < d; ++j) q[j] += p[j] / static_cast<double>(d + 1);
    if (run % 5 == 0) q = points[0];
    const std::vector<Rational> exact = exact_weights(points, q);
    if (exact.empty()) continue;
    std::vector<unsigned char> face;
    bool is_inside = true;
    for (const Rational& w : exact) {
      is_inside = is_inside && w >= 0;
      face.push_back(w > 0 ? 1 : 0);
    }
    if (!is_inside) continue;
    std::vector<int> axes(d);
    std::iota(axes.begin(), axes.end(), 0);
    const std::vector<double> weights = weights_of(points, axes, q, face);
    for (std::size_t i = 0; i <= d; ++i) {
      EXPECT_LE(abs(Rational(weights[i]) - exact[i]), Rational(largest_weight_error)) << run;
      EXPECT_EQ(weights[i] > 0, exact[i] > 0) << run;
    }
  }
}

TEST(Barycentric, AtTheEndsOfTheRange) {
  EXPECT_THAT(weights_of({{-1.5e308}, {1.5e308}}, {0}, {0}), ElementsAre(0.5, 0.5));
  EXPECT_THAT(weights_of({{0}, {0x1p-1072}}, {0}, {0x1p-1074}), ElementsAre(0.75, 0.25));
  EXPECT_THAT(weights_of({{1}, {1 + 0x1p-50}}, {0}, {1 + 0x1p-52}), ElementsAre(0.75, 0.25));
  EXPECT_THAT(weights_of({{0, 0}, {1e300, 0}, {0, 1e-300}}, {0, 1}, {5e299, 2.5e-301}),
              ElementsAre(0.25, 0.5, DoubleNear(0.25, 1e-15)));
}

std::vector<double> gradients_of(const Points& points, const std::vector<double>& values, int columns) {
  std::vector<double> result;
  gradients(pointers(points), values, columns, static_cast<int>(points[0].size()), result);
  return result;
}

TEST(Gradients, OfAffineFunctions) {
  const auto near = [](double x) { return DoubleNear(x, 1e-14); };
  EXPECT_THAT(gradients_of({{1}, {3}}, {5, 9}, 1), ElementsAre(2));
  // 2x − 3y + 1 and y, at three points.
  EXPECT_THAT(gradients_of({{0, 0}, {2, 1}, {1, 3}}, {1, 0, 2, 1, -6, 3}, 2),
              ElementsAre(near(2), near(-3), near(0), near(1)));
  EXPECT_THAT(gradients_of({{4, 4}}, {7}, 1), ElementsAre(0, 0));  // one point: constant
}

// The gradient lies in the flat: x on the line x = y has the gradient (1/2, 1/2).
TEST(Gradients, AreTangentToTheFlat) {
  EXPECT_THAT(gradients_of({{1, 1}, {3, 3}}, {1, 3}, 1),
              ElementsAre(DoubleNear(0.5, 1e-15), DoubleNear(0.5, 1e-15)));
}

TEST(Gradients, OfThinAndOfHugeSimplices) {
  const double thin = 0x1p-40;
  EXPECT_THAT(gradients_of({{0, 0}, {1, 0}, {1, thin}}, {0, 1, 1 + thin}, 1),
              ElementsAre(DoubleNear(1, 1e-10), DoubleNear(1, 1e-10)));
  EXPECT_THAT(gradients_of({{-1.5e308, 0}, {1.5e308, 0}, {0, 1e308}}, {-1.5, 1.5, 0}, 1),
              ElementsAre(DoubleNear(1e-308, 1e-321), DoubleNear(0, 1e-321)));
}

}  // namespace
}  // namespace delone::queries
