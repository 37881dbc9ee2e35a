// SPDX-License-Identifier: BSD-3-Clause
// Determinants in binary64 by elimination, with a certified bound on the error.
//
// The bound (docs/predicates.md, "The determinant by elimination"): columns are points, rows are coordinates.
// Elimination with row pivoting gives L·U = A + E with |L| ≤ 1 entrywise, and |E_j| ≤ γ_n·‖U_j‖₁ in every
// entry of column j (Higham, Accuracy and Stability of Numerical Algorithms, 2002, Theorem 9.3). The
// determinant is linear in each column, so by Hadamard's inequality replacing every column A_j by A_j + E_j
// changes it by at most Π(‖A_j‖ + ‖E_j‖) − Π‖A_j‖. Errors that A already has (rounded differences of
// coordinates) are added to E_j.
#pragma once

#include "kernel/buffer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace delone::kernel {

inline constexpr double unit_roundoff = 0x1p-53;
/// Covers the rounding in the evaluation of a bound: a few hundred operations on non-negative numbers.
inline constexpr double bound_slack = 1.0 + 0x1p-40;
/// Absolute errors by underflow stay below this when entries are at most a few units (docs/predicates.md,
/// "Underflow").
inline constexpr double underflow_allowance = 1e-300;

/// A determinant, a bound on |value − exact| (infinity: nothing is known), and the terms of the bound.
struct CertifiedDeterminant {
  double value = 0;
  double error = std::numeric_limits<double>::infinity();
  double norm_product = 0;      ///< Π ‖A_j‖₂
  double inverse_norm_sum = 0;  ///< Σ 1/‖A_j‖₂
  bool sign_is_certain() const { return std::fabs(value) > error; }
};

/// Bounds how far a matrix is from the true one: column j by relative·‖A_j‖ + absolute in the 2-norm.
struct EntryError {
  double relative = 0;
  double absolute = 0;
};

/// Factors n columns of `rows` ≥ n entries in place, column j at columns + j·rows, with row pivoting: U on
/// and above the diagonal, L (unit diagonal, entries at most 1 in magnitude) below; `row_of[s]` is the row
/// exchanged with row s at step s. The determinant is that of the n rows chosen as pivots, times the sign of
/// the permutation of all rows. REQUIRES entries of at most a few units in magnitude (the caller scales); NaN
/// and infinities give an infinite bound. A pivot that is exactly zero gives the value 0 and stops the
/// factorisation.
template <int N>
CertifiedDeterminant factor(double* columns, int run_time_n, int rows, EntryError entry_error, int* row_of) {
  const int n = N > 0 ? N : run_time_n;
  const auto column = [&](int j) { return columns + static_cast<std::ptrdiff_t>(j) * rows; };

  Buffer<double, N> norm(static_cast<std::size_t>(n));
  CertifiedDeterminant det;
  det.norm_product = 1;
  for (int j = 0; j < n; ++j) {
    const double* a = column(j);
    double square = 0;
    for (int r = 0; r < rows; ++r) square += a[r] * a[r];
    const double length = std::sqrt(square);
    norm[static_cast<std::size_t>(j)] = length;
    det.norm_product *= length;
    det.inverse_norm_sum += 1 / length;
  }
  if (!(det.norm_product > 1e-240 && det.norm_product < 1e240)) return det;

  const double gamma = 1.01 * n * unit_roundoff * std::sqrt(static_cast<double>(n));  // ≥ γ_n·√n
  double value = 1;
  // Σ_j ‖E_j‖/‖A_j‖
  double relative_sum = n * entry_error.relative + entry_error.absolute * det.inverse_norm_sum;
  for (int s = 0; s < n; ++s) {
    double* p = column(s);
    int pivot_row = s;
    for (int r = s + 1; r < rows; ++r)
      if (std::fabs(p[r]) > std::fabs(p[pivot_row])) pivot_row = r;
    row_of[s] = pivot_row;
    if (pivot_row != s) {
      value = -value;
      for (int j = 0; j < n; ++j) std::swap(column(j)[s], column(j)[pivot_row]);
    }
    value *= p[s];
    double u_norm = 0;  // ‖U_s‖₁
    for (int r = 0; r <= s; ++r) u_norm += std::fabs(p[r]);
    relative_sum += (gamma * u_norm + underflow_allowance) / norm[static_cast<std::size_t>(s)];
    // The first s + 1 columns of A + E are dependent, whatever the others are: those need no E_j.
    if (p[s] == 0) {
      value = 0;
      break;
    }
    for (int r = s + 1; r < rows; ++r) p[r] /= p[s];
    for (int j = s + 1; j < n; ++j) {
      double* a = column(j);
      const double u = a[s];
      for (int r = s + 1; r < rows; ++r) a[r] -= p[r] * u;
    }
  }
  det.value = value;
  // |det(A_true) − det(LU)| ≤ Π(‖A_j‖(1 + 2ρ_j)) − Π‖A_j‖ ≤ Π‖A_j‖·(exp(2·Σρ_j) − 1) ≤ Π‖A_j‖·2.3·Σρ_j if
  // Σρ_j ≤ 0.1.
  if (relative_sum <= 0.1)
    det.error =
        bound_slack * (det.norm_product * 2.3 * relative_sum + 1.01 * n * unit_roundoff * std::fabs(value));
  return det;
}

/// Solves A_jᵀ·x + height_j = 0, j = 0 … n−1, from the factors that factor() left: with all rows of A = L·U
/// in the order after the exchanges, Aᵀ·x = Uᵀ·(Lᵀ·x). `x` has `rows` entries, of which the last rows−n are
/// given in that order (the unknowns of the rows not chosen as pivots); on return x is in the order of the
/// original rows. `heights` is overwritten.
template <int N>
void solve_transposed(const double* columns, int run_time_n, int rows, const int* row_of, double* heights,
                      double* x) {
  const int n = N > 0 ? N : run_time_n;
  const auto column = [&](int j) { return columns + static_cast<std::ptrdiff_t>(j) * rows; };
  for (int s = 0; s < n; ++s) {  // Uᵀ·y = −heights
    const double* u = column(s);
    double y = -heights[s];
    for (int r = 0; r < s; ++r) y -= u[r] * heights[r];
    heights[s] = y / u[s];
  }
  for (int s = n - 1; s >= 0; --s) {  // Lᵀ·x = y
    const double* l = column(s);
    double y = heights[s];
    for (int r = s + 1; r < rows; ++r) y -= l[r] * x[r];
    x[s] = y;
  }
  for (int s = n - 1; s >= 0; --s) std::swap(x[s], x[row_of[s]]);
}

}  // namespace delone::kernel
