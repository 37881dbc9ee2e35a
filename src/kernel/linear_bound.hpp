// SPDX-License-Identifier: BSD-3-Clause
// The approximate inverse of a small matrix in binary64 and a bound on its defect, which certifies the
// solutions of linear systems. Rump, "Verification methods", Acta Numerica 19 (2010), section 10,
// doi:10.1017/S096249291000005X.
#pragma once

#include "kernel/determinant.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace delone::kernel {

/// An approximate inverse of the n×n matrix a (row-major), n = N, or chosen at run time when N is 0: by
/// cofactors for N = 2, 3, otherwise by Gauss–Jordan elimination with row exchanges. a is overwritten. False
/// if the matrix was found to be singular; entries may be infinite or NaN, which no bound below accepts.
template <int N>
bool approximate_inverse(double* a, double* inverse, std::size_t size) {
  const std::size_t n = N > 0 ? static_cast<std::size_t>(N) : size;
  if constexpr (N == 2) {
    const double scale = 1 / (a[0] * a[3] - a[1] * a[2]);
    inverse[0] = a[3] * scale;
    inverse[1] = -a[1] * scale;
    inverse[2] = -a[2] * scale;
    inverse[3] = a[0] * scale;
    return true;
  }
  if constexpr (N == 3) {
    const double c0 = a[4] * a[8] - a[5] * a[7], c1 = a[5] * a[6] - a[3] * a[8],
                 c2 = a[3] * a[7] - a[4] * a[6];
    const double scale = 1 / (a[0] * c0 + a[1] * c1 + a[2] * c2);
    inverse[0] = c0 * scale;
    inverse[1] = (a[2] * a[7] - a[1] * a[8]) * scale;
    inverse[2] = (a[1] * a[5] - a[2] * a[4]) * scale;
    inverse[3] = c1 * scale;
    inverse[4] = (a[0] * a[8] - a[2] * a[6]) * scale;
    inverse[5] = (a[2] * a[3] - a[0] * a[5]) * scale;
    inverse[6] = c2 * scale;
    inverse[7] = (a[1] * a[6] - a[0] * a[7]) * scale;
    inverse[8] = (a[0] * a[4] - a[1] * a[3]) * scale;
    return true;
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) inverse[i * n + j] = i == j ? 1.0 : 0.0;
  for (std::size_t s = 0; s < n; ++s) {
    std::size_t pivot = s;
    for (std::size_t r = s + 1; r < n; ++r)
      if (std::abs(a[r * n + s]) > std::abs(a[pivot * n + s])) pivot = r;
    if (!(std::abs(a[pivot * n + s]) > 0)) return false;
    if (pivot != s)
      for (std::size_t c = 0; c < n; ++c) {
        std::swap(a[pivot * n + c], a[s * n + c]);
        std::swap(inverse[pivot * n + c], inverse[s * n + c]);
      }
    const double scale = 1 / a[s * n + s];
    for (std::size_t c = 0; c < n; ++c) {
      a[s * n + c] *= scale;
      inverse[s * n + c] *= scale;
    }
    for (std::size_t r = 0; r < n; ++r) {
      if (r == s) continue;
      const double factor = a[r * n + s];
      for (std::size_t c = 0; c < n; ++c) {
        a[r * n + c] -= factor * a[s * n + c];
        inverse[r * n + c] -= factor * inverse[s * n + c];
      }
    }
  }
  return true;
}

/// An upper bound on the largest row sum of |I − inverse·A|, for every A whose entries differ from a's by at
/// most a relative unit_roundoff. Infinity or NaN if anything overflowed.
///
/// Entry (i, j) is computed with n products and n additions, so its error is at most γ_(n+1)·(δ_ij +
/// Σ|inverse_im|·|a_mj|); A instead of a adds unit_roundoff·Σ|inverse_im|·|a_mj|. One more n and the factor
/// 1.01 cover the rounding of the sums of absolute values, 10⁻²⁹⁰ underflows (of entries of a below 1 in
/// magnitude times entries of the inverse below 10⁸).
template <int N>
double inverse_defect(const double* a, const double* inverse, std::size_t size) {
  const std::size_t n = N > 0 ? static_cast<std::size_t>(N) : size;
  const double relative = 1.01 * static_cast<double>(2 * n + 4) * unit_roundoff;
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double row = 1e-290, magnitudes = 1;
    for (std::size_t j = 0; j < n; ++j) {
      double entry = i == j ? 1.0 : 0.0;
      for (std::size_t m = 0; m < n; ++m) {
        const double product = inverse[i * n + m] * a[m * n + j];
        entry -= product;
        magnitudes += std::abs(product);
      }
      row += std::abs(entry);
    }
    row += relative * magnitudes;
    if (!(row <= largest)) largest = row;  // NaN stays
    if (!(largest < 1)) return std::numeric_limits<double>::infinity();
  }
  return largest;
}

}  // namespace delone::kernel
