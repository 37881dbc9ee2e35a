// SPDX-License-Identifier: BSD-3-Clause
#include "front_ends/landmarks.hpp"

#include <limits>

namespace delone {

Triangulation::Impl::Landmarks::Landmarks(int dimension) : sample_(dimension, kernel::RowForm::point, Options{}) {}

void Triangulation::Impl::Landmarks::add(Index vertex, std::span<const double> point) {
  vertex_of_row_.push_back(vertex);
  try {
    sample_.insert(point, 0.0, std::nullopt);
  } catch (...) {
    vertex_of_row_.pop_back();
    throw;
  }
}

void Triangulation::Impl::Landmarks::add(const std::vector<Index>& vertices, std::span<const double> points) {
  vertex_of_row_.insert(vertex_of_row_.end(), vertices.begin(), vertices.end());
  sample_.insert_range(points);
}

Index Triangulation::Impl::Landmarks::near(const double* point) const {
  if (vertex_of_row_.empty()) return invalid_index;
  if (!sample_.hull) return vertex_of_row_.front();
  const Complex cells = sample_.complex();
  const CellId cell{sample_.hull->descend(point, sample_.start_near(point))};
  Index nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= cells.dimension(); ++i) {
    const VertexId v = cells.vertex(cell, i);
    if (v == infinite_vertex) continue;
    const double* p = sample_.points.point(index(v));
    double square = 0;
    for (std::size_t j = 0; j < sample_.ambient(); ++j) square += (p[j] - point[j]) * (p[j] - point[j]);
    if (square < least || nearest == 0) {
      least = square;
      nearest = index(v);
    }
  }
  return vertex_of_row_[sample_.row_of_vertex[nearest]];
}

}  // namespace delone
