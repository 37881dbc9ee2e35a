// SPDX-License-Identifier: BSD-3-Clause
#include "forecast/model/cost.hpp"

#include "engine/wrap/is_worth_wrapping.hpp"
#include "forecast/model/cell_counts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace delone::cost_model {
namespace {

/// What constructions of uniform points in one dimension took. With v vertices and s = v^(−1/k), by which the
/// share of points at the border falls:
struct Measured {
  double first, last;  ///< the numbers of vertices that were measured
  std::array<double, 4>
      cells;  ///< log(cells/v) − log(cells per point of a Poisson process) = s·polynomial(s)
  std::array<double, 3> created;   ///< log(created/finite cells), a polynomial in s, if points are inserted
  std::array<double, 2> infinite;  ///< log(infinite/finite cells), a line in log(v)
  /// If points are inserted: nanoseconds per created cell at `last` vertices, which grow as a power of v, and
  /// bytes per cell, infinite ones included.
  double nanoseconds, slowdown, bytes;
  double wrapping_nanoseconds, wrapping_bytes;  ///< if cells are wrapped, per cell
};

// AMD EPYC (Zen 4), g++ 12.2 -O3, one thread, 26 November 2026.
// clang-format off
constexpr std::array<Measured, largest_measured_dimension> measured{{
    {16, 524288, {}, {0.69315, 0.4996, 0.40036}, {0.7067, -1.0012}, 304.1, 0.13, 56.25, 0, 0},
    {16, 524288, {-0.12775, -3.9221, -15.006, 23.028}, {1.1265, -0.26446, -0.60816}, {1.3564, -0.87997},
     73.12, 0.0536, 60.24, 0, 0},
    {16, 1500000, {-0.29773, -1.5116, -18.126, 24.634}, {1.3035, -0.92942, 0.89185}, {1.4274, -0.77718},
     80, 0.115, 76.16, 0, 0},
    {16, 32768, {-0.40628, -3.4288, 0.43295, -16.29}, {1.5866, -1.6736, 2.142}, {1.2941, -0.67876},
     75.55, 0, 87.81, 0, 0},
    {16, 50000, {-0.21545, -7.7246, 15.17, -31.41}, {1.7262, -1.1456, 0.49552}, {1.0816, -0.59487},
     90.73, 0.022, 96.45, 0, 0},
    {16, 2048, {-1.6137, 1.5667, -7.9639, -14.324}, {2.034, -1.8418, 0.97531}, {1.2388, -0.59334},
     117.5, 0, 112.7, 0, 0},
    {12, 768, {11.554, -84.494, 174.05, -141.92}, {1.8667, -0.84166, 0}, {1.4174, -0.60674},
     184.2, 0, 141.5, 963.5, 85.27},
    {12, 330, {35.373, -214.25, 404.63, -277.3}, {1.3148, 0, 0}, {1.3027, -0.58259},
     284.2, 0, 190.7, 937.5, 105.1},
}};
// clang-format on

Measured measured_in(int k) {
  if (k <= largest_measured_dimension) return measured[static_cast<std::size_t>(k - 1)];
  // Sizes of cells go on growing. The engine for any dimension is slower than compiled ones: it takes 1.3 µs
  // per created cell in 10D, and 2 µs in 12D.
  Measured last = measured.back();
  last.bytes *= static_cast<double>(k) / largest_measured_dimension;
  last.nanoseconds = 13.0 * k * k;
  last.slowdown = 0;
  return last;
}

template <std::size_t N>
double polynomial(const std::array<double, N>& c, double x) {
  double value = 0;
  for (std::size_t i = N; i-- > 0;) value = value * x + c[i];
  return value;
}

/// In many dimensions nearly all points are at the border, and the share of the constant in logarithms, 1 −
/// log(cells/v)/log(cells per point of a Poisson process), is nearly a function of v/(k+1). Fitted to 5D to
/// 20D, up to 150 points per dimension in 6D and 14 in 10D, where it is off by 15 % at most.
double finite_cells_of_many_dimensions(int k, double v) {
  const double l = std::log(v / (k + 1)), u = l / (1 + l), inverse = 1.0 / std::min(k, 30);
  const double log_share =
      l * (0.0463 - 2.4012 * inverse) + u * (-1.592 + 4.6834 * inverse) + 0.9495 * u / (1 + l);
  return v * std::pow(poisson_cells_per_point(k), 1 - std::exp(std::min(log_share, 0.0)));
}

double finite_cells(const Measured& curve, int k, double v) {
  if (v <= k + 1) return v == k + 1 ? 1 : 0;
  if (k == 1) return v - 1;
  if (k > largest_measured_dimension) return std::max(finite_cells_of_many_dimensions(k, v), 1.0);
  const double s = std::pow(v, -1.0 / k);
  return v * poisson_cells_per_point(k) * std::exp(s * polynomial(curve.cells, s));
}

double infinite_per_cell(const Measured& curve, int k, double v) {
  return k <= largest_measured_dimension ? std::exp(polynomial(curve.infinite, std::log(v)))
                                         : 1.7 * std::pow(v / (k + 1), -0.7);
}

/// By which finite_cells() may be wrong: it grows with the distance from what was measured.
double factor_of_cells(const Measured& curve, int k, double v) {
  if (v <= k + 1) return 1;
  if (k <= largest_measured_dimension) return 1 + 0.07 * std::log2(2 * std::max(v / curve.last, 1.0));
  constexpr double measured_per_dimension = 6;
  constexpr int measured_dimension = 12;
  constexpr double largest = 10;  // a logarithm
  return std::exp(std::min(0.25 + 0.15 * std::log(std::max(v / (k + 1) / measured_per_dimension, 1.0)) +
                               0.04 * std::max(k - measured_dimension, 0),
                           largest));
}

bool is_wrapped(int k, double points, bool wraps) {
  return wraps && engine::is_worth_wrapping(k, static_cast<std::size_t>(std::min(points, 1e9)));
}

}  // namespace

