// SPDX-License-Identifier: BSD-3-Clause
// Certified path. Rows are scaled by powers of two to A·x = b. R is an approximate inverse of A, α ≥ ‖I −
// R·A‖∞ (linear_bound.hpp), x⁰ = R·b rounded, ρ = b − A·x⁰, ρ̃ its value in pairs of doubles, e_i ≥ |ρ_i −
// ρ̃_i|, x¹ = R·ρ̃ rounded. As for centers of spheres (voronoi/cell_center.cpp), with t_j = Σ_i |R_ji|·(e_i +
// (n+2)u·|ρ̃_i|) and ζ = max_j(|x¹_j| + t_j)/(1 − α),
//
//     |x_j − x⁰_j − x¹_j| ≤ α·ζ + t_j.
//
// Residual. The products and sums of ρ̃_i leave 2n low parts, which are exact and at most (n + 1)·u·M
// together, where M = Σ_j |a_ij·x⁰_j| + |b_i|. Summing them errs by at most 2n·u times that, and two more
// roundings follow: e_i = 2u·|ρ̃_i| + 2(n + 1)²·u²·M. If all low parts are zero, the residual is exact; if
// all residuals are then zero, x⁰ is the solution. This settles coordinates that are zero or have few digits.
// All entries are zero or so moderate that nothing underflows.
//
// Rounding (Ziv 1991, doi:10.1145/114697.116813): if both ends of the interval that contains x_j round to one
// double, that double is the result.
#include "halfspaces/halfspace_vertex.hpp"

#include "base/compiled_dimension.hpp"
#include "halfspaces/halfspace_dual.hpp"
#include "halfspaces/meeting_point_kernel.hpp"
#include "kernel/buffer.hpp"
#include "kernel/double_double.hpp"
#include "kernel/linear_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delone::internal {
namespace {

constexpr double u = kernel::unit_roundoff;

bool is_moderate(double x) { return x == 0 || (std::abs(x) >= 0x1p-200 && std::abs(x) <= 0x1p200); }

/// Of N equations; their number is chosen at run time if N is 0.
template <int N>
struct System {
  explicit System(std::size_t size) : n(size), a(size * size), b(size), residual(size), error(size) {}

  /// Computes the residual of x with its error bounds. Returns whether it is certainly zero.
  bool evaluate(const kernel::Buffer<double, N>& x) {
    bool all_zero = true;
    for (std::size_t i = 0; i < n; ++i) {
      double sum = b[i], rest = 0, magnitude = std::abs(b[i]), lost = 0;
      for (std::size_t j = 0; j < n; ++j) {
        const kernel::DoubleDouble product = kernel::two_product(-a[i * n + j], x[j]);
        const kernel::DoubleDouble next = kernel::two_sum(sum, product.high);
        sum = next.high;
        rest += next.low + product.low;
        lost += std::abs(next.low) + std::abs(product.low);
        magnitude += std::abs(product.high);
      }
      const double terms = static_cast<double>(n) + 1;
      residual[i] = sum + rest;
      error[i] = lost == 0 ? 0 : 1.01 * u * (2 * std::abs(residual[i]) + 2 * terms * terms * u * magnitude);
      all_zero = all_zero && lost == 0 && sum == 0;
    }
    return all_zero;
  }

