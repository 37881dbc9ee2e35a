// SPDX-License-Identifier: BSD-3-Clause
// Right results small enough to be written down by hand, one of each kind.
#pragma once

#include <delone/data.hpp>

#include <cmath>

namespace delone::test {

/// A square of side 2, its center (row 4) and four cells around that.
inline ComplexData small_triangulation() {
  ComplexData data;
  data.dimension = data.affine_dimension = 2;
  data.points = {0, 0, 2, 0, 2, 2, 0, 2, 1, 1};
  data.cells = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
  data.neighbors = {1, 3, -1, 2, 0, -1, 3, 1, -1, 0, 2, -1};
  data.vertex_of_point = {0, 1, 2, 3, 4};
  return data;
}

/// A triangle, a point inside it, one on its first edge, and one that is its first corner again.
inline HullData small_hull() {
  HullData data;
  data.dimension = data.affine_dimension = 2;
  data.points = {0, 0, 4, 0, 0, 4, 1, 1, 2, 0, 0, 0};
  data.cells = {0, 1, 1, 2, 2, 0};
  data.neighbors = {1, 2, 2, 0, 0, 1};
  data.facet_of_cell = {0, 1, 2};
  data.facet_offsets = {0, 2, 4, 6};
  data.facet_vertices = {0, 1, 1, 2, 0, 2};
  data.equations = {0, -1, 0, std::sqrt(0.5), std::sqrt(0.5), -4 * std::sqrt(0.5), -1, 0, 0};
  data.equation_errors = {1e-15, 1e-14, 1e-15};
  data.ridge_facets = {0, 2, 0, 1, 1, 2};
  data.ridge_offsets = {0, 1, 2, 3};
  data.ridge_vertices = {0, 1, 2};
  data.vertices = {0, 1, 2};
  data.vertex_of_point = {0, 1, 2, 3, 4, 0};
  data.point_kinds = {PointKind::extreme,  PointKind::extreme,  PointKind::extreme,
                      PointKind::interior, PointKind::boundary, PointKind::duplicate};
  return data;
}

/// 0 ≤ x ≤ 1, and x ≤ 2, which is redundant.
inline IntersectionData small_intersection() {
  IntersectionData data;
  data.dimension = data.rank = 1;
  data.halfspaces = {1, -1, -1, 0, 1, -2};
  data.first_of_halfspace = {0, 1, 2};
  data.interior_point = {0.5};
  data.bounded = true;
  data.axes = {0};
  data.vertices = {0, 1};
  data.vertex_offsets = {0, 1, 2};
  data.vertex_halfspaces = {1, 0};
  data.direction_offsets = {0};
  data.edges = {0, 1};
  data.facet_halfspaces = {0, 1};
  data.facet_offsets = {0, 1, 2};
  data.facet_vertices = {1, 0};
  data.facet_direction_offsets = {0, 0, 0};
  data.kinds = {HalfspaceKind::facet, HalfspaceKind::facet, HalfspaceKind::redundant};
  data.dual_points = {2, -2, 1 / 1.5};
  data.dual_equations = {-1, -2, 1, -2};
  return data;
}

/// The sites 0, 2 and 6 on a line.
inline VoronoiData small_diagram() {
  VoronoiData data;
  data.dimension = data.affine_dimension = 1;
  data.points = {0, 2, 6};
  data.vertices = {1, 4};
  data.ridge_points = {0, 1, 1, 2};
  data.ridge_vertices = {0, 1};
  data.ridge_offsets = {0, 1, 2};
  data.region_vertices = {-1, 0, 0, 1, -1, 1};
  data.region_offsets = {0, 2, 4, 6};
  data.point_region = {0, 1, 2};
  data.ray_vertices = {0, 1};
  data.ray_points = {0, 2};
  data.ray_directions = {-1, 1};
  return data;
}

}  // namespace delone::test
