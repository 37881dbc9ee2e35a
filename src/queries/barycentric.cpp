// SPDX-License-Identifier: BSD-3-Clause
#include "queries/barycentric.hpp"

#include "kernel/barycentric.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace delone::queries {
void barycentric(std::span<const double* const> points, std::span<const unsigned char> on_face,
                 std::span<const int> axes, const double* q, std::vector<double>& weights) {
  // If no coordinate is off by more than ε, the sum of all n+1 is off by at most (n+1)·ε, and their quotients
  // by the sum are off by less than (n+3)·ε.
  const double error = largest_weight_error / static_cast<double>(axes.size() + 3);
  if (!(kernel::certified_barycentric(points, axes, q, weights) <= error)) {
    const kernel::Fractions exact = kernel::exact_barycentric(points, axes, q);
    weights.clear();
    for (const kernel::Integer& numerator : exact.numerators)
      weights.push_back(kernel::nearest_double(numerator, exact.denominator, 0));
  }
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
  const int exponent = kernel::exponent_to_a_quarter(largest);
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

}  // namespace delone::queries