double bytes_of(int k, int d, double points, double vertices, double cells, bool wraps) {
  const Measured curve = measured_in(std::max(k, 1));
  constexpr double page_bytes =
      2.5e6;  // what arrays take beyond their entries, as memory comes in large pages
  const double of_cells = cells * (is_wrapped(k, points, wraps) ? curve.wrapping_bytes : curve.bytes);
  // Coordinates in the order of insertion, ids, images of the points for geometry.
  return of_cells + std::min(of_cells, page_bytes) + points * (8.0 * d + 8) + vertices * 12;
}

Cost cost_of_spread(int k, int d, double points, double vertices, bool wraps) {
  Cost cost;
  cost.vertices = vertices;
  const Measured curve = measured_in(k);
  cost.factor = factor_of_cells(curve, k, vertices);
  // So few points span less: they are one simplex in their flat.
  if (vertices < k + 1) k = static_cast<int>(vertices) - 1;
  cost.affine_dimension = k;
  constexpr double nanoseconds_per_point = 60;  // to order them, and to meet duplicates
  cost.seconds = 1e-9 * nanoseconds_per_point * points;
  if (k < 1) {
    cost.cells = cost.infinite_cells = k < 0 ? 0 : 1;
    cost.bytes = bytes_of(k, d, points, vertices, cost.cells, false);
    return cost;
  }
  const double most = most_cells(k, vertices), s = std::pow(vertices, -1.0 / k);
  cost.cells = std::min(finite_cells(curve, k, vertices), std::max(most - 1, 1.0));
  cost.infinite_cells =
      std::min(cost.cells * infinite_per_cell(curve, k, vertices), std::max(most - cost.cells, k + 1.0));
  const double all = cost.cells + cost.infinite_cells;
  if (is_wrapped(k, points, wraps)) {
    cost.created_cells = all;
    cost.seconds += 1e-9 * curve.wrapping_nanoseconds * all;
  } else {
    // The polynomial was fitted to what was measured.
    const double least_s = std::pow(std::max(vertices, curve.first), -1.0 / k);
    cost.created_cells =
        std::max(cost.cells * std::exp(polynomial(curve.created, std::min(s, least_s))), all);
    cost.seconds +=
        1e-9 * curve.nanoseconds * std::pow(vertices / curve.last, curve.slowdown) * cost.created_cells;
  }
  cost.bytes = bytes_of(k, d, points, vertices, all, wraps);
  return cost;
}

double speedup(unsigned threads) {
  constexpr double alone = 0.35;  // of the time, what threads do not share: 1.3 to 1.6 for two of them
  return 1 / (alone + (1 - alone) / std::max(threads, 1u));
}

}  // namespace delone::cost_model
