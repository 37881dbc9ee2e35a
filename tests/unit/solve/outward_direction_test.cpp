// SPDX-License-Identifier: BSD-3-Clause
// Directions away from a simplex: orthogonal to its facet within the flat, also of thin and of huge ones.
#include "solve/outward_direction.hpp"

#include "degenerate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace delone::solve {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using Simplex = std::vector<std::vector<double>>;

/// Away from the last point.
std::vector<double> outward(const Simplex& points) {
  std::vector<const double*> facet;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) facet.push_back(points[i].data());
  return outward_direction(facet, points.back().data(), points[0].size());
}

TEST(OutwardDirection, OfKnownSimplices) {
  EXPECT_THAT(outward({{2}, {5}}), ElementsAre(-1));
  EXPECT_THAT(outward({{1, 1}, {4, 5}}), ElementsAre(DoubleNear(-0.6, 1e-15), DoubleNear(-0.8, 1e-15)))
      << "on a line, away from the other end";
  EXPECT_THAT(outward({{0, 0}, {4, 0}, {9, 7}}), ElementsAre(DoubleNear(0, 1e-15), DoubleNear(-1, 1e-15)));
  EXPECT_THAT(outward({{0, 0, 5}, {3, 0, 5}, {-8, 1, 5}}),
              ElementsAre(DoubleNear(0, 1e-15), DoubleNear(-1, 1e-15), DoubleNear(0, 1e-15)))
      << "within the plane";
}

TEST(OutwardDirection, WhereEdgesCancelIntegersTell) {
  // The edges of the facet agree to 2^-40; the point behind is nearly in the facet.
  const double tiny = 0x1p-40;
  EXPECT_THAT(outward({{0, 0, 0}, {1, 0, 0}, {1, tiny, 0}, {0, 0, 1}}),
              ElementsAre(DoubleNear(0, 1e-12), DoubleNear(0, 1e-12), DoubleNear(-1, 1e-12)));
  EXPECT_THAT(outward({{0, 0}, {1, 0}, {0.5, tiny}}), ElementsAre(0, -1));
  EXPECT_THAT(outward({{0, 0}, {1, 1}, {1, 1 + 0x1p-52}}),
              ElementsAre(DoubleNear(std::sqrt(0.5), 1e-12), DoubleNear(-std::sqrt(0.5), 1e-12)));
}

TEST(OutwardDirection, OfNumbersOfAnySize) {
  for (const double scale : {0x1p-1074, 1e-300, 1e307}) {
    EXPECT_THAT(outward({{0, 0}, {4 * scale, 0}, {scale, 3 * scale}}),
                ElementsAre(DoubleNear(0, 1e-12), DoubleNear(-1, 1e-12)))
        << scale;
    EXPECT_THAT(outward({{-8 * scale, 0}, {8 * scale, 0}}), ElementsAre(-1, 0)) << scale;
  }
}

TEST(OutwardDirection, IsOrthogonalAndOfUnitLength) {
  test::Random random(1);
  for (std::size_t run = 0; run < 200; ++run) {
    const std::size_t d = 2 + run % 4, k = 1 + run % d;
    Simplex points(k + 1, std::vector<double>(d));
    for (auto& point : points)
      for (double& x : point) x = random.real() - 0.5;
    const std::vector<double> n = outward(points);
    const auto product = [&](const std::vector<double>& a, const std::vector<double>& b) {
      double sum = 0;
      for (std::size_t j = 0; j < d; ++j) sum += n[j] * (a[j] - b[j]);
      return sum;
    };
    for (std::size_t i = 1; i < k; ++i) EXPECT_NEAR(product(points[i], points[0]), 0, 1e-11);
    EXPECT_GT(product(points[0], points[k]), 0);
    double length = 0;
    for (const double x : n) length += x * x;
    EXPECT_NEAR(length, 1, 1e-12);
  }
}

}  // namespace
}  // namespace delone::solve
