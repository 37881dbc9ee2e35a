// SPDX-License-Identifier: BSD-3-Clause
// Certified inverses of the edges of a simplex from its first vertex, in binary64 and in pairs of doubles.
//
// Edge i is a_i = p_i − p_0, row i of the n×d matrix A. S and W are diagonal, of powers of two, and no entry
// of A' = S·A·W exceeds 1. If n = d, M = A', otherwise W = 1 and M = A'·A'ᵀ. Columns of A in different units,
// and edges of different lengths, so do no harm where n = d; the condition of A' is the root of that of
// A'·A'ᵀ.
//
// Let ε be a bound on relative errors of products, and of sums relative to the magnitudes of both terms: u,
// or 9u² for pairs (kernel/double_double.hpp). Entries of M are known up to 1.02·ι·ε·μ, where no entry
// exceeds μ: in M = A', μ = 1, ι = 1; in M = A'·A'ᵀ, d products of entries with errors of ε and d sums make ι
// = d + 3 and μ = d.
//
// X is an approximate inverse, R = I − M·X, C_j the sum of |X_mj| in column j. Entry (i, j) of R is computed
// by n products and n differences of partial sums of at most 1.01(1 + μC_j), so it is off by at most
// ε_j = 1.05·ε(n + 1 + ι)(1 + μC_j); 10⁻²⁷⁵ covers what underflows, as X is at most 10⁴⁰. Let ρ_j be the
// largest |R_mj| plus ε_j, and the row sums of |R| with their errors at most 1/2. As M⁻¹ − X = X·R·(I − R)⁻¹,
// and the largest entry of R·(I − R)⁻¹e_j is at most 2ρ_j,
//     |M⁻¹ − X|_ij ≤ 2·r_i·ρ_j,   r_i = Σ_m |X_im|,   and ‖M⁻¹‖ ≤ 2·max r_i in the norm of row sums.
// Newton's step X + X·R squares R, up to roundings.
#pragma once

#include "kernel/buffer.hpp"
#include "kernel/direct.hpp"
#include "kernel/double_double.hpp"
#include "kernel/linear_bound.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace delone::internal {

using kernel::DoubleDouble;

inline double high_of(double x) { return x; }
inline double high_of(const DoubleDouble& x) { return x.high; }
inline double scaled(double x, double power) { return x * power; }
inline DoubleDouble scaled(const DoubleDouble& x, double power) { return {x.high * power, x.low * power}; }

/// Of N edges, N > 1, or N = 0: chosen at run time. T: double or DoubleDouble.
template <int N, class T>
class EdgeInverse {
 public:
  static constexpr bool is_double = std::is_same_v<T, double>;
  static constexpr double epsilon =
      is_double ? kernel::unit_roundoff : 9 * kernel::unit_roundoff * kernel::unit_roundoff;
  template <class U>
  using Matrix = kernel::Buffer<U, N * N>;
  template <class U>
  using Vector = kernel::Buffer<U, N>;

  const std::size_t n, d;
  Vector<double> edge_scale, axis_scale;  ///< diagonals of S, and of W if is_square()
  Matrix<T> matrix, inverse;              ///< M and X
  Vector<double> row_sum, defect;         ///< r_i and ρ_j
  double largest_entry, input_error;      ///< μ and ι

  static T number(double x) {
    if constexpr (is_double)
      return x;
    else
      return {x, 0};
  }
  static T difference(double a, double b) {
    if constexpr (is_double)
      return a - b;
    else
      return kernel::two_sum(a, -b);
  }

  EdgeInverse(const double* const* points, std::size_t corners, std::size_t dimension)
      : n(N > 0 ? static_cast<std::size_t>(N) : corners - 1),
        d(dimension),
        edge_scale(n),
        axis_scale(n),
        matrix(n * n),
        inverse(n * n),
        row_sum(n),
        defect(n),
        largest_entry(is_square() ? 1 : static_cast<double>(d)),
        input_error(is_square() ? 1 : static_cast<double>(d) + 3),
        points_(points) {}

  bool is_square() const { return n == d; }
  /// a_ij, up to ε.
  T edge(std::size_t i, std::size_t j) const { return difference(points_[i + 1][j], points_[0][j]); }

  /// False if nothing is certified.
  bool invert() {
    if (!(is_square() ? fill_square() : fill_gram())) return false;
    Matrix<double> work(n * n), start(n * n);
    for (std::size_t i = 0; i < n * n; ++i) work[i] = high_of(matrix[i]);
    if (!kernel::approximate_inverse<N>(work.data(), start.data(), n)) return false;
    for (std::size_t i = 0; i < n * n; ++i) inverse[i] = number(start[i]);
    return certify();
  }

