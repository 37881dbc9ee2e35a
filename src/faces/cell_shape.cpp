// SPDX-License-Identifier: BSD-3-Clause
// Stages: binary64, pairs of doubles, integers. The first two have an inverse X with |M⁻¹ − X|_ij ≤ 2·r_i·ρ_j
// (faces/edge_inverse.hpp, with the names); s_i and w_j are the entries of S and W.
//
// Heights. 1/h_i is the length of the gradient of barycentric coordinate i. With as many edges as dimensions
// the gradients of vertices 1 … n are the columns of A⁻¹ = W·M⁻¹·S, and that of vertex 0 is minus their sum.
// Column i of W·X·S is off by a vector of length at most 2·s_i·ρ_i·t, t = √Σ(w_j·r_j)². The sum is off by at
// most 2t·Σs_i·ρ_i and by what is rounded in n sums, at most 1.01n·ε·Σ_i s_i|X_ji| in row j. Otherwise, with
// the Gram matrix G of the edges, 1/h_i² = (G⁻¹)_ii for i ≥ 1, and Σ(G⁻¹)_ij for i = 0, and G⁻¹ = S·M⁻¹·S.
// Sums of entries of S·X·S are off by those of 2·s_i·r_i·ρ_j·s_j, and by roundings of at
// most 1.01n²·ε·Σs_i|X_ij|s_j.
//
// det M is the product of the pivots of M. Multipliers are at most 1.01 in magnitude, no entry that occurs
// exceeds g, so each step changes an entry by at most 5ε·g more or less than it should: the products and
// differences by at most 2.1ε·g + 1.01ε·g, and a multiplier times the pivot is off the entry that it removes
// by at most 4.5ε·g. (Of pairs: the first quotient leaves a rest of at most 3.1u of the entry, known up to
// 22u², of which the second leaves at most 13u²; 35u² < 4.5ε.) So computed pivots are those of M + Δ with
// |Δ_ij| ≤ 5n·ε·g + 1.02·ι·ε·μ. As det(M + Δ)/det M = det(I + M⁻¹Δ) and ‖M⁻¹Δ‖ ≤ β = 2.1·max r_i·n·ε(5n·g
// + 1.02·ι·μ), the relative error of the determinant is at most (1 + β)ⁿ − 1, and that of the n-th root of
// its square about 2β.
#include "faces/cell_shape.hpp"

#include "base/compiled_dimension.hpp"
#include "base/infinity.hpp"
#include "base/length.hpp"
#include "base/progress_meter.hpp"
#include "faces/edge_inverse.hpp"
#include "kernel/fractions.hpp"
#include "solve/integer_edges.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace delone::internal {
namespace {

using kernel::Integer;
constexpr double enough = 1e-10;

/// Calls work with an EdgeInverse in binary64, then with one of pairs, until that returns a number of at
/// least 0; otherwise returns exact().
template <class Work, class Exact>
double by_stages(const double* const* points, std::size_t corners, std::size_t dimension, ShapeStage* stage,
                 const Work& work, const Exact& exact) {
  return with_compiled_dimension<2, 4>(corners - 1, [&](auto size) {
    ShapeStage unused;
    ShapeStage& by = stage != nullptr ? *stage : unused;
    by = ShapeStage::binary64;
    EdgeInverse<size(), double> quick(points, corners, dimension);
    if (quick.invert())
      if (const double found = work(quick); found >= 0) return found;
    by = ShapeStage::pairs;
    EdgeInverse<size(), DoubleDouble> pairs(points, corners, dimension);
    for (bool is_certified = pairs.invert(); is_certified; is_certified = pairs.improve())
      if (const double found = work(pairs); found >= 0) return found;
    by = ShapeStage::integers;
    return exact();
  });
}

/// −1 if it is not certain.
template <int N, class T>
double sum_of_gradients(const EdgeInverse<N, T>& e) {
  const std::size_t n = e.n;
  const auto& s = e.edge_scale;
  const auto& w = e.axis_scale;
  double spread = 0, defect = 0;  // t, Σ s_i·ρ_i
  for (std::size_t j = 0; j < n; ++j) {
    spread += w[j] * e.row_sum[j] * (w[j] * e.row_sum[j]);
    defect += s[j] * e.defect[j];
  }
  spread = 2.02 * std::sqrt(spread);
  double sum = 0, first = 0, rounding = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double square = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const double x = w[j] * high_of(e.inverse[j * n + i]);
      square += x * x;
    }
    const double length = std::sqrt(square);
    if (!(spread * e.defect[i] <= enough * length)) return -1;
    sum += s[i] * length;
  }
  for (std::size_t j = 0; j < n; ++j) {
    T total = e.number(0);
    double magnitude = 0;
    for (std::size_t i = 0; i < n; ++i) {
      total = total + scaled(e.inverse[j * n + i], s[i]);
      magnitude += s[i] * std::fabs(high_of(e.inverse[j * n + i]));
    }
    const double x = w[j] * high_of(total), error = w[j] * magnitude;
    first += x * x;
    rounding += error * error;
  }
  first = std::sqrt(first);
  rounding = 1.02 * static_cast<double>(n) * e.epsilon * std::sqrt(rounding);
  return spread * defect + rounding <= enough * first ? sum + first : -1;
}

