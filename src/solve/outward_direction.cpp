// SPDX-License-Identifier: BSD-3-Clause
#include "solve/outward_direction.hpp"

#include "solve/integer_edges.hpp"

#include <algorithm>
#include <cmath>

namespace delone::solve {
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
  const IntegerEdges integers(points, {}, d);
  const std::size_t m = facet.size() - 1;
  std::vector<kernel::Integer> right;
  for (std::size_t i = 0; i < m; ++i) right.push_back(integers.dot(i, m));
  const kernel::Fractions y = integers.solve_gram(right);
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

}  // namespace delone::solve
