// SPDX-License-Identifier: BSD-3-Clause
// Determinants do not change when a row is replaced by its difference from another one. Where points are in
// clusters, differences from q cancel in the elimination; differences along the edges of a minimum spanning
// tree do not, and they are exact as pairs. Proofs: docs/predicates.md, "Edges of a tree".
#include "kernel/scaled_stage.hpp"

#include "kernel/determinant.hpp"
#include "kernel/determinant_grid.hpp"
#include "kernel/direct.hpp"
#include "kernel/double_double.hpp"
#include "kernel/optimal_scaling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace delone::kernel {
namespace {

constexpr std::size_t most = most_scaled_columns;
constexpr double square_roundoff = unit_roundoff * unit_roundoff;
/// Covers what underflows in a lift, before it is scaled, and in the elimination of entries of at most 1.
constexpr double lift_underflow = 0x1p-850, elimination_underflow = 0x1p-800;
/// Smaller pivots are not divided by.
constexpr double least_pivot = 0x1p-400;

DoubleDouble times(const DoubleDouble& x, double power) { return {x.high * power, x.low * power}; }

/// x·2^e
double shifted(double x, std::int64_t e) {
  if (-1000 <= e && e <= 1000) return x * detail::power_of_two(e);
  return std::ldexp(x, static_cast<int>(std::clamp<std::int64_t>(e, -5000, 5000)));
}

/// n vectors of n entries, pairs without error but for the last entry, which is in error by at most `error`
/// of its vector, and by `error_in_binary64` where only the leading parts of all numbers are used.
struct Vectors {
  explicit Vectors(std::size_t size) : n(size) {}  // NOLINT: entries are written before they are read
  std::size_t n;
  double high[most][most], low[most][most];
  double error[most], error_in_binary64[most];