  std::size_t n;
  kernel::Buffer<double, N * N> a;
  kernel::Buffer<double, N> b, residual, error;  // the last two are set by evaluate()
};

template <int N>
bool find_certified(std::span<const double* const> rows, std::span<const int> columns, double* result) {
  const std::size_t n = N > 0 ? static_cast<std::size_t>(N) : rows.size();
  System<N> system(n);
  for (std::size_t i = 0; i < n; ++i) {
    double largest = 0;
    for (std::size_t j = 0; j < n; ++j) largest = std::max(largest, std::abs(rows[i][columns[j]]));
    if (!(largest > 0x1p-1000)) return false;
    const double scale = std::ldexp(1.0, -std::ilogb(largest) - 1);
    for (std::size_t j = 0; j <= n; ++j) {
      const double entry = rows[i][columns[j]], scaled = entry * scale;
      if (!is_moderate(scaled) || (scaled == 0) != (entry == 0)) return false;
      (j < n ? system.a[i * n + j] : system.b[i]) = j < n ? scaled : -scaled;
    }
  }
  kernel::Buffer<double, N*N> work = system.a, inverse(n * n);
  kernel::Buffer<double, N> x(n), correction(n), tail(n), improved(n);
  if (!kernel::approximate_inverse<N>(work.data(), inverse.data(), n)) return false;
  const double alpha = kernel::inverse_defect<N>(system.a.data(), inverse.data(), n);
  if (!(alpha < 0.5)) return false;
  for (std::size_t j = 0; j < n; ++j) {
    x[j] = 0;
    for (std::size_t i = 0; i < n; ++i) x[j] += inverse[j * n + i] * system.b[i];
    if (!(std::abs(x[j]) <= 0x1p200)) return false;
    if (!is_moderate(x[j])) x[j] = 0;
  }
  if (!system.evaluate(x)) {
    double zeta = 0;
    for (std::size_t j = 0; j < n; ++j) {
      correction[j] = tail[j] = 0;
      for (std::size_t i = 0; i < n; ++i) {
        correction[j] += inverse[j * n + i] * system.residual[i];
        tail[j] += std::abs(inverse[j * n + i]) *
                   (system.error[i] + static_cast<double>(n + 2) * u * std::abs(system.residual[i]));
      }
      tail[j] = 1.01 * tail[j] + 1e-300;  // of products that underflow
      zeta = std::max(zeta, std::abs(correction[j]) + tail[j]);
    }
    zeta *= 1.01 / (1 - alpha);
    bool settled = true;
    for (std::size_t j = 0; j < n; ++j) {
      const kernel::DoubleDouble sum = kernel::two_sum(x[j], correction[j]);
      const double radius = 1.01 * (alpha * zeta + tail[j]) + 4 * u * std::abs(sum.low);
      const double below = sum.high + (sum.low - radius), above = sum.high + (sum.low + radius);
      settled = settled && below == above;
      improved[j] = std::abs(sum.high) <= radius ? 0 : sum.high;
      if (!is_moderate(improved[j])) return false;
    }
    if (!settled && !system.evaluate(improved)) return false;
    x = improved;
  }
  for (std::size_t j = 0; j < n; ++j) result[j] = x[j] + 0.0;  // never −0
  return true;
}

void find_exactly(std::span<const double* const> rows, std::span<const int> columns, double* result) {
  const std::size_t n = rows.size();
  std::vector<kernel::Integer> system;
  std::vector<double> entries(n + 1);
  for (const double* row : rows) {
    for (std::size_t j = 0; j <= n; ++j) entries[j] = row[columns[j]];
    for (kernel::Integer& x : integer_row(entries.data(), n + 1)) system.push_back(std::move(x));
    system.back() = -system.back();
  }
  const kernel::Fractions x = kernel::solve_exactly(std::move(system), n);
  for (std::size_t j = 0; j < n; ++j) result[j] = kernel::nearest_double(x.numerators[j], x.denominator, 0);
}

}  // namespace

void meeting_point(std::span<const double* const> rows, std::span<const int> columns, double* x) {
  const bool is_certain = with_compiled_dimension<1, most_meeting_lanes>(
      rows.size(), [&](auto n) { return find_certified<n()>(rows, columns, x); });
  if (!is_certain) find_exactly(rows, columns, x);
}

