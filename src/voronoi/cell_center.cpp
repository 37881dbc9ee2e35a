// SPDX-License-Identifier: BSD-3-Clause
// With a_i = p_i − p_0 and z = 2(c − p_0), the center solves Σ_j a_ij·z_j = Σ_j a_ij² − (w_i − w_0), i = 1 …
// n.
//
// Certified path. R is an approximate inverse of A, α ≥ ‖I − R·A‖∞ (linear_bound.hpp), z⁰ = R·b rounded, ρ =
// b − A·z⁰, ρ̃ its value in pairs of doubles, z¹ = R·ρ̃ rounded. Then z = z⁰ + A⁻¹ρ and A⁻¹ρ − Rρ = (I −
// RA)·A⁻¹ρ. So with e_i ≥ |ρ_i − ρ̃_i| and t_j = Σ_i |R_ji|·(e_i + (n+2)u·|ρ̃_i|), which also covers the
// rounding of R·ρ̃,
//
//     ‖A⁻¹ρ‖∞ ≤ ζ = max_j(|z¹_j| + t_j)/(1 − α),      |z_j − z⁰_j − z¹_j| ≤ α·ζ + t_j.
//
// Residual. a_ij = h + l exactly (the difference of two doubles, |l| ≤ u|h|) and h − z⁰_j = t + r exactly, so
// each term a·(a − z⁰) is h·t (a pair by TwoProduct) + h·(r + l) + l·t + l·(r + l). The last product is
// dropped; all other low parts go into one sum. With M = Σ_j |h|(|h| + |z⁰_j|) + |w_i − w_0|, the low parts
// are at most (n + 6)·u·M together, they meet 4n + 5 additions and roundings, and products dropped or rounded
// are below 8u²M. So e_i = u·|ρ̃_i| + 5(n+3)²·u²·M, because (4n+5)(n+6) + 8 ≤ 5(n+3)². The factor 1.01 covers
// higher orders and the rounding of the bounds.
//
// Scale. A is divided by a power of two such that its largest entry is in [1/2, 1), the right-hand sides by
// its square. The absolute term 10⁻²⁸⁰ covers results below 10⁻²⁹⁰ that underflowed, as |z⁰| and the entries
// of R are below 10⁸; otherwise the path gives up.
//
// Rounding (Ziv 1991, doi:10.1145/114697.116813): if both ends of the interval that contains c_j round to one
// double, that double is the result.
#include "voronoi/cell_center.hpp"

#include "base/compiled_dimension.hpp"
#include "kernel/buffer.hpp"
#include "kernel/double_double.hpp"
#include "kernel/fractions.hpp"
#include "kernel/grid.hpp"
#include "kernel/linear_bound.hpp"
#include "voronoi/roundoff.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delone::internal {
namespace {

using kernel::DoubleDouble;
using kernel::two_product;
using kernel::two_sum;

/// Points and weights as integers: differences from point 0 in units of 2^grid, differences of weights in
/// units of 2^(2·grid).
struct IntegerPoints {
  int grid = std::numeric_limits<int>::max();
  std::vector<kernel::Integer> edges;   // m×d, p_i − p_0
  std::vector<kernel::Integer> rights;  // m, |p_i − p_0|² − (w_i − w_0)

  IntegerPoints(const double* const* points, const double* weights, std::size_t count, std::size_t d) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < d; ++j) grid = std::min(grid, kernel::trailing_exponent(points[i][j]));
      if (weights != nullptr) grid = std::min(grid, kernel::square_exponent(weights[i]));
    }
    if (grid == std::numeric_limits<int>::max()) grid = 0;
    for (std::size_t i = 1; i < count; ++i) {
      kernel::Integer square = 0;
      for (std::size_t j = 0; j < d; ++j) {
        edges.push_back(kernel::scaled_integer(points[i][j], grid) -
                        kernel::scaled_integer(points[0][j], grid));
        square += edges.back() * edges.back();
      }
      if (weights != nullptr)
        square -= kernel::scaled_integer(weights[i], 2 * grid) - kernel::scaled_integer(weights[0], 2 * grid);
      rights.push_back(std::move(square));
    }
  }
};

/// 2(c − p_0) in units of 2^grid, in all d coordinates. In full dimension it solves the equations above. In a
/// flat it is a combination of the edges, whose coefficients y solve the Gram system E·Eᵀ·y = b.
kernel::Fractions twice_center(const IntegerPoints& p, std::size_t k, std::size_t d) {
  std::vector<kernel::Integer> system;
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t m = 0; m < k; ++m) {
      if (k == d) {
        system.push_back(p.edges[i * d + m]);
        continue;
      }
      kernel::Integer dot = 0;
      for (std::size_t j = 0; j < d; ++j) dot += p.edges[i * d + j] * p.edges[m * d + j];
      system.push_back(std::move(dot));
    }
    system.push_back(p.rights[i]);
  }
  kernel::Fractions solution = kernel::solve_exactly(std::move(system), k);
  if (k == d) return solution;
  std::vector<kernel::Integer> z(d, kernel::Integer(0));
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < d; ++j) z[j] += solution.numerators[i] * p.edges[i * d + j];
  return {std::move(z), std::move(solution.denominator)};
}

}  // namespace

