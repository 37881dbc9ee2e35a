// SPDX-License-Identifier: BSD-3-Clause
// The barycentric coordinates y of q solve A·y = b with columns p_j − p_0, b = q − p_0 and one row per axis;
// that of p_0 is 1 minus their sum. The method is that of docs/predicates.md, "Small linear systems",
// without the second step: R is an approximate inverse, α ≥ ‖I − R·A‖∞ (linear_bound.hpp), y⁰ = R·b rounded,
// ρ = b − A·y⁰. Since A⁻¹ρ = R·ρ + (I − R·A)·A⁻¹ρ,
//
//     ‖y − y⁰‖∞ ≤ ζ = max_j Σ_i |R_ji|·(|ρ̃_i| + e_i) / (1 − α),   e_i = (n+3)u·(|b_i| + Σ_j |a_ij|·|y⁰_j|):
//
// each product in ρ̃ carries the rounding of an entry of A or b, its own, and that of n sums. The factor 1.01
// covers second-order terms and the rounding of the bounds. Rows are scaled by powers of two, which is exact,
// so nothing overflows, and underflow stays far below the absolute term 10⁻²⁸⁰.
#include "kernel/barycentric.hpp"

#include "kernel/grid.hpp"
#include "kernel/linear_bound.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace delone::kernel {
namespace {

using Points = std::span<const double* const>;

}  // namespace

int exponent_to_a_quarter(double largest) {
  int exponent = 0;
  std::frexp(largest, &exponent);
  return -exponent - 2;
}

double certified_barycentric(Points points, std::span<const int> axes, const double* q,
                             std::vector<double>& weights) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const std::size_t n = axes.size();
  std::vector<double> a(n * n), b(n), inverse(n * n), work;
  for (std::size_t r = 0; r < n; ++r) {
    const auto axis = static_cast<std::size_t>(axes[r]);
    double largest = std::fabs(q[axis]);
    for (const double* p : points) largest = std::max(largest, std::fabs(p[axis]));
    const int exponent = exponent_to_a_quarter(largest);
    bool is_exact = true;
    const auto scaled = [&](double x) {
      const double y = std::ldexp(x, exponent);
      is_exact = is_exact && (x == 0 || std::fabs(y) >= 0x1p-900);
      return y;
    };
    const double base = scaled(points[0][axis]);
    double row_largest = 0;
    for (std::size_t j = 0; j < n; ++j) {
      a[r * n + j] = scaled(points[j + 1][axis]) - base;
      row_largest = std::max(row_largest, std::fabs(a[r * n + j]));
    }
    b[r] = scaled(q[axis]) - base;
    if (!is_exact) return none;
    const int row_exponent = exponent_to_a_quarter(row_largest);
    for (std::size_t j = 0; j < n; ++j) a[r * n + j] = std::ldexp(a[r * n + j], row_exponent);
    b[r] = std::ldexp(b[r], row_exponent);
  }
  work = a;
  if (!approximate_inverse<0>(work.data(), inverse.data(), n)) return none;
  const double alpha = inverse_defect<0>(a.data(), inverse.data(), n);
  if (!(alpha < 0.5)) return none;
  weights.assign(n + 1, 0.0);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      weights[j + 1] += inverse[j * n + i] * b[i];
      if (!(std::fabs(inverse[j * n + i]) < 1e8)) return none;
    }
  double zeta = 0;
  std::vector<double>& residual = work;
  for (std::size_t i = 0; i < n; ++i) {
    double sum = b[i], parts = std::fabs(b[i]);
    for (std::size_t j = 0; j < n; ++j) {
      const double product = a[i * n + j] * weights[j + 1];
      sum -= product;
      parts += std::fabs(product);
    }
    residual[i] = std::fabs(sum) + 1.01 * static_cast<double>(n + 3) * unit_roundoff * parts;
  }
  for (std::size_t j = 0; j < n; ++j) {
    double sum = 1e-280;
    for (std::size_t i = 0; i < n; ++i) sum += std::fabs(inverse[j * n + i]) * residual[i];
    zeta = std::max(zeta, sum);
    if (!(sum < 1)) return none;
  }
  zeta *= 1.01 / (1 - alpha);
  weights[0] = 1;
  for (std::size_t j = 1; j <= n; ++j) weights[0] -= weights[j];
  // Coordinates are at most 1 + ζ, so the n roundings of that difference are at most n·(n+2)·u together.
  const auto size = static_cast<double>(n);
  return size * zeta + 2 * size * (size + 2) * unit_roundoff;
}

Fractions exact_barycentric(Points points, std::span<const int> axes, const double* q) {
  const std::size_t n = axes.size();
  std::vector<Integer> system;
  for (const int j : axes) {
    const auto axis = static_cast<std::size_t>(j);
    int grid = trailing_exponent(q[axis]);
    for (const double* p : points) grid = std::min(grid, trailing_exponent(p[axis]));
    const Integer base = scaled_integer(points[0][axis], grid);
    for (std::size_t i = 1; i <= n; ++i) system.push_back(scaled_integer(points[i][axis], grid) - base);
    system.push_back(scaled_integer(q[axis], grid) - base);
  }
  Fractions result = solve_exactly(std::move(system), n);
  if (n == 0) result.denominator = 1;
  Integer first = result.denominator;
  for (const Integer& numerator : result.numerators) first -= numerator;
  result.numerators.insert(result.numerators.begin(), std::move(first));
  return result;
}

}  // namespace delone::kernel
