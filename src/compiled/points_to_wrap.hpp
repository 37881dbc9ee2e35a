// SPDX-License-Identifier: BSD-3-Clause
// What wrapping asks of points (engine/wrap/wrap.hpp): what is beyond facets; and a point in one cell, as
// part of the proof. Cells that are right across every facet may still go around a vertex twice. Then they
// cover all of space more than once, so one point tells (docs/predicates.md, "Wrapping").
#pragma once

#include "compiled/triangulation_engine.hpp"
#include "engine/cell_store.hpp"
#include "geometry/delaunay_geometry.hpp"
#include "geometry/facet_search/facet_search.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace delone::compiled {

/// Whether a point is inside exactly one of the given finite cells, oriented either way, and on the boundary
/// of none. Exact. REQUIRES that vertices are wide.
template <int K>
bool is_in_one_of(std::span<const Index> finite_cells, const engine::CellStore<K>& cells,
                  const geometry::DelaunayGeometry<K>& geometry, const VertexPoints& points,
                  const double* point) {
  const kernel::Grid grid = points.grid_with(point);
  const auto q = geometry.make_query(point, grid);
  int containing = 0;
  for (const Index cell : finite_cells) {
    const Index* const vertices = cells.wide_vertices(cell);
    const Sign first = geometry.side_of_facet(vertices, 0, q);
    Sign side = first;
    for (int i = 1; i <= cells.dimension() && side == first && side != Sign::zero; ++i)
      side = geometry.side_of_facet(vertices, i, q);
    if (side == Sign::zero) return false;
    containing += side == first ? 1 : 0;
  }
  return containing == 1;
}

/// A point that is inside one finite cell, and inside or on the boundary of no other: of proposed cells,
/// which may be oriented either way. It lies between a vertex with the least of all coordinates along an axis
/// and all other vertices, so that only cells of that vertex can contain it. Nothing where no such point is
/// found. REQUIRES that all slots are cells, and vertices wide. Cost O(k·(cells + vertices)) and few exact
/// predicates.
template <int K>
std::optional<std::vector<double>> find_point_in_one_cell(const engine::CellStore<K>& cells,
                                                          const geometry::DelaunayGeometry<K>& geometry,
                                                          const VertexPoints& points) {
  const int k = cells.dimension();
  for (int axis = 0; axis < points.ambient; ++axis) {
    const auto coordinate = [&](Index v) { return points.point(v)[axis]; };
    Index first = 1;
    for (Index v = 2; v <= points.last_vertex(); ++v)
      if (coordinate(v) < coordinate(first)) first = v;
    double second = std::numeric_limits<double>::infinity();
    for (Index v = 1; v <= points.last_vertex(); ++v)
      if (v != first) second = std::min(second, coordinate(v));
    std::vector<Index> around;
    for (Index cell = 0; cell < cells.num_slots(); ++cell) {
      const Index* v = cells.wide_vertices(cell);
      if (std::find(v, v + k + 1, first) != v + k + 1 && cells.infinite_slot(cell) < 0)
        around.push_back(cell);
    }
    if (around.empty()) return std::nullopt;
    const Index* v = cells.wide_vertices(around.front());
    std::vector<double> inside(static_cast<std::size_t>(points.ambient));
    for (std::size_t j = 0; j < inside.size(); ++j)
      for (int i = 0; i <= k; ++i) inside[j] += points.point(v[i])[j] / (k + 1);
    const double step =
        (second - coordinate(first)) / 2 / (inside[static_cast<std::size_t>(axis)] - coordinate(first));
    for (std::size_t j = 0; j < inside.size(); ++j)
      inside[j] = points.point(first)[j] + step * (inside[j] - points.point(first)[j]);
    const double at = inside[static_cast<std::size_t>(axis)];
    if (!(coordinate(first) < at && at < second)) continue;
    if (!is_in_one_of<K>(around, cells, geometry, points, inside.data())) return std::nullopt;
    return inside;
  }
  return std::nullopt;
}

/// The points of all vertices, of full dimension, neither weighted nor sought for what is furthest.
template <int K>
class PointsToWrap {
  using Geometry = geometry::DelaunayGeometry<K>;

 public:
  PointsToWrap(const VertexPoints& points, const engine::CellStore<K>& cells, Geometry& geometry)
      : points_(points), cells_(cells), geometry_(geometry) {}

  Index last_vertex() const { return points_.last_vertex(); }
  geometry::FacetSearch search() {
    geometry_.keep_rows(last_vertex());
    return {K, geometry_.kept_rows(), last_vertex(),
            [this](const Index* cell, int slot, std::span<const Index> vertices) {
              return geometry_.first_beyond(cell, slot, vertices, points_.grid);
            }};
  }
  Geometry geometry_of(cells::CellMemory<K>& memory) const {
    Geometry geometry(memory, geometry_.axes(), points_.ambient, points_.coordinates, points_.grid,
                      geometry_.frame());
    geometry.keep_rows(last_vertex());
    return geometry;
  }
  /// Valid as long as this object.
  std::optional<typename Geometry::Query> query_in_one_cell(const Geometry& geometry) {
    const auto point = find_point_in_one_cell(cells_, geometry_, points_);
    if (!point) return std::nullopt;
    point_ = *point;
    grid_ = points_.grid_with(point_.data());
    return geometry.make_query(point_.data(), grid_);
  }

 private:
  const VertexPoints& points_;
  const engine::CellStore<K>& cells_;
  Geometry& geometry_;
  std::vector<double> point_;
  kernel::Grid grid_ = points_.grid;
};

}  // namespace delone::compiled
