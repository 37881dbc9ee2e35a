// SPDX-License-Identifier: BSD-3-Clause
// The arrays of an intersection of halfspaces in a file, by name: what write_halfspaces writes and
// read_halfspaces reads (docs/formats.md).
#pragma once

#include <delone/halfspaces.hpp>

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

namespace delone::io {

/// The array that other files do not have: what tells an intersection from them.
inline constexpr const char* intersection_mark = "first_of_halfspace";

/// In json; numbers 0 to 2 in npz.
inline constexpr std::array<const char*, 3> state_names{"full", "flat", "empty"};

/// Calls visit(name, items, shape) for every array, in the order of docs/formats.md. `axes` and `kinds` are
/// those of the data as SignedIndex.
template <class Data, class Indices, class Visit>
void for_each_array(Data& data, Indices& axes, Indices& kinds, Visit visit) {
  using Shape = std::initializer_list<std::size_t>;
  const auto d = static_cast<std::size_t>(data.dimension), m = data.num_halfspaces();
  visit("halfspaces", data.halfspaces, Shape{m, d + 1});
  visit(intersection_mark, data.first_of_halfspace, Shape{m});
  visit("kinds", kinds, Shape{kinds.size()});
  visit("witness", data.witness, Shape{data.witness.size()});
  visit("interior_point", data.interior_point, Shape{data.interior_point.size()});
  visit("axes", axes, Shape{axes.size()});
  visit("vertices", data.vertices, Shape{data.num_vertices(), d});
  visit("vertex_offsets", data.vertex_offsets, Shape{data.vertex_offsets.size()});
  visit("vertex_halfspaces", data.vertex_halfspaces, Shape{data.vertex_halfspaces.size()});
  visit("directions", data.directions, Shape{data.num_directions(), d});
  visit("direction_offsets", data.direction_offsets, Shape{data.direction_offsets.size()});
  visit("direction_halfspaces", data.direction_halfspaces, Shape{data.direction_halfspaces.size()});
  visit("edges", data.edges, Shape{data.num_edges(), 2});
  visit("rays", data.rays, Shape{data.num_rays(), 2});
  visit("facet_halfspaces", data.facet_halfspaces, Shape{data.num_facets()});
  visit("facet_offsets", data.facet_offsets, Shape{data.facet_offsets.size()});
  visit("facet_vertices", data.facet_vertices, Shape{data.facet_vertices.size()});
  visit("facet_direction_offsets", data.facet_direction_offsets, Shape{data.facet_direction_offsets.size()});
  visit("facet_directions", data.facet_directions, Shape{data.facet_directions.size()});
  visit("lineality", data.lineality, Shape{data.lineality.size() / d, d});
  visit("dual_points", data.dual_points, Shape{data.dual_points.size() / d, d});
  visit("dual_equations", data.dual_equations, Shape{data.dual_equations.size() / (d + 1), d + 1});
}

/// `format`: npz or json.
IntersectionData read_intersection_in(const std::string& format, std::string_view bytes,
                                      const std::string& name);

}  // namespace delone::io