  void set(std::size_t vector, std::size_t entry, const DoubleDouble& x) {
    high[vector][entry] = x.high;
    low[vector][entry] = x.low;
  }
};

/// The exponents of the largest entry of each vector, and then of what is left of each entry. Returns false
/// if all are 0.
bool scale_by_largest(std::span<const std::int64_t> exponents, std::size_t n, std::int64_t* of_vector,
                      std::int64_t* of_entry) {
  std::fill_n(of_entry, n, exponent_of_zero);
  for (std::size_t i = 0; i < n; ++i) {
    const auto vector = exponents.subspan(i * n, n);
    of_vector[i] = *std::max_element(vector.begin(), vector.end());
    if (of_vector[i] == exponent_of_zero) return false;
    for (std::size_t r = 0; r < n; ++r)
      if (vector[r] != exponent_of_zero) of_entry[r] = std::max(of_entry[r], vector[r] - of_vector[i]);
  }
  return std::find(of_entry, of_entry + n, exponent_of_zero) == of_entry + n;
}

/// Scales vectors and entries by powers of two: all become at most 1. Returns the exponent of the power that
/// the determinant was divided by, or nothing if it is certainly 0.
std::optional<std::int64_t> scale(Vectors& a, bool is_uneven) {
  std::int64_t exponents[most * most], of_vector[most], of_entry[most];
  const int n = static_cast<int>(a.n);
  for (std::size_t i = 0; i < a.n; ++i)
    for (std::size_t r = 0; r < a.n; ++r) {
      const double size = std::max(std::fabs(a.high[i][r]), r + 1 == a.n ? a.error[i] : 0.0);
      exponents[i * a.n + r] = size == 0 ? exponent_of_zero : detail::upper_exponent(size);
    }
  if (!(is_uneven ? scale_optimally({exponents, a.n * a.n}, n, of_vector, of_entry)
                  : scale_by_largest({exponents, a.n * a.n}, a.n, of_vector, of_entry)))
    return std::nullopt;
  std::int64_t exponent = 0;
  for (std::size_t i = 0; i < a.n; ++i) {
    exponent += of_vector[i] + of_entry[i];
    for (std::size_t r = 0; r < a.n; ++r) {
      const std::int64_t e = -of_vector[i] - of_entry[r];
      if (-1000 <= e && e <= 1000) {
        const double power = detail::power_of_two(e);
        a.high[i][r] *= power;
        a.low[i][r] *= power;
      } else {
        a.high[i][r] = shifted(a.high[i][r], e);
        a.low[i][r] = shifted(a.low[i][r], e);
      }
    }
    a.error[i] = shifted(a.error[i], -of_vector[i] - of_entry[a.n - 1]);
    a.error_in_binary64[i] = shifted(a.error_in_binary64[i], -of_vector[i] - of_entry[a.n - 1]);
  }
  return exponent;
}

double length(const double* x, std::size_t n) {
  double square = 0;
  for (std::size_t r = 0; r < n; ++r) square += x[r] * x[r];
  return std::sqrt(square);
}

/// The determinant of scaled vectors in binary64.
CertifiedDeterminant eliminate_in_binary64(const Vectors& a) {
  double columns[most * most];
  int row_of[most];
  double relative = 0;
  for (std::size_t i = 0; i < a.n; ++i) {
    std::copy_n(a.high[i], a.n, columns + i * a.n);
    relative = std::max(relative, a.error_in_binary64[i] / length(a.high[i], a.n));
  }
  const int n = static_cast<int>(a.n);
  return factor<0>(columns, n, n, {bound_slack * (1.01 * unit_roundoff + relative), 0}, row_of);
}

/// The determinant of scaled vectors, which are overwritten, in pairs.
CertifiedDeterminant eliminate(Vectors& a) {
  const std::size_t n = a.n;
  const double size = static_cast<double>(n);
  // ≥ 1.01·(6n + 60)·u²·√n
  const double gamma = 1.01 * (6 * size + 60) * square_roundoff * std::sqrt(size);
  CertifiedDeterminant det;
  det.norm_product = 1;
  double norm[most], relative_sum = 0;
  for (std::size_t j = 0; j < n; ++j) {
    norm[j] = length(a.high[j], n);
    det.norm_product *= norm[j];
    relative_sum += a.error[j] / norm[j];
  }
  if (!(det.norm_product > 1e-240 && det.norm_product < 1e240)) return det;
  double value = 1;
  for (std::size_t s = 0; s < n; ++s) {
    double *const p = a.high[s], *const p_low = a.low[s];
    std::size_t pivot = s;
    for (std::size_t r = s + 1; r < n; ++r)
      if (std::fabs(p[r]) > std::fabs(p[pivot])) pivot = r;
    if (pivot != s) {
      value = -value;
      for (std::size_t j = 0; j < n; ++j) {
        std::swap(a.high[j][s], a.high[j][pivot]);
        std::swap(a.low[j][s], a.low[j][pivot]);
      }
    }
    double u_norm = 0;
    for (std::size_t r = 0; r <= s; ++r) u_norm += std::fabs(p[r]);
    relative_sum += (gamma * u_norm + elimination_underflow) / norm[s];
    value *= p[s];
    const DoubleDouble divisor{p[s], p_low[s]};
    if (!(std::fabs(divisor.high) >= least_pivot)) {
      // The whole column below is as small: it is replaced by 0, and then columns 0 … s are dependent.
      if (!(std::fabs(divisor.high) < least_pivot)) return det;  // NaN
      relative_sum += 1.01 * size * least_pivot / norm[s];
      value = 0;
      break;
    }
    for (std::size_t r = s + 1; r < n; ++r) {
      const DoubleDouble x{p[r], p_low[r]};
      const double first = x.high / divisor.high;
      const DoubleDouble rest = x - DoubleDouble{first, 0} * divisor;
      const double second = rest.high / divisor.high;
      p[r] = first + second;
      p_low[r] = second - (p[r] - first);
    }
    for (std::size_t j = s + 1; j < n; ++j) {
      double *const high = a.high[j], *const low = a.low[j];
      const DoubleDouble u{high[s], low[s]};
      for (std::size_t r = s + 1; r < n; ++r) {
        const DoubleDouble x = DoubleDouble{high[r], low[r]} - DoubleDouble{p[r], p_low[r]} * u;
        high[r] = x.high;
        low[r] = x.low;
      }
    }
  }
  det.value = value;
  // As in factor(); a pivot and its leading part differ by one rounding, as products do.
  if (relative_sum <= 0.1)
    det.error = bound_slack *
                (det.norm_product * 2.3 * relative_sum + 2.02 * size * unit_roundoff * std::fabs(value));
  return det;
}

/// The sign of the determinant of vectors, which lies on a grid. `is_uneven`: whether entries are of many
/// magnitudes, and binary64 has not been tried on these vectors.
std::optional<Sign> sign_of(Vectors& a, std::int64_t unit_exponent, bool is_uneven) {
  const auto grid_unit = [&](std::int64_t exponent) {
    return detail::power_of_two(unit_exponent - exponent);
  };
  if (!is_uneven) {
    Vectors evenly = a;
    const auto exponent = scale(evenly, false);
    if (!exponent) return Sign::zero;
    if (const auto sign = detail::certified_sign(eliminate(evenly), grid_unit(*exponent))) return sign;
  }
  const auto exponent = scale(a, true);
  if (!exponent) return Sign::zero;
  if (is_uneven)
    if (const auto sign = detail::certified_sign(eliminate_in_binary64(a), grid_unit(*exponent))) return sign;
  return detail::certified_sign(eliminate(a), grid_unit(*exponent));
}

/// A tree of n + 1 points.
struct Tree {
  std::size_t root;
  std::size_t parent[most + 1];
  bool has_clusters;  ///< whether some points are close to each other
};

/// The tree of points[0 … n], the last one the base: the minimum spanning tree if there are clusters, its
/// root with many points close to it unless it has to be the base; else the star of the base. `scale`: per
/// axis.
Tree spanning_tree(const Flat& flat, const double* const* points, std::size_t n, const double* scale,
                   bool root_is_base) {
  double square[most + 1][most + 1];
  for (std::size_t i = 0; i <= n; ++i) {
    square[i][i] = 0;
    for (std::size_t j = 0; j < i; ++j) {
      double sum = 0;
      for (std::size_t r = 0; r < flat.axes.size(); ++r) {
        const auto axis = static_cast<std::size_t>(flat.axes[r]);
        const double t = (points[i][axis] - points[j][axis]) * scale[r];
        sum += t * t;
      }
      square[i][j] = square[j][i] = sum;
    }
  }
  Tree tree{n, {}, false};
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      shortest = std::min(shortest, square[i][j]);
      longest = std::max(longest, square[i][j]);
    }
  tree.has_clusters = shortest < 0x1p-10 * longest;
  for (std::size_t i = 0; i <= n; ++i) tree.parent[i] = n;
  if (!tree.has_clusters) return tree;
  if (!root_is_base) {
    int least = std::numeric_limits<int>::max();
    for (std::size_t i = n + 1; i-- > 0;) {
      int exponents = 0;  // of the product of the distances from the others
      for (std::size_t j = 0; j <= n; ++j)
        if (j != i) exponents += std::max(detail::upper_exponent(square[i][j]), -1200);
      if (exponents < least) {
        least = exponents;
        tree.root = i;
      }
    }
  }
  double distance[most + 1];
  bool is_in[most + 1] = {};
  is_in[tree.root] = true;
  for (std::size_t i = 0; i <= n; ++i) {
    tree.parent[i] = tree.root;
    distance[i] = square[i][tree.root];
  }
  for (std::size_t count = 0; count < n; ++count) {
    std::size_t next = n + 1;
    for (std::size_t i = 0; i <= n; ++i)
      if (!is_in[i] && (next > n || distance[i] < distance[next])) next = i;
    is_in[next] = true;
    for (std::size_t i = 0; i <= n; ++i)
      if (!is_in[i] && square[i][next] < distance[i]) {
        distance[i] = square[i][next];
        tree.parent[i] = next;
      }
  }
  return tree;
}

