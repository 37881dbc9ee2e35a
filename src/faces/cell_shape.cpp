// SPDX-License-Identifier: BSD-3-Clause
// With the Gram matrix G of the edges from p_0, 1/h_i² = (G⁻¹)_ii for i ≥ 1, and Σ(G⁻¹)_ij for i = 0. R is an
// approximate inverse with ‖I − RG‖ ≤ α ≤ 1/2 in the norm of row sums. So ‖G⁻¹‖ ≤ 2‖R‖, and row sums of |R −
// G⁻¹| are at most α‖G⁻¹‖ ≤ δ = 2α‖R‖: no entry is off by more, and the sum of all by at most nδ.
//
// det G is the product of the pivots of G = LDLᵀ. Computed pivots are those of a matrix G + Δ with |Δ_ij| ≤
// 1.1(n+1)u·√(G_ii·G_jj) (Higham, Accuracy and Stability of Numerical Algorithms, theorem 10.3), and
// computing G adds 1.02(d+3)u·g, g = max G_ii. As det(G + Δ)/det G = det(I + G⁻¹Δ) and ‖G⁻¹Δ‖ ≤ β
// = 2.3‖R‖·n(n+d+5)u·g, the relative error of the determinant is at most (1+β)ⁿ − 1, and that of its n-th
// root about β.
#include "faces/cell_shape.hpp"

#include "base/infinity.hpp"
#include "base/length.hpp"
#include "faces/certified_gram.hpp"
#include "kernel/fractions.hpp"
#include "kernel/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace delone::internal {
namespace {

using kernel::Integer;
constexpr double enough = 1e-10;

/// Calls work(gram) with a CertifiedGram.
template <class Work>
double with_gram(const double* const* points, std::size_t corners, std::size_t dimension, const Work& work) {
  if (corners == 4 && dimension == 3) return work(CertifiedGram<3, 3>(points, corners, dimension));
  if (corners == 3 && dimension == 2) return work(CertifiedGram<2, 2>(points, corners, dimension));
  return work(CertifiedGram<0, 0>(points, corners, dimension));
}

/// The edges from the first vertex in integers.
struct IntegerEdges {
  int grid = std::numeric_limits<int>::max();
  std::vector<Integer> edges, gram;
  std::size_t n;

  IntegerEdges(const double* const* points, std::size_t corners, std::size_t d) : n(corners - 1) {
    for (std::size_t i = 0; i < corners; ++i)
      for (std::size_t j = 0; j < d; ++j) grid = std::min(grid, kernel::trailing_exponent(points[i][j]));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < d; ++j)
        edges.push_back(kernel::scaled_integer(points[i + 1][j], grid) -
                        kernel::scaled_integer(points[0][j], grid));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t m = 0; m < n; ++m) {
        Integer dot = 0;
        for (std::size_t j = 0; j < d; ++j) dot += edges[i * d + j] * edges[m * d + j];
        gram.push_back(std::move(dot));
      }
  }

  /// From vertex i+1 to vertex m+1, or to the first one if i = m.
  Integer square_of_edge(std::size_t i, std::size_t m) const {
    const Integer& own = gram[i * n + i];
    return m == i ? own : Integer(own + gram[m * n + m] - 2 * gram[i * n + m]);
  }
};

/// Whether a number, and quotients of two of them, are far from both ends of the range of doubles.
bool is_moderate(double x) { return x > 1e-145 && x < 1e145; }

/// The square of the radius is this over 4·det G squared units: bᵀ(adj G)b for the squared lengths b of the
/// edges from the first vertex. Gives det G, too.
Integer square_of_radius(const IntegerEdges& e, Integer& determinant) {
  std::vector<Integer> system;
  for (std::size_t a = 0; a < e.n; ++a) {
    for (std::size_t b = 0; b < e.n; ++b) system.push_back(e.gram[a * e.n + b]);
    system.push_back(e.gram[a * e.n + a]);
  }
  kernel::Fractions solution = kernel::solve_exactly(std::move(system), e.n);
  determinant = std::move(solution.denominator);
  Integer square = 0;
  for (std::size_t i = 0; i < e.n; ++i) square += e.gram[i * e.n + i] * solution.numerators[i];
  return square;
}

/// k over the sum of radius/h over the heights h, each of which is at least ½: 1/h² = c/det G for an entry c
/// of adj G. Summed in units of 2^60, so that the sum is beyond the range of doubles only where the ratio is
/// below all of them.
double exact_radius_ratio(const double* const* points, std::size_t corners, std::size_t d) {
  const IntegerEdges e(points, corners, d);
  Integer determinant, first = 0;
  const Integer square = square_of_radius(e, determinant), denominator = 4 * determinant * determinant;
  constexpr int exponent = 60;
  double sum = 0;
  for (std::size_t i = 0; i < e.n; ++i) {
    std::vector<Integer> system;
    for (std::size_t a = 0; a < e.n; ++a) {
      for (std::size_t b = 0; b < e.n; ++b) system.push_back(e.gram[a * e.n + b]);
      system.emplace_back(a == i ? 1 : 0);
    }
    const kernel::Fractions column = kernel::solve_exactly(std::move(system), e.n);
    for (const Integer& entry : column.numerators) first += entry;
    sum += kernel::root_above(square * column.numerators[i], denominator, -exponent);
  }
  sum += kernel::root_above(square * first, denominator, -exponent);
  return std::min(1.0, std::ldexp(static_cast<double>(e.n) / sum, -exponent));
}