CenterFinder::CenterFinder(int dimension, std::vector<int> axes, bool aligned)
    : dimension_(dimension), axes_(std::move(axes)) {
  if (!aligned) return;
  certified_ =
      with_compiled_dimension<1, 5>(axes_.size(), [](auto k) { return &CenterFinder::find_certified<k()>; });
  offset_certified_ = with_compiled_dimension<1, 5>(
      axes_.size(), [](auto k) { return &CenterFinder::find_offset_certified<k()>; });
}

void CenterFinder::find(const double* const* points, const double* weights, double* center) {
  if (certified_ != nullptr && (this->*certified_)(points, weights, center)) return;
  ++num_exact_;
  find_exactly(points, weights, center);
}

void CenterFinder::find_block(std::size_t count, const double* const* points, const double* weights,
                              double* centers) {
  const auto d = static_cast<std::size_t>(dimension_), k = axes_.size();
  if (certified_ == nullptr || k != d || k < least_center_lanes || k > most_center_lanes) {
    for (std::size_t cell = 0; cell < count; ++cell)
      find(points + cell * (k + 1), weights == nullptr ? nullptr : weights + cell * (k + 1),
           centers + cell * d);
    return;
  }
  constexpr std::size_t most = most_center_lanes;
  alignas(64) double corners[(most + 1) * most * block], weights_of_corners[(most + 1) * block];
  alignas(64) double found[most * block], settled[block];
  for (std::size_t cell = 0; cell < block; ++cell) {
    const double* const* of_cell = points + std::min(cell, count - 1) * (k + 1);  // repeats the last cell
    for (std::size_t i = 0; i <= k; ++i)
      for (std::size_t j = 0; j < d; ++j) corners[(i * d + j) * block + cell] = of_cell[i][j];
    for (std::size_t i = 0; weights != nullptr && i <= k; ++i)
      weights_of_corners[i * block + cell] = weights[std::min(cell, count - 1) * (k + 1) + i];
  }
  find_centers_in_lanes(d, corners, weights == nullptr ? nullptr : weights_of_corners, found, settled);
  for (std::size_t cell = 0; cell < count; ++cell) {
    double* center = centers + cell * d;
    for (std::size_t j = 0; j < d; ++j) center[j] = found[j * block + cell];
    if (settled[cell] != 0) continue;
    const double* of_cell = weights == nullptr ? nullptr : weights + cell * (k + 1);
    // For k ≤ 3 the scalar path computes the same. For larger k it exchanges rows and may succeed.
    if (k > 3 && (this->*certified_)(points + cell * (k + 1), of_cell, center)) continue;
    ++num_exact_;
    find_exactly(points + cell * (k + 1), of_cell, center);
  }
}

