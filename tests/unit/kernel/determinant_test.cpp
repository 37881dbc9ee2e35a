// SPDX-License-Identifier: BSD-3-Clause
// The certified bound of the elimination against determinants in exact integers; and the linear solver on top
// of it.
#include "kernel/determinant.hpp"

#include "base/random.hpp"
#include "brute_force.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace delone::kernel {
namespace {

enum class Shape { uniform, nearly_singular, graded };

/// A matrix of n columns of n entries, one column after the other.
std::vector<double> random_matrix(int n, Shape shape, random::Generator& generator) {
  std::vector<double> a;
  const auto size = static_cast<std::size_t>(n);
  for (std::size_t i = 0; i < size * size; ++i) a.push_back(2 * generator.uniform() - 1);
  for (std::size_t j = 0; j < size; ++j)
    for (std::size_t r = 0; r < size; ++r) {
      if (shape == Shape::graded) a[j * size + r] = std::ldexp(a[j * size + r], -3 * static_cast<int>(j + r));
      if (shape == Shape::nearly_singular && j > 0 && j + 1 == size)
        a[j * size + r] = a[r] + std::ldexp(a[j * size + r], -50);
    }
  return a;
}

/// value − exact determinant, as a double that is right to a few bits.
double true_error(const std::vector<double>& a, int n, double value) {
  std::vector<double> all = a;
  all.push_back(1);  // pads to rows of n; only the common scale matters
  all.resize(static_cast<std::size_t>((n + 1) * n), 0.0);
  test::Matrix rows = test::scaled_to_integers(all, n);
  const test::Integer one = rows.back()[0];  // the integer that stands for 1
  rows.pop_back();
  const test::Integer exact = test::determinant(rows);
  int exponent;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
  test::Integer unit = 1;
  for (int i = 0; i < n; ++i) unit *= one;
  const int shift = exponent - 53;
  // value = mantissa·2^shift against exact/unit: over the common denominator unit·2^−shift.
  const test::Integer numerator = shift < 0
                                      ? test::Integer(mantissa * unit - (exact << -shift))
                                      : test::Integer((test::Integer(mantissa) << shift) * unit - exact);
  const test::Integer denominator = shift < 0 ? test::Integer(unit << -shift) : unit;
  return boost::multiprecision::cpp_rational(numerator, denominator).convert_to<double>();
}

template <int N>
void expect_bound_holds(int n) {
  random::Generator generator(static_cast<std::uint64_t>(n));
  std::vector<int> row_of(static_cast<std::size_t>(n));
  int certain = 0, rounds = 0;
  for (const Shape shape : {Shape::uniform, Shape::nearly_singular, Shape::graded})
    for (std::size_t round = 0; round < test::scaled_count(200); ++round) {
      const std::vector<double> a = random_matrix(n, shape, generator);
      std::vector<double> factors = a;
      const CertifiedDeterminant det = factor<N>(factors.data(), n, n, {}, row_of.data());
      ++rounds;
      if (!std::isfinite(det.error)) continue;
      EXPECT_LE(std::fabs(true_error(a, n, det.value)), det.error) << "n = " << n;
      certain += det.sign_is_certain();
    }
  EXPECT_GE(3 * certain, rounds) << "the bound does not even decide random matrices";
}

TEST(Determinant, ErrorStaysBelowTheBound) {
  expect_bound_holds<1>(1);
  expect_bound_holds<2>(2);
  expect_bound_holds<3>(3);
  expect_bound_holds<4>(4);
  expect_bound_holds<5>(5);
  expect_bound_holds<6>(6);
  expect_bound_holds<9>(9);
  expect_bound_holds<0>(4);
  expect_bound_holds<0>(12);
}

TEST(Determinant, RelativeErrorsOfEntriesCount) {
  std::vector<double> a{1, 0, 0, 1};
  int row_of[2];
  const CertifiedDeterminant det = factor<2>(a.data(), 2, 2, {1e-3, 1e-3}, row_of);
  EXPECT_EQ(det.value, 1);
  EXPECT_GE(det.error, 4e-3);
}

TEST(Determinant, NothingIsKnownOfZeroColumnsAndOfNaN) {
  int row_of[2];
  std::vector<double> zero{0, 0, 1, 1}, undefined{std::nan(""), 1, 1, 1}, infinite{INFINITY, 1, 1, 1};
  for (auto* a : {&zero, &undefined, &infinite})
    EXPECT_FALSE(factor<2>(a->data(), 2, 2, {}, row_of).sign_is_certain());
}

TEST(Determinant, ASingularMatrixIsNeverCertain) {
  int row_of[3];
  std::vector<double> a{1, 2, 3, 2, 4, 6, 1, 0, 5};
  const CertifiedDeterminant det = factor<3>(a.data(), 3, 3, {}, row_of);
  EXPECT_FALSE(det.sign_is_certain());
  EXPECT_LT(det.error, 1e-12);
}

TEST(Determinant, SolvesForTheFunctionalOfItsColumns) {
  random::Generator generator(7);
  for (int rows : {4, 5}) {  // square, and with one coordinate left over
    const int n = 4;
    std::vector<double> a;
    for (int i = 0; i < n * rows; ++i) a.push_back(2 * generator.uniform() - 1);
    std::vector<double> factors = a, x(static_cast<std::size_t>(rows), 0.0);
    std::vector<double> heights(n, 0.0);
    if (rows == n)
      for (double& height : heights) height = generator.uniform();
    else
      x.back() = 1;
    const std::vector<double> given = heights;
    std::vector<int> row_of(n);
    ASSERT_TRUE(factor<n>(factors.data(), n, rows, {}, row_of.data()).sign_is_certain());
    solve_transposed<n>(factors.data(), n, rows, row_of.data(), heights.data(), x.data());
    double largest = 0;
    for (int j = 0; j < n; ++j) {
      double sum = given[static_cast<std::size_t>(j)];
      for (int r = 0; r < rows; ++r)
        sum += a[static_cast<std::size_t>(j * rows + r)] * x[static_cast<std::size_t>(r)];
      EXPECT_NEAR(sum, 0, 1e-12);
    }
    for (const double value : x) largest = std::max(largest, std::fabs(value));
    EXPECT_GT(largest, 0);
  }
}

}  // namespace
}  // namespace delone::kernel