/// Homogeneous rows (p_i, 1) and (base, 1): no difference, and so no cancellation.
std::optional<Sign> homogeneous_sign(const Flat& flat, const double* const* points, const double* base,
                                     std::int64_t unit_exponent) {
  const std::size_t k = flat.axes.size();
  if (k + 1 > most) return std::nullopt;
  Vectors a(k + 1);
  for (std::size_t i = 0; i <= k; ++i) {
    const double* p = i < k ? points[i] : base;
    for (std::size_t r = 0; r < k; ++r) a.set(i, r, {p[flat.axes[r]], 0});
    a.set(i, k, {1, 0});
    a.error[i] = a.error_in_binary64[i] = 0;
  }
  return sign_of(a, unit_exponent, true);
}

}  // namespace

std::optional<Sign> scaled_orientation(const Flat& flat, const double* const* points, const double* base) {
  const std::size_t k = flat.axes.size();
  if (k < 2 || k > most - 1) return std::nullopt;
  const double* all[most + 1];
  std::copy_n(points, k, all);
  all[k] = base;
  double axis_scale[most];
  const std::int64_t unit_exponent = determinant_exponent(flat, points, k, base, false);
  bool fits = true;
  for (std::size_t r = 0; r < k; ++r) {
    const int axis = flat.axes[r];
    double largest = 0;
    for (std::size_t i = 0; i < k; ++i) largest = std::max(largest, std::fabs(points[i][axis] - base[axis]));
    if (largest == 0) return Sign::zero;
    fits = fits && largest < largest_difference;
    axis_scale[r] = detail::normalisation(std::min(largest, largest_difference)).scale;
  }
  if (fits) {
    const Tree tree = spanning_tree(flat, all, k, axis_scale, false);
    Vectors a(k);
    for (std::size_t i = 0; i < k; ++i) {
      const std::size_t from = i == tree.root ? k : i;  // the base takes the place of the root
      const double *p = all[from], *parent = all[tree.parent[from]];
      for (std::size_t r = 0; r < k; ++r) a.set(i, r, two_difference(p[flat.axes[r]], parent[flat.axes[r]]));
      a.error[i] = a.error_in_binary64[i] = 0;
    }
    if (const auto sign = sign_of(a, unit_exponent, tree.has_clusters))
      return tree.root == k ? *sign : -*sign;
  }
  return homogeneous_sign(flat, points, base, unit_exponent);
}

