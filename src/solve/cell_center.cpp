// SPDX-License-Identifier: BSD-3-Clause
#include "solve/cell_center.hpp"

#include "kernel/box_corners.hpp"
#include "solve/integer_edges.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace delone::solve {

CenterFinder::CenterFinder(int dimension, std::vector<int> axes, bool aligned)
    : dimension_(static_cast<std::size_t>(dimension)), axes_(std::move(axes)), aligned_(aligned) {}

void CenterFinder::find(const double* const* points, const double* weights, double* center) {
  if (aligned_) {
    for (std::size_t j = 0; j < dimension_; ++j) center[j] = points[0][j] + 0.0;
    if (find_center(axes_, points, weights, center)) return;
  }
  if (is_center_of_box(points, weights, center)) return;
  ++num_exact_;
  find_exactly(points, weights, center);
}

void CenterFinder::find_block(std::size_t count, const double* const* points, const double* weights,
                              double* centers) {
  const std::size_t d = dimension_, k = axes_.size();
  if (!aligned_ || k != d || k < least_center_lanes || k > most_center_lanes) {
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
    // For k ≤ 3 one lane computes the same. For larger k it exchanges rows and may succeed.
    if (k > 3 && find_center(axes_, points + cell * (k + 1), of_cell, center)) continue;
    if (is_center_of_box(points + cell * (k + 1), of_cell, center)) continue;
    ++num_exact_;
    find_exactly(points + cell * (k + 1), of_cell, center);
  }
}

/// Sets the center if the points are corners of a box that they span.
bool CenterFinder::is_center_of_box(const double* const* points, const double* weights,
                                    double* center) const {
  return weights == nullptr && axes_.size() == dimension_ &&
         kernel::find_center_of_box(static_cast<int>(dimension_), points, static_cast<int>(dimension_) + 1,
                                    center);
}

void CenterFinder::find_offset(const double* const* points, double* offset) const {
  std::fill_n(offset, dimension_, 0.0);
  if (aligned_ && find_center_offset(axes_, points, offset)) return;
  const ExactOffset exact = find_offset_exactly(points);
  for (std::size_t j = 0; j < dimension_; ++j)
    offset[j] = kernel::nearest_double(exact.twice.numerators[j], exact.twice.denominator, exact.grid - 1);
}

CenterFinder::ExactOffset CenterFinder::find_offset_exactly(const double* const* points) const {
  const std::size_t k = axes_.size();
  const IntegerEdges integers({points, k + 1}, {}, dimension_);
  return {integers.twice_center(k), integers.grid};
}

void CenterFinder::find_exactly(const double* const* points, const double* weights, double* center) const {
  const std::size_t k = axes_.size();
  const IntegerEdges integers({points, k + 1}, {weights, weights == nullptr ? 0 : k + 1}, dimension_);
  const kernel::Fractions z = integers.twice_center(k);
  const kernel::Integer denominator = z.denominator * 2;
  for (std::size_t j = 0; j < dimension_; ++j)
    center[j] = kernel::nearest_double(
        kernel::scaled_integer(points[0][j], integers.grid) * denominator + z.numerators[j], denominator,
        integers.grid);
}

bool CenterFinder::on_sphere(const double* const* points, const double* weights, const double* q,
                             double weight_of_q) const {
  const std::size_t k = axes_.size();
  std::vector<const double*> all(points, points + k + 1);
  all.push_back(q);
  std::vector<double> all_weights;
  if (weights != nullptr) {
    all_weights.assign(weights, weights + k + 1);
    all_weights.push_back(weight_of_q);
  }
  const IntegerEdges integers(all, all_weights, dimension_);
  const kernel::Fractions z = integers.twice_center(k);
  kernel::Integer dot = 0;
  for (std::size_t j = 0; j < dimension_; ++j) dot += integers.edges[k * dimension_ + j] * z.numerators[j];
  return dot == integers.rights[k] * z.denominator;
}

}  // namespace delone::solve
