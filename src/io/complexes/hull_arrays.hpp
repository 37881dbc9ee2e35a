// SPDX-License-Identifier: BSD-3-Clause
// The arrays of a hull in a file, by name: what write_hull writes and read_hull reads (docs/formats.md).
#pragma once

#include <delone/convex_hull.hpp>

#include <algorithm>
#include <cstddef>
#include <initializer_list>

namespace delone::io {

/// The array that complexes do not have: what tells a hull from a triangulation.
inline constexpr const char* hull_mark = "facet_of_cell";

/// Calls visit(name, items, shape) for every array, in the order of docs/formats.md. `kinds` are those of the
/// points as numbers.
template <class Data, class Kinds, class Visit>
void for_each_array(Data& data, Kinds& kinds, Visit visit) {
  using Shape = std::initializer_list<std::size_t>;
  const auto d = static_cast<std::size_t>(data.dimension),
             k = static_cast<std::size_t>(std::max(data.affine_dimension, 0));
  visit("points", data.points, Shape{data.num_points(), d});
  visit("cells", data.cells, Shape{data.num_cells(), k});
  visit("neighbors", data.neighbors, Shape{data.num_cells(), k});
  visit(hull_mark, data.facet_of_cell, Shape{data.num_cells()});
  visit("facet_offsets", data.facet_offsets, Shape{data.facet_offsets.size()});
  visit("facet_vertices", data.facet_vertices, Shape{data.facet_vertices.size()});
  visit("equations", data.equations, Shape{data.num_facets(), d + 1});
  visit("equation_errors", data.equation_errors, Shape{data.num_facets()});
  visit("ridge_facets", data.ridge_facets, Shape{data.num_ridges(), 2});
  visit("ridge_offsets", data.ridge_offsets, Shape{data.ridge_offsets.size()});
  visit("ridge_vertices", data.ridge_vertices, Shape{data.ridge_vertices.size()});
  visit("vertices", data.vertices, Shape{data.vertices.size()});
  visit("vertex_of_point", data.vertex_of_point, Shape{data.num_points()});
  visit("point_kinds", kinds, Shape{data.num_points()});
}

}  // namespace delone::io
