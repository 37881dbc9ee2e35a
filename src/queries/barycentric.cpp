// SPDX-License-Identifier: BSD-3-Clause
// The barycentric coordinates y of q solve A·y = b with columns p_j − p_0, b = q − p_0 and one row per axis;
// that of p_0 is 1 minus their sum. The method is that of the centers of spheres (voronoi/cell_center.cpp)
// without the second step: R is an approximate inverse, α ≥ ‖I − R·A‖∞ (linear_bound.hpp), y⁰ = R·b rounded,
// ρ = b − A·y⁰. Since A⁻¹ρ = R·ρ + (I − R·A)·A⁻¹ρ,
//
//     ‖y − y⁰‖∞ ≤ ζ = max_j Σ_i |R_ji|·(|ρ̃_i| + e_i) / (1 − α),   e_i = (n+3)u·(|b_i| + Σ_j |a_ij|·|y⁰_j|):
//
// each product in ρ̃ carries the rounding of an entry of A or b, its own, and that of n sums. The factor 1.01
// covers second-order terms and the rounding of the bounds. Rows are scaled by powers of two, which is exact,
// so nothing overflows, and underflow stays far below the absolute term 10⁻²⁸⁰.
#include "queries/barycentric.hpp"

#include "kernel/fractions.hpp"
#include "kernel/grid.hpp"
#include "kernel/linear_bound.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace delone::internal {
namespace {

/// The exponent of a power of two that scales all numbers of an axis to at most 1/4.
int scale_exponent(double largest) {
  int exponent = 0;
  std::frexp(largest, &exponent);
  return -exponent - 2;
}

using Points = std::span<const double* const>;

/// All k+1 coordinates, none off by more than `error`. Returns false if that cannot be certified.
bool find_certified(Points points, std::span<const int> axes, const double* q, double error,
                    std::vector<double>& weights) {
  const std::size_t n = axes.size();
  std::vector<double> a(n * n), b(n), inverse(n * n), work;
  for (std::size_t r = 0; r < n; ++r) {
    const auto axis = static_cast<std::size_t>(axes[r]);
    double largest = std::fabs(q[axis]);
    for (const double* p : points) largest = std::max(largest, std::fabs(p[axis]));
    const int exponent = scale_exponent(largest);
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
    if (!is_exact) return false;
    const int row_exponent = scale_exponent(row_largest);
    for (std::size_t j = 0; j < n; ++j) a[r * n + j] = std::ldexp(a[r * n + j], row_exponent);
    b[r] = std::ldexp(b[r], row_exponent);
  }
  work = a;
  if (!kernel::approximate_inverse<0>(work.data(), inverse.data(), n)) return false;
  const double alpha = kernel::inverse_defect<0>(a.data(), inverse.data(), n);
  if (!(alpha < 0.5)) return false;
  weights.assign(n + 1, 0.0);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      weights[j + 1] += inverse[j * n + i] * b[i];
      if (!(std::fabs(inverse[j * n + i]) < 1e8)) return false;
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
    residual[i] = std::fabs(sum) + 1.01 * static_cast<double>(n + 3) * kernel::unit_roundoff * parts;
  }
  for (std::size_t j = 0; j < n; ++j) {
    double sum = 1e-280;
    for (std::size_t i = 0; i < n; ++i) sum += std::fabs(inverse[j * n + i]) * residual[i];
    zeta = std::max(zeta, sum);
    if (!(sum < 1)) return false;
  }
  zeta *= 1.01 / (1 - alpha);
  weights[0] = 1;
  for (std::size_t j = 1; j <= n; ++j) weights[0] -= weights[j];
  // Coordinates are at most 1 + ζ, so the n roundings of that difference are at most n·(n+2)·u together.
  const auto size = static_cast<double>(n);
  return size * zeta + 2 * size * (size + 2) * kernel::unit_roundoff <= error;
}