  /// One of Newton's steps. False if that does not make the bounds better by much, or if nothing is
  /// certified.
  bool improve() {
    if constexpr (is_double) {
      return false;
    } else {
      const double before = largest_defect_;
      if (!(before > 1e-28)) return false;
      Matrix<double> step(n * n);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
          double sum = 0;
          for (std::size_t m = 0; m < n; ++m) sum += inverse[i * n + m].high * residual_[m * n + j];
          step[i * n + j] = sum;
        }
      for (std::size_t i = 0; i < n * n; ++i) inverse[i] = inverse[i] + DoubleDouble{step[i], 0};
      return certify() && largest_defect_ < 0.125 * before;
    }
  }

 private:
  bool fill_square() {
    for (std::size_t j = 0; j < n; ++j) {
      double largest = 0;
      for (std::size_t i = 0; i < n; ++i) {
        matrix[i * n + j] = edge(i, j);
        largest = std::max(largest, std::fabs(high_of(matrix[i * n + j])));
      }
      if (!is_moderate(largest)) return false;
      axis_scale[j] = kernel::detail::normalisation(largest).scale;
      for (std::size_t i = 0; i < n; ++i) matrix[i * n + j] = scaled(matrix[i * n + j], axis_scale[j]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      double largest = 0;
      for (std::size_t j = 0; j < n; ++j) largest = std::max(largest, std::fabs(high_of(matrix[i * n + j])));
      if (!is_moderate(largest)) return false;
      edge_scale[i] = kernel::detail::normalisation(largest).scale;
      for (std::size_t j = 0; j < n; ++j) matrix[i * n + j] = scaled(matrix[i * n + j], edge_scale[i]);
    }
    return true;
  }

  bool fill_gram() {
    kernel::Buffer<T, 0> edges(n * d);
    for (std::size_t i = 0; i < n; ++i) {
      double largest = 0;
      for (std::size_t j = 0; j < d; ++j) {
        edges[i * d + j] = edge(i, j);
        largest = std::max(largest, std::fabs(high_of(edges[i * d + j])));
      }
      if (!is_moderate(largest)) return false;
      edge_scale[i] = kernel::detail::normalisation(largest).scale;
      for (std::size_t j = 0; j < d; ++j) edges[i * d + j] = scaled(edges[i * d + j], edge_scale[i]);
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t m = 0; m <= i; ++m) {
        T dot = number(0);
        for (std::size_t j = 0; j < d; ++j) dot = dot + edges[i * d + j] * edges[m * d + j];
        matrix[i * n + m] = matrix[m * n + i] = dot;
      }
    return true;
  }

  /// So that squares of scales, and their products with what else is small or large here, are in range.
  static bool is_moderate(double x) { return x > 0x1p-150 && x < 0x1p150; }

  /// Sets the residual and the bounds.
  bool certify() {
    if constexpr (!is_double)
      if (residual_.size() < n * n) residual_.resize(n * n);
    const auto dn = static_cast<double>(n);
    Vector<double> sum_of_row(n);
    for (std::size_t i = 0; i < n; ++i) sum_of_row[i] = row_sum[i] = 0;
    double total_error = 0, largest_sum = 0;
    largest_defect_ = 0;
    for (std::size_t j = 0; j < n; ++j) {
      double column = 0, largest = 0;
      for (std::size_t m = 0; m < n; ++m) {
        const double magnitude = std::fabs(high_of(inverse[m * n + j]));
        column += magnitude;
        row_sum[m] += magnitude;
      }
      if (!(column < 1e40)) return false;
      for (std::size_t i = 0; i < n; ++i) {
        T sum = number(i == j ? 1 : 0);
        for (std::size_t m = 0; m < n; ++m) sum = sum - matrix[i * n + m] * inverse[m * n + j];
        const double entry = high_of(sum);
        if constexpr (!is_double) residual_[i * n + j] = entry;
        largest = std::max(largest, std::fabs(entry));
        sum_of_row[i] += std::fabs(entry);
      }
      const double error = 1.05 * epsilon * (dn + 1 + input_error) * (1 + largest_entry * column) + 1e-275;
      total_error += error;
      defect[j] = 1.01 * (largest + error);
      largest_defect_ = std::max(largest_defect_, defect[j]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      row_sum[i] *= 1.01;
      largest_sum = std::max(largest_sum, sum_of_row[i]);
    }
    return 1.01 * (largest_sum + total_error) <= 0.5;  // nothing here is NaN
  }

  const double* const* points_;
  std::conditional_t<is_double, char, kernel::Buffer<double, 0>> residual_{};
  double largest_defect_ = 0;
};

}  // namespace delone::internal
