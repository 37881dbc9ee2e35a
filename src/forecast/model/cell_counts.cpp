// SPDX-License-Identifier: BSD-3-Clause
#include "forecast/model/cell_counts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace delone::cost_model {
namespace {

/// C(n, m) for real n ≥ m − 1; exact for whole numbers as long as the products are below 2⁵³.
double binomial(double n, int m) {
  double result = 1;
  for (int i = 0; i < m; ++i) result = result * std::max(n - i, 0.0) / (i + 1);
  return result;
}

/// The largest value of each coordinate among the first n points of {0 … side−1}^d.
std::vector<double> extents(int d, double n, double side) {
  std::vector<double> result;
  for (int j = 0; j < d; ++j) {
    const double layer = std::pow(side, d - 1 - j);
    const double top = std::ceil(n / layer) - 1;
    result.push_back(std::min(top, side - 1));
    if (top > 0) {
      result.resize(static_cast<std::size_t>(d), side - 1);
      break;
    }
  }
  return result;
}

}  // namespace

double poisson_cells_per_point(int k) {
  const double d = k;
  return std::exp((d + 1) * std::numbers::ln2 + (d - 1) / 2 * std::log(std::numbers::pi) -
                  std::log(d * d * (d + 1)) + std::lgamma((d * d + 1) / 2) - std::lgamma(d * d / 2) +
                  d * (std::lgamma(1 + d / 2) - std::lgamma((d + 1) / 2)));
}

double moment_curve_cells(int k, double n) {
  return k % 2 == 1 ? binomial(n - (k + 1) / 2, (k + 1) / 2) : binomial(n - 1 - k / 2, k / 2);
}

double most_cells(int k, double n) {
  const int dimension = k + 1;  // of the polytope
  const double vertices = n + 1;
  const int half = dimension / 2;
  if (vertices < dimension + 1) return 0;
  return dimension % 2 == 0 ? vertices * binomial(vertices - half, half) / (vertices - half)
                            : 2 * binomial(vertices - half - 1, half);
}

double grid_side(int d, double n) {
  double side = std::max(std::floor(std::pow(n, 1.0 / d)), 1.0);
  while (std::pow(side, d) < n) ++side;
  while (side > 1 && std::pow(side - 1, d) >= n) --side;
  return side;
}

LatticeHull lattice_hull(int d, double n, double side) {
  if (d == 0 || n <= 1 || side <= 1) return {};
  const double layer = std::pow(side, d - 1);
  const double full = std::floor(n / layer), rest = n - full * layer;
  if (full == 0 || n == layer) return lattice_hull(d - 1, n, side);
  const double whole = std::pow(side - 1, d - 1);
  double between = 0;  // the last full layer and the rest: slices of their hull are sums of the two
  if (rest > 0) {
    constexpr int steps = 64;
    const std::vector<double> top = extents(d - 1, rest, side);
    for (int i = 0; i < steps; ++i) {
      const double t = (i + 0.5) / steps;
      double slice = 1;
      for (const double extent : top) slice *= (1 - t) * (side - 1) + t * extent;
      between += slice / steps;
    }
  }
  return {d, (full - 1) * whole + between};
}

double factorial(int k) { return std::tgamma(k + 1.0); }

}  // namespace delone::cost_model