/// The coordinates rounded to the nearest doubles.
void find_exactly(Points points, std::span<const int> axes, const double* q, std::vector<double>& weights) {
  const std::size_t n = axes.size();
  std::vector<kernel::Integer> system;
  for (const int j : axes) {
    const auto axis = static_cast<std::size_t>(j);
    int grid = kernel::trailing_exponent(q[axis]);
    for (const double* p : points) grid = std::min(grid, kernel::trailing_exponent(p[axis]));
    const kernel::Integer base = kernel::scaled_integer(points[0][axis], grid);
    for (std::size_t i = 1; i <= n; ++i)
      system.push_back(kernel::scaled_integer(points[i][axis], grid) - base);
    system.push_back(kernel::scaled_integer(q[axis], grid) - base);
  }
  const kernel::Fractions y = kernel::solve_exactly(std::move(system), n);
  kernel::Integer first = n == 0 ? kernel::Integer(1) : y.denominator;
  for (const kernel::Integer& numerator : y.numerators) first -= numerator;
  weights.assign(1, kernel::nearest_double(first, n == 0 ? kernel::Integer(1) : y.denominator, 0));
  for (const kernel::Integer& numerator : y.numerators)
    weights.push_back(kernel::nearest_double(numerator, y.denominator, 0));
}

}  // namespace

void barycentric(Points points, std::span<const unsigned char> on_face, std::span<const int> axes,
                 const double* q, std::vector<double>& weights) {
  // If no coordinate is off by more than ε, the sum of all n+1 is off by at most (n+1)·ε, and their quotients
  // by the sum are off by less than (n+3)·ε.
  const double error = largest_weight_error / static_cast<double>(axes.size() + 3);
  if (!find_certified(points, axes, q, error, weights)) find_exactly(points, axes, q, weights);
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] = on_face[i] == 0 || !(weights[i] > 0) ? 0 : weights[i];
    sum += weights[i];
  }
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (on_face[i] != 0) weights[i] = std::max(weights[i] / sum, std::numeric_limits<double>::min());
}

/// With the differences E (k×d) of the points and F (k×columns) of the values, the gradients G (d×columns)
/// satisfy E·G = F and are combinations of the rows of E. Modified Gram–Schmidt, two passes, replaces the
/// rows of E by orthonormal ones and transforms F along with them; then G = Eᵀ·F.
void gradients(std::span<const double* const> points, std::span<const double> values, int columns,
               int dimension, std::vector<double>& result) {
  const std::size_t k = points.size() - 1, d = static_cast<std::size_t>(dimension),
                    m = static_cast<std::size_t>(columns);
  result.assign(m * d, 0.0);
  double largest = 0;
  for (const double* p : points)
    for (std::size_t j = 0; j < d; ++j) largest = std::max(largest, std::fabs(p[j]));
  const int exponent = scale_exponent(largest);
  std::vector<double> edges(k * d), differences(k * m);
  for (std::size_t i = 0; i < k; ++i) {
    double longest = 0;
    for (std::size_t j = 0; j < d; ++j) {
      edges[i * d + j] = std::ldexp(points[i + 1][j], exponent) - std::ldexp(points[0][j], exponent);
      longest = std::max(longest, std::fabs(edges[i * d + j]));
    }
    for (std::size_t j = 0; j < d; ++j) edges[i * d + j] /= longest;
    for (std::size_t c = 0; c < m; ++c)
      differences[i * m + c] = (values[(i + 1) * m + c] - values[c]) / longest;
  }
  for (std::size_t i = 0; i < k; ++i) {
    double* const edge = edges.data() + i * d;
    const auto dot = [&](const double* other) {
      double sum = 0;
      for (std::size_t j = 0; j < d; ++j) sum += edge[j] * other[j];
      return sum;
    };
    for (int round = 0; round < 2; ++round)
      for (std::size_t before = 0; before < i; ++before) {
        const double along = dot(edges.data() + before * d);
        for (std::size_t j = 0; j < d; ++j) edge[j] -= along * edges[before * d + j];
        for (std::size_t c = 0; c < m; ++c) differences[i * m + c] -= along * differences[before * m + c];
      }
    const double length = std::sqrt(dot(edge));
    for (std::size_t j = 0; j < d; ++j) edge[j] /= length;
    for (std::size_t c = 0; c < m; ++c) {
      differences[i * m + c] /= length;
      for (std::size_t j = 0; j < d; ++j) result[c * d + j] += differences[i * m + c] * edge[j];
    }
  }
  for (double& g : result) g = std::ldexp(g, exponent);
}

}  // namespace delone::internal