std::vector<double> meeting_points(std::span<const double* const> rows, std::span<const int> columns) {
  const std::size_t n = columns.size() - 1, count = rows.size() / n;
  std::vector<double> points(count * n);
  const auto find = [&](std::size_t p) {
    meeting_point(rows.subspan(p * n, n), columns, points.data() + p * n);
  };
  std::size_t next = 0;
  if (n >= least_meeting_lanes && n <= most_meeting_lanes) {
    std::vector<double> entries(n * (n + 1) * meeting_block), found(n * meeting_block),
        settled(meeting_block);
    for (; next + meeting_block <= count; next += meeting_block) {
      for (std::size_t lane = 0; lane < meeting_block; ++lane)
        for (std::size_t i = 0; i < n; ++i) {
          const double* const row = rows[(next + lane) * n + i];
          for (std::size_t j = 0; j <= n; ++j)
            entries[(i * (n + 1) + j) * meeting_block + lane] = row[columns[j]];
        }
      find_meeting_points_in_lanes(n, entries.data(), found.data(), settled.data());
      for (std::size_t lane = 0; lane < meeting_block; ++lane) {
        if (settled[lane] == 0) {
          find(next + lane);
          continue;
        }
        for (std::size_t j = 0; j < n; ++j) points[(next + lane) * n + j] = found[j * meeting_block + lane];
      }
    }
  }
  for (; next < count; ++next) find(next);
  return points;
}

std::vector<kernel::Integer> cone_normal(std::span<const double* const> rows, std::span<const int> columns) {
  const std::size_t k = rows.size();
  std::vector<std::vector<kernel::Integer>> integers;
  std::vector<double> entries(k + 1);
  for (const double* row : rows) {
    for (std::size_t j = 0; j <= k; ++j) entries[j] = row[columns[j]];
    integers.push_back(integer_row(entries.data(), k + 1));
  }
  std::vector<kernel::Integer> normal;
  for (std::size_t j = 0; j <= k; ++j) {
    std::vector<kernel::Integer> minor;
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t c = 0; c <= k; ++c)
        if (c != j) minor.push_back(integers[i][c]);
    const kernel::Integer det = kernel::exact_determinant(std::move(minor), k);
    normal.push_back((k + j) % 2 == 0 ? det : kernel::Integer(-det));
  }
  return normal;
}

std::vector<double> unit_vector(std::span<const kernel::Integer> entries, std::span<const int> axes,
                                std::size_t d) {
  kernel::Integer largest = 0;
  for (const kernel::Integer& x : entries)
    largest = std::max(largest, kernel::Integer(boost::multiprecision::abs(x)));
  std::vector<double> vector(d, 0.0);
  double square = 0;
  for (std::size_t j = 0; j < axes.size(); ++j) {
    double& x = vector[static_cast<std::size_t>(axes[j])];
    x = kernel::nearest_double(entries[j], largest, 0);
    square += x * x;
  }
  for (double& x : vector) x = x / std::sqrt(square) + 0.0;
  return vector;
}

std::vector<double> lineality_basis(std::span<const double* const> rows, std::span<const int> axes,
                                    std::size_t d) {
  const std::size_t k = rows.size();
  std::vector<double> basis;
  for (int free = 0; free < static_cast<int>(d); ++free) {
    if (std::binary_search(axes.begin(), axes.end(), free)) continue;
    std::vector<kernel::Integer> system;
    std::vector<double> entries(k + 1);
    std::vector<int> columns(axes.begin(), axes.end());
    columns.push_back(free);
    for (const double* row : rows) {
      for (std::size_t j = 0; j <= k; ++j) entries[j] = row[columns[j]];
      for (kernel::Integer& x : integer_row(entries.data(), k + 1)) system.push_back(std::move(x));
    }
    // The solution of the system is the negative of the coordinates on the axes.
    std::vector<kernel::Integer> direction;
    kernel::Integer denominator = 1;
    if (k > 0) {
      kernel::Fractions solution = kernel::solve_exactly(std::move(system), k);
      for (kernel::Integer& x : solution.numerators) direction.push_back(-x);
      denominator = solution.denominator;
    }
    direction.push_back(denominator);
    const std::vector<double> vector = unit_vector(direction, columns, d);
    basis.insert(basis.end(), vector.begin(), vector.end());
  }
  return basis;
}

}  // namespace delone::internal