template <int N, class Finish>
bool CenterFinder::solve_certified(const double* const* points, const double* weights, Finish finish) const {
  const std::size_t n = N > 0 ? static_cast<std::size_t>(N) : axes_.size();
  kernel::Buffer<double, N * N> high(n * n), low(n * n), inverse(n * n), work(n * n);
  kernel::Buffer<double, N> right(n), z(n), residual(n), error(n), correction(n), tail(n);
  const double* origin = points[0];
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const auto axis = static_cast<std::size_t>(axes_[j]);
      const DoubleDouble edge = two_sum(points[i + 1][axis], -origin[axis]);
      high[i * n + j] = edge.high;
      low[i * n + j] = edge.low;
      largest = std::max(largest, std::abs(edge.high));
    }
  if (!(largest > 0x1p-100 && largest < 0x1p200)) return false;
  const int exponent = std::ilogb(largest) + 1;
  const double scale = std::ldexp(1.0, -exponent), unscale = std::ldexp(1.0, exponent - 1);
  for (std::size_t i = 0; i < n * n; ++i) {
    high[i] *= scale;
    low[i] *= scale;
    work[i] = high[i];
  }
  if (!kernel::approximate_inverse<N>(work.data(), inverse.data(), n)) return false;
  const double alpha = kernel::inverse_defect<N>(high.data(), inverse.data(), n);
  if (!(alpha < 0.5)) return false;

  const auto weight_difference = [&](std::size_t i) {
    DoubleDouble difference{0, 0};
    if (weights != nullptr) difference = two_sum(weights[i + 1], -weights[0]);
    return DoubleDouble{difference.high * scale * scale, difference.low * scale * scale};
  };
  for (std::size_t i = 0; i < n; ++i) {
    right[i] = -weight_difference(i).high;
    for (std::size_t j = 0; j < n; ++j) right[i] += high[i * n + j] * high[i * n + j];
  }
  constexpr double too_large = 1e8;
  for (std::size_t j = 0; j < n; ++j) {
    z[j] = 0;
    for (std::size_t i = 0; i < n; ++i) {
      z[j] += inverse[j * n + i] * right[i];
      if (!(std::abs(inverse[j * n + i]) < too_large)) return false;
    }
    if (!(std::abs(z[j]) < too_large)) return false;
  }
  const double second_order = 1.01 * 5 * static_cast<double>((n + 3) * (n + 3)) * u * u;
  for (std::size_t i = 0; i < n; ++i) {
    const DoubleDouble weight = weight_difference(i);
    double sum = -weight.high, rest = -weight.low, magnitude = std::abs(weight.high);
    for (std::size_t j = 0; j < n; ++j) {
      const double a = high[i * n + j], a_low = low[i * n + j];
      const DoubleDouble factor = two_sum(a, -z[j]);
      const double factor_low = factor.low + a_low;
      const DoubleDouble product = two_product(a, factor.high);
      const DoubleDouble next = two_sum(sum, product.high);
      sum = next.high;
      rest += (next.low + product.low) + (a * factor_low + a_low * factor.high);
      magnitude += std::abs(a) * (std::abs(a) + std::abs(z[j]));
    }
    residual[i] = sum + rest;
    error[i] = 1.01 * u * std::abs(residual[i]) + second_order * magnitude + 1e-280;
  }
  double zeta = 0;
  for (std::size_t j = 0; j < n; ++j) {
    correction[j] = 0;
    tail[j] = 0;
    for (std::size_t i = 0; i < n; ++i) {
      correction[j] += inverse[j * n + i] * residual[i];
      tail[j] +=
          std::abs(inverse[j * n + i]) * (error[i] + static_cast<double>(n + 2) * u * std::abs(residual[i]));
    }
    tail[j] = 1.01 * tail[j] + 1e-280;
    zeta = std::max(zeta, std::abs(correction[j]) + tail[j]);
  }
  zeta *= 1.01 / (1 - alpha);

  for (std::size_t j = 0; j < n; ++j) {
    double extent = 0;
    for (std::size_t i = 0; i < n; ++i) extent = std::max(extent, std::abs(high[i * n + j]));
    if (!finish(static_cast<std::size_t>(axes_[j]), z[j] * unscale, correction[j] * unscale,
                1.01 * (alpha * zeta + tail[j]) * unscale, extent * unscale))
      return false;
  }
  return true;
}

template <int N>
bool CenterFinder::find_certified(const double* const* points, const double* weights, double* center) const {
  const double* origin = points[0];
  for (std::size_t j = 0; j < static_cast<std::size_t>(dimension_); ++j) center[j] = origin[j] + 0.0;
  return solve_certified<N>(
      points, weights, [&](std::size_t axis, double offset, double correction, double error, double) {
        const DoubleDouble start = two_sum(origin[axis], offset);
        const double middle = start.low + correction;
        const DoubleDouble rounded = two_sum(start.high, middle);
        // `middle` is a rounded sum, and so are the ends of the interval.
        const double radius = error + 2 * u * std::abs(middle) + 4 * u * std::abs(rounded.low);
        const double below = rounded.high + (rounded.low - radius),
                     above = rounded.high + (rounded.low + radius);
        if (!(below == above)) return false;
        center[axis] = above + 0.0;
        return true;
      });
}

template <int N>
bool CenterFinder::find_offset_certified(const double* const* points, double* offset) const {
  std::fill_n(offset, dimension_, 0.0);
  return solve_certified<N>(
      points, nullptr, [&](std::size_t axis, double start, double correction, double error, double extent) {
        offset[axis] = start + correction;
        return error <= u / 4 * (std::abs(offset[axis]) + extent);
      });
}

void CenterFinder::find_offset(const double* const* points, double* offset) const {
  if (offset_certified_ != nullptr && (this->*offset_certified_)(points, offset)) return;
  const ExactOffset exact = find_offset_exactly(points);
  for (std::size_t j = 0; j < static_cast<std::size_t>(dimension_); ++j)
    offset[j] = kernel::nearest_double(exact.twice.numerators[j], exact.twice.denominator, exact.grid - 1);
}

CenterFinder::ExactOffset CenterFinder::find_offset_exactly(const double* const* points) const {
  const auto d = static_cast<std::size_t>(dimension_), k = axes_.size();
  const IntegerPoints integers(points, nullptr, k + 1, d);
  return {twice_center(integers, k, d), integers.grid};
}