template <int N, class T>
double sum_of_gram_roots(const EdgeInverse<N, T>& e) {
  const std::size_t n = e.n;
  const auto& s = e.edge_scale;
  double sum = 0, defect = 0, rows = 0, magnitude = 0;
  T first = e.number(0);
  for (std::size_t i = 0; i < n; ++i) {
    const double own = high_of(e.inverse[i * n + i]);
    if (!(2.02 * e.row_sum[i] * e.defect[i] <= enough * own)) return -1;
    sum += s[i] * std::sqrt(own);
    defect += s[i] * e.defect[i];
    rows += s[i] * e.row_sum[i];
    for (std::size_t j = 0; j < n; ++j) {
      first = first + scaled(e.inverse[i * n + j], s[i] * s[j]);
      magnitude += s[i] * s[j] * std::fabs(high_of(e.inverse[i * n + j]));
    }
  }
  const auto dn = static_cast<double>(n);
  const double error = 2.02 * rows * defect + 1.02 * dn * dn * e.epsilon * magnitude, square = high_of(first);
  return error <= enough * square ? sum + std::sqrt(square) : -1;
}

/// x/y, off by less than an entry may be after a step of elimination.
double quotient(double x, double y) { return x / y; }
DoubleDouble quotient(const DoubleDouble& x, const DoubleDouble& y) {
  const double first = x.high / y.high;
  const DoubleDouble rest = x - DoubleDouble{first, 0} * y;
  return kernel::two_sum(first, rest.high / y.high);
}

/// The n-th root of the determinant of the Gram matrix; −1 if it is not certain.
template <int N, class T>
double root_of_determinant(const EdgeInverse<N, T>& e) {
  const std::size_t n = e.n;
  const auto dn = static_cast<double>(n);
  auto a = e.matrix;
  double largest = 0, norm = 0, product = 1, powers = 0;
  for (std::size_t i = 0; i < n * n; ++i) largest = std::max(largest, std::fabs(high_of(a[i])));
  for (std::size_t i = 0; i < n; ++i) {
    norm = std::max(norm, e.row_sum[i]);
    powers -= std::log2(e.edge_scale[i]) + (e.is_square() ? std::log2(e.axis_scale[i]) : 0);
  }
  for (std::size_t s = 0; s < n; ++s) {
    std::size_t pivot = s;
    for (std::size_t r = s + 1; r < n; ++r)
      if (std::fabs(high_of(a[r * n + s])) > std::fabs(high_of(a[pivot * n + s]))) pivot = r;
    if (pivot != s)
      for (std::size_t c = s; c < n; ++c) std::swap(a[pivot * n + c], a[s * n + c]);
    const double p = std::fabs(high_of(a[s * n + s]));
    if (!(p > 1e-30)) return -1;
    product *= p;
    if (!(product > 1e-290 && product < 1e290)) return -1;
    for (std::size_t r = s + 1; r < n; ++r) {
      const T factor = quotient(a[r * n + s], a[s * n + s]);
      for (std::size_t c = s + 1; c < n; ++c) {
        a[r * n + c] = a[r * n + c] - factor * a[s * n + c];
        largest = std::max(largest, std::fabs(high_of(a[r * n + c])));
      }
    }
  }
  const double beta =
      2.1 * norm * dn * e.epsilon * (5 * dn * largest + 1.02 * e.input_error * e.largest_entry);
  if (!(2 * beta <= enough)) return -1;
  // det M is det A times scales, or det G times their squares.
  return std::pow(product, (e.is_square() ? 2 : 1) / dn) * std::exp2(2 * powers / dn);
}

/// The Gram matrix of the edges from the first vertex, in integers.
struct IntegerGram {
  std::size_t n;
  std::vector<Integer> gram;

  IntegerGram(const double* const* points, std::size_t corners, std::size_t d)
      : n(corners - 1), gram(solve::IntegerEdges({points, corners}, {}, d).gram()) {}

  /// From vertex i+1 to vertex m+1, or to the first one if i = m.
  Integer square_of_edge(std::size_t i, std::size_t m) const {
    const Integer& own = gram[i * n + i];
    return m == i ? own : Integer(own + gram[m * n + m] - 2 * gram[i * n + m]);
  }
};

/// Whether a number, and quotients of two of them, are far from both ends of the range of doubles.
bool is_moderate(double x) { return x > 1e-145 && x < 1e145; }

