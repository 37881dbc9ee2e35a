// SPDX-License-Identifier: BSD-3-Clause
// Against optimality conditions with rationals: the point is a convex combination of its face, orthogonal to
// it, and no point lies beyond its supporting hyperplane.
#include "kernel/nearest_in_hull.hpp"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace delone::kernel {
namespace {

using Rational = boost::multiprecision::cpp_rational;

struct Case {
  int d;
  std::vector<double> coordinates, q;
  std::vector<const double*> points() const {
    std::vector<const double*> result;
    for (std::size_t i = 0; i < coordinates.size(); i += static_cast<std::size_t>(d))
      result.push_back(coordinates.data() + i);
    return result;
  }
};

Rational squared(const ExactNearest& nearest) {
  Rational result(nearest.squared, nearest.denominator);
  for (int i = 0; i < std::abs(nearest.grid); ++i)
    result = nearest.grid > 0 ? Rational(result * 4) : Rational(result / 4);
  return result;
}

/// Checks the exact answer by its optimality conditions, and the bounds against it.
void check(const Case& c) {
  const auto points = c.points();
  const auto d = static_cast<std::size_t>(c.d);
  const ExactNearest nearest = nearest_in_hull_exactly(points, c.q.data(), c.d);
  std::vector<Rational> z(d);
  Rational sum(0);
  for (std::size_t i = 0; i < nearest.face.size(); ++i) {
    const Rational w(nearest.numerators[i], nearest.denominator);
    ASSERT_GT(w, 0);
    sum += w;
    const double* p = points[static_cast<std::size_t>(nearest.face[i])];
    for (std::size_t j = 0; j < d; ++j) z[j] += w * (Rational(p[j]) - Rational(c.q[j]));
  }
  ASSERT_EQ(sum, 1);
  Rational square(0);
  for (const Rational& x : z) square += x * x;
  ASSERT_EQ(square, squared(nearest));
  for (const double* p : points) {
    Rational product(0);
    for (std::size_t j = 0; j < d; ++j) product += z[j] * (Rational(p[j]) - Rational(c.q[j]));
    ASSERT_GE(product, square);
  }

  NearestInHull rounded;
  rounded.find(points, c.q.data(), c.d);
  const auto is_square_at_most = [](double root, const Rational& x) {
    return std::isfinite(root) && Rational(root) * Rational(root) <= x;
  };
  EXPECT_TRUE(is_square_at_most(rounded.lower(), square));
  Rational total(0);
  std::vector<Rational> found(d);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Rational w(rounded.weights()[i]);
    ASSERT_GE(w, 0);
    total += w;
    for (std::size_t j = 0; j < d; ++j) found[j] += w * (Rational(points[i][j]) - Rational(c.q[j]));
  }
  Rational found_square(0);
  for (const Rational& x : found) found_square += x * x / (total * total);
  EXPECT_TRUE(!std::isfinite(rounded.upper()) ||
              !(Rational(rounded.upper()) * Rational(rounded.upper()) < found_square));
  EXPECT_GE(found_square, square);

  const ExactNearest guessed = nearest_in_hull_exactly(points, c.q.data(), c.d, rounded.face());
  EXPECT_EQ(guessed.compare(nearest), Sign::zero);
  for (const double t : {rounded.lower(), rounded.upper()}) {
    if (!std::isfinite(t)) continue;
    const Rational gap = square - Rational(t) * Rational(t);
    EXPECT_EQ(nearest.compare(t), gap > 0 ? Sign::positive : gap < 0 ? Sign::negative : Sign::zero);
  }
}

TEST(NearestInHull, RandomSimplices) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int d = 1; d <= 6; ++d)
    for (int m = 1; m <= d + 1; ++m)
      for (int round = 0; round < 12; ++round) {
        Case c{d, {}, {}};
        for (int i = 0; i < m * d; ++i) c.coordinates.push_back(uniform(random));
        for (int j = 0; j < d; ++j) c.q.push_back(1.5 * uniform(random));
        check(c);
        NearestInHull rounded;
        rounded.find(c.points(), c.q.data(), d);
        EXPECT_LT(rounded.upper() - rounded.lower(), 1e-11) << d << " " << m;
      }
}

TEST(NearestInHull, SmallIntegers) {
  std::mt19937_64 random(2);
  for (int d = 1; d <= 4; ++d)
    for (int m = 1; m <= 9; ++m)
      for (int round = 0; round < 12; ++round) {
        Case c{d, {}, {}};
        for (int i = 0; i < m * d; ++i) c.coordinates.push_back(static_cast<double>(random() % 4));
        for (int j = 0; j < d; ++j) c.q.push_back(static_cast<double>(random() % 4));
        check(c);
      }
}

TEST(NearestInHull, Slivers) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int d = 2; d <= 4; ++d)
    for (const double height : {0.0, 1e-16, 1e-12, 1e-6})
      for (int round = 0; round < 12; ++round) {
        Case c{d, {}, {}};
        for (int i = 0; i <= d; ++i)
          for (int j = 0; j < d; ++j) c.coordinates.push_back(uniform(random) * (j + 1 == d ? height : 1));
        for (int j = 0; j < d; ++j) c.q.push_back(0.3 * uniform(random) * (j + 1 == d ? 1e-9 : 1));
        check(c);
      }
}

TEST(NearestInHull, AnySize) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double size : {1e-320, 1e-300, 1e-160, 1e160, 1e300, std::numeric_limits<double>::max()})
    for (int round = 0; round < 6; ++round) {
      Case c{3, {}, {}};
      for (int i = 0; i < 12; ++i) c.coordinates.push_back(size * uniform(random));
      for (int j = 0; j < 3; ++j) c.q.push_back(size * uniform(random));
      check(c);
      c.coordinates[4] = 1e-310;
      check(c);
    }
}

TEST(NearestInHull, CloseToTheFaceTheBoundsAreClose) {
  const Case c{3, {0, 0, 0, 1, 0.1, 0.2, 0.3, 1, 0.7, -0.2, 0.4, 0.9}, {0.4, 0.2, 0.2}};
  NearestInHull nearest;
  nearest.find(c.points(), c.q.data(), 3);
  std::vector<double> q = c.q;
  for (const double share : {1e-3, 1e-6, 1e-9, 1e-12}) {
    // A point this far beyond an edge's middle.
    q = {0.5 + 0.0 * share, 0.05 - 2 * share, 0.1 - share};
    nearest.find(c.points(), q.data(), 3);
    EXPECT_GT(nearest.lower(), 0.999 * nearest.upper()) << share;
    EXPECT_LT(nearest.upper(), 3 * share);
    check({3, c.coordinates, q});
  }
}

TEST(NearestInHull, OnAVertexTheDistanceIsZero) {
  Case c{2, {0, 0, 1, 0, 0, 1}, {1, 0}};
  NearestInHull nearest;
  nearest.find(c.points(), c.q.data(), 2);
  EXPECT_EQ(nearest.upper(), 0);
  EXPECT_EQ(nearest.lower(), 0);
  ASSERT_EQ(nearest.face().size(), 1u);
  EXPECT_EQ(nearest.face()[0], 1);
  EXPECT_EQ(nearest_in_hull_exactly(c.points(), c.q.data(), 2).compare(0), Sign::zero);
  // Beside large numbers, the smallest is not taken for 0.
  c = {2, {0x1p-1074, 0, 1e10, 1, 1e10, -1}, {0, 0}};
  nearest.find(c.points(), c.q.data(), 2);
  EXPECT_GT(nearest.upper(), 0);
  check(c);
}

}  // namespace
}  // namespace delone::kernel
