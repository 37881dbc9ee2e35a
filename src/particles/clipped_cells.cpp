// SPDX-License-Identifier: BSD-3-Clause
#include "particles/clipped_cells.hpp"

#include "base/length.hpp"
#include "kernel/determinant.hpp"
#include "kernel/fractions.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace delone::particles {

/// Coordinates of the box are doubles, so rounding does not move a coordinate across them. Centers on a wall
/// are not inside, as a whole face may lie there, and is part of the wall. A value of a halfspace is off by
/// d·u for its products and sums, and u for the center.
bool is_inside(const double* center, std::size_t d, const Container& container) {
  for (std::size_t j = 0; j < d; ++j)
    if (!(center[j] > container.box.low[j] && center[j] < container.box.high[j])) return false;
  for (std::size_t i = 0; i < container.halfspaces.size(); i += d + 1) {
    const double* const row = container.halfspaces.data() + i;
    double value = row[d], size = std::abs(row[d]);
    for (std::size_t j = 0; j < d; ++j) {
      value += row[j] * center[j];
      size += std::abs(row[j] * center[j]);
    }
    constexpr double underflow = 1e-300;
    if (!(value < -1.01 * static_cast<double>(d + 2) * kernel::unit_roundoff * size - underflow))
      return false;
  }
  return true;
}

CellClipper::CellClipper(const sites::VertexPoints& points, const Container& container)
    : points_(points), container_(container), clipper_(container.box, false, container.halfspaces) {}

void CellClipper::clip(Index v, std::span<const Index> neighbors, bool proper, bool with_vertices) {
  const auto d = static_cast<std::size_t>(points_.ambient);
  const auto site_of = [&](Index w) {
    const double* const p = points_.point(w);
    return voronoi::RegionClipper::Site{p, points_.weighted() ? p[d] : 0};
  };
  others_.clear();
  for (const Index w : neighbors) others_.push_back(site_of(w));
  clipper_.clip(site_of(v), others_);
  measures_ = clipper_.measures();
  faces_.clear();
  vertices_.clear();
  if (!clipper_.has_interior(measures_.centroid)) {
    measures_ = {};
    return;
  }
  std::vector<Index> number;
  if (proper) {
    number = clipper_.exact_numbers();
  } else {
    number.resize(clipper_.corners().back() + 1);
    std::iota(number.begin(), number.end(), Index{0});
  }
  if (with_vertices) list_vertices(number);
  for (const auto& [of_facet, corners] : clipper_.facets(number, proper)) {
    const auto measured =
        std::find_if(measures_.facets.begin(), measures_.facets.end(),
                     [plane = of_facet](const auto& facet) { return facet.label == plane; });
    const std::size_t plane = clipper_.fixed_plane_of(of_facet);
    const bool is_wall = plane < clipper_.num_fixed_planes();
    ClippedFace& face = faces_.emplace_back(
        ClippedFace{is_wall ? ClippedFace::wall : clipper_.other_of(plane),
                    // Measures lack facets if all corners of the cell are one point after rounding.
                    measured == measures_.facets.end() ? 0 : measured->volume,
                    distance_of(plane, v, neighbors),
                    corners.size(),
                    {}});
    if (!with_vertices) continue;
    const std::vector<Index> in_order = d == 2 || d == 3 ? clipper_.ordered_facet(of_facet, number) : corners;
    face.vertices.assign(in_order.begin(), in_order.end());
    if (d == 3)
      std::rotate(face.vertices.begin(), std::min_element(face.vertices.begin(), face.vertices.end()),
                  face.vertices.end());
  }
}

void CellClipper::list_vertices(std::vector<Index>& number) {
  const auto d = static_cast<std::size_t>(points_.ambient);
  struct Vertex {
    std::vector<double> at;
    Index number;
  };
  std::vector<Vertex> vertices;
  std::vector<unsigned char> is_known(number.size(), 0);
  for (const auto corner : clipper_.corners()) {
    if (std::exchange(is_known[number[corner]], 1) != 0) continue;
    const auto exact = clipper_.exact_corner(corner);
    Vertex& vertex = vertices.emplace_back(Vertex{{}, number[corner]});
    for (std::size_t j = 0; j < d; ++j)
      vertex.at.push_back(kernel::nearest_double(exact.at.numerators[j], exact.at.denominator, exact.grid));
  }
  std::stable_sort(vertices.begin(), vertices.end(),
                   [](const Vertex& a, const Vertex& b) { return a.at < b.at; });
  std::vector<Index> place(number.size(), invalid_index);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    place[vertices[i].number] = static_cast<Index>(i);
    vertices_.insert(vertices_.end(), vertices[i].at.begin(), vertices[i].at.end());
  }
  for (Index& of_corner : number)
    if (of_corner < place.size()) of_corner = place[of_corner];
}

double CellClipper::distance_of(std::size_t plane, Index v, std::span<const Index> neighbors) const {
  const auto d = static_cast<std::size_t>(points_.ambient);
  const double* const p = points_.point(v);
  if (plane >= clipper_.num_fixed_planes()) {
    const double* const q = points_.point(neighbors[clipper_.other_of(plane)]);
    return internal::length_of(d, [&](std::size_t j) { return q[j] - p[j]; });
  }
  if (plane < 2 * d) {
    const double limit = plane % 2 == 0 ? container_.box.low[plane / 2] : container_.box.high[plane / 2];
    return std::abs(limit - p[plane / 2]);
  }
  const double* const row = container_.halfspaces.data() + (plane - 2 * d) * (d + 1);
  double value = row[d];
  for (std::size_t j = 0; j < d; ++j) value += row[j] * p[j];
  return std::abs(value) / internal::length_of(d, [&](std::size_t j) { return row[j]; });
}

}  // namespace delone::particles
