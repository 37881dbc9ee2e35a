// SPDX-License-Identifier: BSD-3-Clause
// Let v_i = p_i − q, with computed ṽ_i: |ṽ − v| ≤ u·|v| per coordinate. The weights w > 0 solve the normal
// equations of the edges of the simplex, up to rounding, which is small if it is not thin. But any positive
// weights give a point of the simplex, z = Σ w_i·p_i / Σ w_i. With d products and sums, and the error of ṽ,
// the computed coordinate j of Σ w_i·v_i is off by at most γ(d+1)·Σ w_i·|v_ij|, and by what underflows, which
// is far below the absolute term; the sum of the weights by γ(d), the norm by γ(d+2). The factors below cover
// second-order terms, and the rounding of the bound itself.
#include "hull/tolerance/simplex_projection.hpp"

#include "base/compiled_dimension.hpp"
#include "kernel/determinant.hpp"

#include <cmath>

namespace delone::hull {
namespace {

/// By how much the square of a height of the simplex may be less than that of the edge.
constexpr double least_square_share = 0x1p-10;

template <std::size_t D>
std::optional<double> project(const double* const* points, const double* q, double* normal) {
  constexpr std::size_t n = D - 1;
  double v[D][D], edges[n][D], system[n][n], weights[D];
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = 0; j < D; ++j) v[i][j] = points[i][j] - q[j];
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < D; ++j) edges[i][j] = v[i + 1][j] - v[0][j];
  for (std::size_t i = 0; i < n; ++i) {
    weights[i + 1] = 0;
    for (std::size_t j = 0; j < D; ++j) weights[i + 1] -= edges[i][j] * v[0][j];
    for (std::size_t c = 0; c < n; ++c) {
      system[i][c] = 0;
      for (std::size_t j = 0; j < D; ++j) system[i][c] += edges[i][j] * edges[c][j];
    }
  }
  for (std::size_t s = 0; s < n; ++s) {
    double square = 0;
    for (std::size_t j = 0; j < D; ++j) square += edges[s][j] * edges[s][j];
    if (!(system[s][s] > least_square_share * square)) return std::nullopt;
    for (std::size_t i = s + 1; i < n; ++i) {
      const double factor = system[i][s] / system[s][s];
      for (std::size_t c = s; c < n; ++c) system[i][c] -= factor * system[s][c];
      weights[i + 1] -= factor * weights[s + 1];
    }
  }
  weights[0] = 1;
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t c = i + 1; c < n; ++c) weights[i + 1] -= system[i][c] * weights[c + 1];
    weights[i + 1] /= system[i][i];
    weights[0] -= weights[i + 1];
  }
  double sum = 0, square = 0;
  for (const double w : weights) {
    if (!(w > 0)) return std::nullopt;
    sum += w;
  }
  constexpr double rounding = 1.01 * (D + 3) * kernel::unit_roundoff;
  for (std::size_t j = 0; j < D; ++j) {
    double value = 0, parts = 0;
    for (std::size_t i = 0; i < D; ++i) {
      value += weights[i] * v[i][j];
      parts += weights[i] * std::fabs(v[i][j]);
    }
    normal[j] = -value / sum;
    const double most = std::fabs(value) + (rounding * parts + 0x1p-1000);
    square += most * most;
  }
  const double distance = std::sqrt(square) / sum * (1 + (2 * D + 12) * kernel::unit_roundoff);
  if (!(distance > 0x1p-400 && distance < 0x1p400)) return std::nullopt;
  return distance;
}

}  // namespace

std::optional<double> project_into_simplex(std::span<const double* const> points, const double* q,
                                           double* normal) {
  return internal::with_compiled_dimension<2, int{most_projected}>(
      points.size(), [&](auto dimension) -> std::optional<double> {
        if constexpr (dimension() > 0) return project<dimension()>(points.data(), q, normal);
        return std::nullopt;
      });
}

}  // namespace delone::hull