void CenterFinder::find_exactly(const double* const* points, const double* weights, double* center) const {
  const auto d = static_cast<std::size_t>(dimension_), k = axes_.size();
  const IntegerPoints integers(points, weights, k + 1, d);
  const kernel::Fractions z = twice_center(integers, k, d);
  const kernel::Integer denominator = z.denominator * 2;
  for (std::size_t j = 0; j < d; ++j)
    center[j] = kernel::nearest_double(
        kernel::scaled_integer(points[0][j], integers.grid) * denominator + z.numerators[j], denominator,
        integers.grid);
}

bool CenterFinder::on_sphere(const double* const* points, const double* weights, const double* q,
                             double weight_of_q) const {
  const auto d = static_cast<std::size_t>(dimension_), k = axes_.size();
  std::vector<const double*> all(points, points + k + 1);
  all.push_back(q);
  std::vector<double> all_weights;
  if (weights != nullptr) {
    all_weights.assign(weights, weights + k + 1);
    all_weights.push_back(weight_of_q);
  }
  const IntegerPoints integers(all.data(), weights == nullptr ? nullptr : all_weights.data(), k + 2, d);
  const kernel::Fractions z = twice_center(integers, k, d);
  kernel::Integer dot = 0;
  for (std::size_t j = 0; j < d; ++j) dot += integers.edges[k * d + j] * z.numerators[j];
  return dot == integers.rights[k] * z.denominator;
}

namespace {

/// Scales x to length 1. Returns false for a zero vector.
bool normalise(std::vector<double>& x) {
  double largest = 0;
  for (const double entry : x) largest = std::max(largest, std::abs(entry));
  if (!(largest > 0)) return false;
  const int exponent = std::ilogb(largest);
  double square = 0;
  for (double& entry : x) {
    entry = std::ldexp(entry, -exponent);
    square += entry * entry;
  }
  for (double& entry : x) entry /= std::sqrt(square);
  return true;
}

/// v − Eᵀy with E·Eᵀ·y = E·v, where E holds the edges of the facet and v leads from `behind` to the facet.
std::vector<double> outward_exactly(const std::vector<const double*>& facet, const double* behind,
                                    std::size_t d) {
  std::vector<const double*> points = facet;
  points.push_back(behind);
  const IntegerPoints integers(points.data(), nullptr, points.size(), d);
  const std::size_t m = facet.size() - 1;
  const auto dot = [&](std::size_t a, std::size_t b) {
    kernel::Integer sum = 0;
    for (std::size_t j = 0; j < d; ++j) sum += integers.edges[a * d + j] * integers.edges[b * d + j];
    return sum;
  };
  std::vector<kernel::Integer> system;
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j <= m; ++j) system.push_back(dot(i, j));
  const kernel::Fractions y = kernel::solve_exactly(std::move(system), m);
  const kernel::Integer scale = m == 0 ? kernel::Integer(1) : y.denominator;  // positive, a Gram determinant
  std::vector<kernel::Integer> direction;
  kernel::Integer largest = 0;
  for (std::size_t j = 0; j < d; ++j) {
    direction.push_back(-integers.edges[m * d + j] * scale);
    for (std::size_t i = 0; i < m; ++i) direction[j] += y.numerators[i] * integers.edges[i * d + j];
    largest = std::max(largest, kernel::Integer(boost::multiprecision::abs(direction[j])));
  }
  std::vector<double> result;
  for (const kernel::Integer& x : direction) result.push_back(kernel::nearest_double(x, largest, 0));
  normalise(result);
  return result;
}

}  // namespace

std::vector<double> outward_direction(const std::vector<const double*>& facet, const double* behind,
                                      std::size_t dimension) {
  constexpr double cancelled = 0x1p-10;
  const std::size_t d = dimension;
  std::vector<double> basis, x(d);
  for (std::size_t i = 1; i <= facet.size(); ++i) {
    for (std::size_t j = 0; j < d; ++j)
      x[j] = i < facet.size() ? facet[i][j] / 2 - facet[0][j] / 2 : facet[0][j] / 2 - behind[j] / 2;
    if (!normalise(x)) return outward_exactly(facet, behind, d);
    for (std::size_t b = 0; b < basis.size(); b += d) {
      double dot = 0;
      for (std::size_t j = 0; j < d; ++j) dot += x[j] * basis[b + j];
      for (std::size_t j = 0; j < d; ++j) x[j] -= dot * basis[b + j];
    }
    double square = 0;
    for (const double entry : x) square += entry * entry;
    if (!(square > cancelled * cancelled)) return outward_exactly(facet, behind, d);
    normalise(x);
    basis.insert(basis.end(), x.begin(), x.end());
  }
  return x;
}

}  // namespace delone::internal
