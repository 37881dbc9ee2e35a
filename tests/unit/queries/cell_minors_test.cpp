// SPDX-License-Identifier: BSD-3-Clause
// The table of minors against exact determinants.
#include "queries/cell_minors.hpp"

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <limits>
#include <utility>
#include <vector>

namespace delone::queries {
namespace {

using Rational = boost::multiprecision::cpp_rational;

TEST(CellMinors, OfATriangle) {
  const double points[3][2] = {{0, 0}, {1, 0}, {0, 1}}, q[2] = {0.25, 0.5};
  const double* vertices[3] = {points[0], points[1], points[2]};
  CellMinors<2> minors;
  ASSERT_TRUE(minors.evaluate(vertices, q));
  EXPECT_EQ(minors.weight(0), 0.25);
  EXPECT_EQ(minors.weight(1), 0.25);
  EXPECT_EQ(minors.weight(2), 0.5);
  EXPECT_LT(minors.bound(), 1e-14);
  std::swap(vertices[0], vertices[1]);  // negatively oriented
  ASSERT_TRUE(minors.evaluate(vertices, q));
  EXPECT_EQ(minors.weight(2), -0.5);
}

TEST(CellMinors, KnowTheirRange) {
  const auto evaluate = [](double a, double b, double q) {
    const double* vertices[2] = {&a, &b};
    return CellMinors<1>().evaluate(vertices, &q);
  };
  EXPECT_TRUE(evaluate(0, 1, 0.5));
  EXPECT_TRUE(evaluate(0, 0x1p100, 0));
  EXPECT_FALSE(evaluate(0, 0x1p101, 0));
  EXPECT_TRUE(evaluate(0, 0x1p-100, 0));
  EXPECT_FALSE(evaluate(0, 0x1p-101, 0));
  EXPECT_FALSE(evaluate(3, 3, 3));
  EXPECT_FALSE(evaluate(-1.5e308, 1.5e308, 0));
}

Rational determinant(std::vector<std::vector<Rational>> a) {
  Rational det = 1;
  for (std::size_t s = 0; s < a.size(); ++s) {
    std::size_t pivot = s;
    while (pivot < a.size() && a[pivot][s] == 0) ++pivot;
    if (pivot == a.size()) return 0;
    if (pivot != s) det = -det;
    std::swap(a[s], a[pivot]);
    det *= a[s][s];
    for (std::size_t i = s + 1; i < a.size(); ++i) {
      const Rational factor = a[i][s] / a[s][s];
      for (std::size_t j = s; j < a.size(); ++j) a[i][j] -= factor * a[s][j];
    }
  }
  return det;
}

/// Coordinate i is (−1)^i times the determinant of all rows p_j − q but the i-th. The last point is q.
template <int K>
void expect_within_bounds(const test::PointSet& set) {
  constexpr std::size_t size = K;
  const double* q = set.points.data() + (K + 1) * size;
  const double* vertices[K + 1];
  for (std::size_t i = 0; i <= size; ++i) vertices[i] = set.points.data() + i * size;
  CellMinors<K> minors;
  if (!minors.evaluate(vertices, q)) return;
  for (std::size_t i = 0; i <= size; ++i) {
    std::vector<std::vector<Rational>> others;
    for (std::size_t j = 0; j <= size; ++j) {
      if (j == i) continue;
      others.emplace_back();
      for (std::size_t c = 0; c < size; ++c)
        others.back().push_back(Rational(vertices[j][c]) - Rational(q[c]));
    }
    const Rational exact = determinant(others) * (i % 2 == 0 ? 1 : -1);
    EXPECT_LT(abs(exact - Rational(minors.weight(static_cast<int>(i)))), Rational(minors.bound()))
        << set.name << ", K = " << K;
  }
}

/// Two queries in one computation get the numbers that each gets alone.
template <int K>
void expect_same_alone(const std::vector<double>& points) {
  constexpr std::size_t size = K;
  const double* vertices[2][K + 1];
  const double* q[2];
  for (std::size_t lane = 0; lane < 2; ++lane) {
    const double* const first = points.data() + lane * (size + 2) * size;
    for (std::size_t i = 0; i <= size; ++i) vertices[lane][i] = first + i * size;
    q[lane] = first + (size + 1) * size;
  }
  CellMinors<K, TwoNumbers> together;
  together.evaluate([&](int j, int c) {
    return TwoNumbers{vertices[0][j][c] - q[0][c], vertices[1][j][c] - q[1][c]};
  });
  for (std::size_t lane = 0; lane < 2; ++lane) {
    CellMinors<K> alone;
    if (!alone.evaluate(vertices[lane], q[lane])) {
      EXPECT_GT(together.bound()[lane], std::numeric_limits<double>::max());
      continue;
    }
    EXPECT_EQ(together.bound()[lane], alone.bound());
    for (int i = 0; i <= K; ++i) EXPECT_EQ(together.weight(i)[lane], alone.weight(i));
  }
}

template <int K>
void test_dimension() {
  for (const test::PointSet& set : test::degenerate_sets(K, K + 2, K))
    if (set.size() == K + 2) expect_within_bounds<K>(set);
  test::Random random(K);
  for (int run = 0; run < 100; ++run) {
    test::PointSet set{"real numbers", K, {}};
    for (int i = 0; i < (K + 2) * K; ++i)
      set.points.push_back(run % 2 == 0 ? random.real() : 1e6 + 0x1p-20 * random.real());
    expect_within_bounds<K>(set);
    std::vector<double> two = set.points;
    for (const double x : set.points) two.push_back(run % 3 == 0 ? x * 1e-40 : -x);
    expect_same_alone<K>(two);
  }
}

TEST(CellMinors, AreWithinTheirBound) {
  test_dimension<1>();
  test_dimension<2>();
  test_dimension<3>();
  test_dimension<4>();
  test_dimension<5>();
  test_dimension<6>();
}

}  // namespace
}  // namespace delone::queries