std::optional<Sign> scaled_sphere(const Flat& flat, const double* const* points, const double* q) {
  const std::size_t k = flat.axes.size(), n = k + 1;
  if (k < 1 || n > most) return std::nullopt;
  const double* all[most + 1];
  std::copy_n(points, n, all);
  all[n] = q;
  const auto extent = [&](int axis) {
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::fabs(points[i][axis] - q[axis]));
    return largest;
  };
  double axis_scale[most];
  const std::int64_t unit_exponent = determinant_exponent(flat, points, n, q, true);
  for (std::size_t r = 0; r < k; ++r) {
    const int axis = flat.axes[r];
    const double largest = extent(axis);
    if (largest == 0) return Sign::zero;
    if (!(largest < largest_difference)) return std::nullopt;
    axis_scale[r] = detail::normalisation(largest).scale;
  }
  double largest = 0;
  for (int j = 0; j < flat.ambient; ++j) largest = std::max(largest, extent(j));
  const double largest_weight = flat.weighted() ? extent(flat.ambient) : 0;
  if (!(largest < largest_difference && largest_weight < largest_difference)) return std::nullopt;
  int exponent = -1000;  // differences by 2^exponent, and weights by its square, are at most 1
  if (largest > 0) exponent = detail::normalisation(largest).exponent;
  if (largest_weight > 0)
    exponent = std::max(exponent, (detail::normalisation(largest_weight).exponent + 1) >> 1);
  const double lift_scale = detail::power_of_two(-exponent);

  // In a flat only q is certain to be a base of the same determinant.
  const bool is_full = flat.ambient == static_cast<int>(k);
  const Tree tree = spanning_tree(flat, all, n, axis_scale, !is_full);
  const double* const origin = all[tree.root];
  Vectors a(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t from = i == tree.root ? n : i;  // q takes the place of the root
    const double *p = all[from], *parent = all[tree.parent[from]];
    for (std::size_t r = 0; r < k; ++r) a.set(i, r, two_difference(p[flat.axes[r]], parent[flat.axes[r]]));
    // |p − o|² − |parent − o|² = (p − parent)·((p − o) + (parent − o))
    DoubleDouble lift{0, 0};
    double parts = 0;
    for (int j = 0; j < flat.ambient; ++j) {
      const DoubleDouble along = times(two_difference(p[j], origin[j]), lift_scale);
      if (parent == origin) {
        lift = lift + along * along;
        parts += along.high * along.high;
        continue;
      }
      const DoubleDouble edge = times(two_difference(p[j], parent[j]), lift_scale);
      const DoubleDouble before = times(two_difference(parent[j], origin[j]), lift_scale);
      lift = lift + edge * (along + before);
      parts += std::fabs(edge.high) * (std::fabs(along.high) + std::fabs(before.high));
    }
    if (flat.weighted()) {
      const DoubleDouble weight =
          times(times(two_difference(p[flat.ambient], parent[flat.ambient]), lift_scale), lift_scale);
      lift = lift - weight;
      parts += std::fabs(weight.high);
    }
    a.set(i, k, lift);
    a.error[i] = 1.01 * (6 * flat.ambient + 30) * square_roundoff * parts + lift_underflow;
    a.error_in_binary64[i] = a.error[i] + 1.01 * unit_roundoff * std::fabs(lift.high);
  }
  const auto sign = sign_of(a, unit_exponent - 2 * exponent, tree.has_clusters);
  return !sign || tree.root == n ? sign : -*sign;
}

}  // namespace delone::kernel