/// det G, and adj G in place of G: elimination without fractions in place, all entries of which are minors
/// (Bareiss 1968, doi:10.1090/S0025-5718-1968-0226829-0). No pivot is 0, as G is positive definite.
Integer make_adjugate(std::vector<Integer>& a, std::size_t n) {
  Integer previous = 1;
  for (std::size_t s = 0; s < n; ++s) {
    const Integer pivot = a[s * n + s];
    for (std::size_t r = 0; r < n; ++r) {
      if (r == s) continue;
      cancellation_point();
      const Integer factor = a[r * n + s];
      for (std::size_t c = 0; c < n; ++c)
        if (c != s) a[r * n + c] = (a[r * n + c] * pivot - factor * a[s * n + c]) / previous;
      a[r * n + s] = -factor;
    }
    a[s * n + s] = previous;
    previous = pivot;
  }
  return previous;
}

/// The square of the radius is this over 4·det G squared units: bᵀ(adj G)b for the squared lengths b of the
/// edges from the first vertex.
Integer square_of_radius(const IntegerGram& e, const std::vector<Integer>& adjugate) {
  Integer square = 0;
  for (std::size_t i = 0; i < e.n; ++i) {
    Integer row = 0;
    for (std::size_t j = 0; j < e.n; ++j) row += adjugate[i * e.n + j] * e.gram[j * e.n + j];
    square += e.gram[i * e.n + i] * row;
  }
  return square;
}

/// k over the sum of radius/h over the heights h, each of which is at least ½: 1/h² = c/det G for an entry c
/// of adj G. Summed in units of 2^60, so that the sum is beyond the range of doubles only where the ratio is
/// below all of them.
double exact_radius_ratio(const double* const* points, std::size_t corners, std::size_t d) {
  const IntegerGram e(points, corners, d);
  std::vector<Integer> adjugate = e.gram;
  const Integer determinant = make_adjugate(adjugate, e.n), square = square_of_radius(e, adjugate),
                denominator = 4 * determinant * determinant;
  constexpr int exponent = 60;
  double sum = 0;
  for (std::size_t i = 0; i < e.n; ++i)
    sum += kernel::root_above(square * adjugate[i * e.n + i], denominator, -exponent);
  Integer first = 0;
  for (const Integer& entry : adjugate) first += entry;
  sum += kernel::root_above(square * first, denominator, -exponent);
  return std::min(1.0, std::ldexp(static_cast<double>(e.n) / sum, -exponent));
}

double exact_radius_edge_ratio(const double* const* points, std::size_t corners, std::size_t d) {
  const IntegerGram e(points, corners, d);
  Integer shortest = e.gram[0];
  for (std::size_t i = 0; i < e.n; ++i)
    for (std::size_t m = 0; m <= i; ++m) shortest = std::min(shortest, e.square_of_edge(i, m));
  std::vector<Integer> adjugate = e.gram;
  const Integer determinant = make_adjugate(adjugate, e.n), square = square_of_radius(e, adjugate);
  return kernel::root_above(square, 4 * determinant * shortest, 0);
}

double exact_mean_ratio(const double* const* points, std::size_t corners, std::size_t d) {
  const IntegerGram e(points, corners, d);
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

double radius_ratio(const double* const* points, std::size_t corners, std::size_t dimension, double radius,
                    ShapeStage* stage) {
  const auto exact = [&] { return exact_radius_ratio(points, corners, dimension); };
  if (!is_moderate(radius)) {
    if (stage != nullptr) *stage = ShapeStage::integers;
    return exact();
  }
  const auto from_inverse = [&](const auto& e) {
    const double sum = e.is_square() ? sum_of_gradients(e) : sum_of_gram_roots(e);
    return sum > 0 ? std::min(1.0, static_cast<double>(e.n) / (sum * radius)) : -1.0;
  };
  return by_stages(points, corners, dimension, stage, from_inverse, exact);
}

double mean_ratio(const double* const* points, std::size_t corners, std::size_t dimension,
                  ShapeStage* stage) {
  const auto from_inverse = [&](const auto& e) {
    const auto n = static_cast<double>(e.n);
    const double root = root_of_determinant(e);
    if (!(root >= 0)) return -1.0;
    double squares = 0;
    for (std::size_t i = 0; i < corners; ++i)
      for (std::size_t m = 0; m < i; ++m)
        for (std::size_t j = 0; j < dimension; ++j) {
          const double difference = points[i][j] - points[m][j];
          squares += difference * difference;
        }
    return std::min(1.0, n * (n + 1) * std::pow(n + 1, -1 / n) * root / squares);
  };
  return by_stages(points, corners, dimension, stage, from_inverse,
                   [&] { return exact_mean_ratio(points, corners, dimension); });
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
