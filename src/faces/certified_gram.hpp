// SPDX-License-Identifier: BSD-3-Clause
// The Gram matrix of the edges of a simplex from its first vertex, and an approximate inverse with a
// certified bound; step 1 of the proof in faces/orthosphere.cpp.
#pragma once

#include "kernel/buffer.hpp"
#include "kernel/double_double.hpp"
#include "kernel/linear_bound.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace delone::internal {

/// N edges in D dimensions; 0: chosen at run time.
template <int N, int D>
struct CertifiedGram {
  const std::size_t n, d;
  kernel::Buffer<double, N * D> high, low;  ///< n×d: the edges, exactly high + low
  kernel::Buffer<double, N * N> gram;       ///< n×n: products of `high`, rounded
  double largest = 0;                       ///< the largest |high|
  // After invert():
  kernel::Buffer<double, N * N> inverse;
  double norm = 0;    ///< of the inverse: the largest row sum of magnitudes
  double square = 0;  ///< the largest squared length of an edge
  double alpha = 0;   ///< at least the norm of I − inverse·G, for the exact Gram matrix G

  CertifiedGram(const double* const* points, std::size_t corners, std::size_t dimension)
      : n(N > 0 ? static_cast<std::size_t>(N) : corners - 1),
        d(D > 0 ? static_cast<std::size_t>(D) : dimension),
        high(n * d),
        low(n * d),
        gram(n * n),
        inverse(n * n) {
    const double* const origin = points[0];
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < d; ++j) {
        const kernel::DoubleDouble edge = kernel::two_sum(points[i + 1][j], -origin[j]);
        high[i * d + j] = edge.high;
        low[i * d + j] = edge.low;
        largest = std::max(largest, std::fabs(edge.high));
      }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t m = 0; m <= i; ++m) {
        double dot = 0;
        for (std::size_t j = 0; j < d; ++j) dot += high[i * d + j] * high[m * d + j];
        gram[i * n + m] = gram[m * n + i] = dot;
      }
  }

  /// False unless alpha ≤ 1/2.
  bool invert() {
    if (!(largest > 0x1p-150 && largest < 0x1p150)) return false;
    constexpr double u = kernel::unit_roundoff;
    kernel::Buffer<double, N * N> work(n * n);
    for (std::size_t i = 0; i < n * n; ++i) work[i] = gram[i];
    for (std::size_t i = 0; i < n; ++i) square = std::max(square, gram[i * n + i]);
    if constexpr (N == 1) {
      inverse[0] = 1 / gram[0];
    } else {
      if (!kernel::approximate_inverse<N>(work.data(), inverse.data(), n)) return false;
    }
    double defect = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double row = 0, rest = 0;
      for (std::size_t j = 0; j < n; ++j) {
        row += std::fabs(inverse[i * n + j]);
        double entry = i == j ? 1 : 0;
        for (std::size_t m = 0; m < n; ++m) entry -= inverse[i * n + m] * gram[m * n + j];
        rest += std::fabs(entry);
      }
      norm = std::max(norm, row);
      if (!(rest <= defect)) defect = rest;  // NaN stays
    }
    const auto dn = static_cast<double>(n), dd = static_cast<double>(d);
    alpha = defect + 1.1 * dn * (dn + dd + 6) * u * (1 + norm * square);
    return alpha <= 0.5;
  }
};

}  // namespace delone::internal