double exact_radius_edge_ratio(const double* const* points, std::size_t corners, std::size_t d) {
  const IntegerEdges e(points, corners, d);
  Integer shortest = e.gram[0];
  for (std::size_t i = 0; i < e.n; ++i)
    for (std::size_t m = 0; m <= i; ++m) shortest = std::min(shortest, e.square_of_edge(i, m));
  Integer determinant;
  const Integer square = square_of_radius(e, determinant);
  return kernel::root_above(square, 4 * determinant * shortest, 0);
}

double exact_mean_ratio(const double* const* points, std::size_t corners, std::size_t d) {
  const IntegerEdges e(points, corners, d);
  const auto n = static_cast<int>(e.n);
  Integer squares = 0;
  for (std::size_t i = 0; i < e.n; ++i)
    for (std::size_t m = 0; m <= i; ++m) squares += e.square_of_edge(i, m);
  const Integer numerator = kernel::exact_determinant(e.gram, e.n);
  Integer denominator = n + 1;
  for (int i = 0; i < n; ++i) denominator *= squares;
  // About a power of 2^n is taken out of the root.
  const int bits = static_cast<int>(msb(denominator)) - static_cast<int>(msb(numerator)), steps = bits / n;
  const double root = std::pow(kernel::nearest_double(numerator, denominator, steps * n), 1.0 / n);
  return std::min(1.0, n * (n + 1) * std::ldexp(root, -steps));
}

}  // namespace

double radius_ratio(const double* const* points, std::size_t corners, std::size_t dimension, double radius) {
  if (!is_moderate(radius)) return exact_radius_ratio(points, corners, dimension);
  return with_gram(points, corners, dimension, [&](auto&& gram) {
    if (!gram.invert()) return exact_radius_ratio(points, corners, dimension);
    const auto n = static_cast<double>(gram.n);
    const double error = 2 * gram.alpha * gram.norm;
    double first = 0, magnitude = 0, sum = 0;
    bool is_enough = true;
    for (std::size_t i = 0; i < gram.n; ++i) {
      for (std::size_t j = 0; j < gram.n; ++j) {
        first += gram.inverse[i * gram.n + j];
        magnitude += std::fabs(gram.inverse[i * gram.n + j]);
      }
      const double own = gram.inverse[i * gram.n + i];
      is_enough = is_enough && error <= enough * own;
      sum += std::sqrt(own);
    }
    const double rounding = 2 * n * n * kernel::unit_roundoff * magnitude;
    is_enough = is_enough && n * error + rounding <= enough * first;
    if (!is_enough) return exact_radius_ratio(points, corners, dimension);
    return std::min(1.0, n / ((sum + std::sqrt(first)) * radius));
  });
}

double mean_ratio(const double* const* points, std::size_t corners, std::size_t dimension) {
  return with_gram(points, corners, dimension, [&](auto&& gram) {
    if (!gram.invert()) return exact_mean_ratio(points, corners, dimension);
    const std::size_t size = gram.n;
    const auto n = static_cast<double>(size), d = static_cast<double>(dimension);
    const double beta = 2.3 * gram.norm * n * (n + d + 5) * kernel::unit_roundoff * gram.square;
    if (!(beta <= enough)) return exact_mean_ratio(points, corners, dimension);
    double squares = 0;
    for (std::size_t i = 0; i < corners; ++i)
      for (std::size_t m = 0; m < i; ++m)
        for (std::size_t j = 0; j < dimension; ++j) {
          const double difference = points[i][j] - points[m][j];
          squares += difference * difference;
        }
    double product = 1 / (n + 1);  // of the pivots, each over the sum of squares
    auto& pivots = gram.gram;
    for (std::size_t s = 0; s < size; ++s) {
      const double pivot = pivots[s * size + s];
      if (!(pivot > 0)) return exact_mean_ratio(points, corners, dimension);
      product *= pivot / squares;
      for (std::size_t i = s + 1; i < size; ++i) {
        const double factor = pivots[i * size + s] / pivot;
        for (std::size_t j = s + 1; j < size; ++j) pivots[i * size + j] -= factor * pivots[s * size + j];
      }
    }
    if (!(product > 1e-290)) return exact_mean_ratio(points, corners, dimension);
    return std::min(1.0, n * (n + 1) * std::pow(product, 1 / n));
  });
}

double radius_edge_ratio(const double* const* points, std::size_t corners, std::size_t dimension,
                         double radius) {
  double shortest = infinity;
  for (std::size_t i = 0; i < corners; ++i)
    for (std::size_t m = 0; m < i; ++m)
      shortest = std::min(shortest,
                          length_of(dimension, [&](std::size_t j) { return points[i][j] - points[m][j]; }));
  return is_moderate(radius) && is_moderate(shortest) ? radius / shortest
                                                      : exact_radius_edge_ratio(points, corners, dimension);
}

}  // namespace delone::internal
