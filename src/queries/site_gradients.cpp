// SPDX-License-Identifier: BSD-3-Clause
// Least squares by the singular values of the weighted rows A = U·Σ·Vᵀ, from one-sided Jacobi rotations
// (Hestenes 1958, doi:10.1137/0106005). They are accurate for few columns, need no pivots, and give the
// solution of least length: for points of a flat it is tangent to the flat.
#include "queries/site_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace delone::queries {

std::size_t fit_gradients(std::span<const double> weights, std::span<const double> differences,
                          std::size_t columns, std::span<const double> rows, std::size_t d, double* result) {
  const std::size_t n = weights.size();
  std::vector<double> a(d * n), v(d * d, 0.0);  // by column
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < d; ++j) a[j * n + i] = std::sqrt(weights[i]) * rows[i * d + j];
  for (std::size_t j = 0; j < d; ++j) v[j * d + j] = 1;
  const auto dot = [](const double* x, const double* y, std::size_t count) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += x[i] * y[i];
    return sum;
  };
  const auto rotate = [](double* x, double* y, std::size_t count, double c, double s) {
    for (std::size_t i = 0; i < count; ++i) {
      const double old = x[i];
      x[i] = c * old - s * y[i];
      y[i] = s * old + c * y[i];
    }
  };
  bool rotated = d > 1;
  for (int sweep = 0; sweep < 40 && rotated; ++sweep) {
    rotated = false;
    for (std::size_t p = 0; p < d; ++p)
      for (std::size_t q = p + 1; q < d; ++q) {
        double *x = a.data() + p * n, *y = a.data() + q * n;
        const double xx = dot(x, x, n), yy = dot(y, y, n), xy = dot(x, y, n);
        if (!(std::fabs(xy) > 0x1p-50 * std::sqrt(xx) * std::sqrt(yy))) continue;
        rotated = true;
        const double zeta = (yy - xx) / (2 * xy);
        const double t = (zeta < 0 ? -1 : 1) / (std::fabs(zeta) + std::sqrt(1 + zeta * zeta));
        const double c = 1 / std::sqrt(1 + t * t);
        rotate(x, y, n, c, c * t);
        rotate(v.data() + p * d, v.data() + q * d, d, c, c * t);
      }
  }
  std::vector<double> squares(d);
  for (std::size_t j = 0; j < d; ++j) squares[j] = dot(a.data() + j * n, a.data() + j * n, n);
  const double largest = *std::max_element(squares.begin(), squares.end());
  std::fill_n(result, columns * d, 0.0);
  for (std::size_t j = 0; j < d; ++j) {
    if (!(squares[j] > 0x1p-80 * largest)) continue;
    for (std::size_t c = 0; c < columns; ++c) {
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i)
        sum += a[j * n + i] * std::sqrt(weights[i]) * differences[i * columns + c];
      for (std::size_t m = 0; m < d; ++m) result[c * d + m] += sum / squares[j] * v[j * d + m];
    }
  }
  return static_cast<std::size_t>(std::count_if(squares.begin(), squares.end(),
                                                [&](double square) { return square >= 0x1p-20 * largest; }));
}

namespace {

/// The neighbors of a vertex inside the hull without it, with their coordinates for it.
void find_coordinates(const NaturalCenters& centers, VertexId v, std::vector<VertexId>& neighbors,
                      std::vector<double>& weights) {
  NaturalSearch search(centers);
  search.find_among(neighbors, centers.point(v), false);
  neighbors = std::move(search.vertices);
  weights = std::move(search.weights);
}

/// Fits gradients to the differences from v, with the weights w/r², or 1/r⁴ if there are none. Returns as
/// fit_gradients().
std::size_t fit_to_neighbors(const NaturalCenters& centers, VertexId v, std::span<const double> values,
                             std::size_t columns, const std::vector<VertexId>& neighbors,
                             std::vector<double> weights, double* result) {
  const std::size_t d = centers.dimension();
  const double* const p = centers.point(v);
  // Distances in units of the largest one, a power of two.
  double largest = 0;
  for (const VertexId other : neighbors)
    for (std::size_t j = 0; j < d; ++j)
      largest = std::max(largest, std::fabs(centers.point(other)[j] - p[j]));
  const double unit = std::ldexp(1.0, std::ilogb(largest));
  const bool by_distance = weights.empty();
  weights.resize(neighbors.size(), 1.0);
  std::vector<double> rows, differences;
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    double square = 0;
    for (std::size_t j = 0; j < d; ++j) {
      rows.push_back((centers.point(neighbors[i])[j] - p[j]) / unit);
      square += rows.back() * rows.back();
    }
    weights[i] /= by_distance ? square * square : square;
    for (std::size_t c = 0; c < columns; ++c)
      differences.push_back(values[index(neighbors[i]) * columns + c] - values[index(v) * columns + c]);
  }
  const std::size_t directions = fit_gradients(weights, differences, columns, rows, d, result);
  for (std::size_t i = 0; i < columns * d; ++i) result[i] /= unit;
  return directions;
}

}  // namespace

void estimate_gradients(const NaturalCenters& centers, VertexId v, std::span<const double> values,
                        std::size_t columns, double* result) {
  const Complex& complex = centers.complex();
  const int k = complex.affine_dimension();
  if (k < 1) {
    std::fill_n(result, columns * centers.dimension(), 0.0);
    return;
  }
  const std::vector<VertexId> adjacent = complex.adjacent_vertices(v);
  const std::vector<CellId> star = complex.star(v);
  if (std::none_of(star.begin(), star.end(), [&](CellId c) { return complex.is_infinite(c); })) {
    std::vector<VertexId> neighbors = adjacent;
    std::vector<double> weights;
    find_coordinates(centers, v, neighbors, weights);
    // Under a sliver of the border all weight is on neighbors along it, which say nothing of other
    // directions.
    if (fit_to_neighbors(centers, v, values, columns, neighbors, weights, result) >=
        static_cast<std::size_t>(k))
      return;
  }
  fit_to_neighbors(centers, v, values, columns, adjacent, {}, result);
}

}  // namespace delone::queries
