// SPDX-License-Identifier: BSD-3-Clause
// The arrays of each kind of data in files, by name (docs/formats.md): the one table that writing, reading
// and the checks of shapes share.
#pragma once

#include <delone/data.hpp>
#include <delone/export.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <type_traits>
#include <vector>

namespace delone::io {

struct Array {
  const char* name;
  bool required = true;              ///< otherwise it may be left out, and is empty then
  bool finite = false;               ///< whether a file with NaN or infinities in it is refused
  const char* other_name = nullptr;  ///< taken where there is no member of the first name
};

/// A list of lists: offsets into an array of items. `nested`: the name of the member that holds it in JSON,
/// as an array of arrays; null where JSON has the two arrays, too.
struct Lists {
  const char *offsets, *items, *nested = nullptr;
};

/// What json calls the states of an intersection; npz has the numbers 0 to 2.
inline constexpr const char* state_names[] = {"full", "flat", "empty"};

/// The least and the largest number that stands for an item of an array of this type.
template <class T>
DELONE_HIDDEN inline constexpr auto least_number = static_cast<std::int64_t>(std::numeric_limits<T>::min());
template <class T>
DELONE_HIDDEN inline constexpr auto largest_number = static_cast<std::int64_t>(std::numeric_limits<T>::max());
template <>
DELONE_HIDDEN inline constexpr std::int64_t largest_number<PointKind> =
    static_cast<std::int64_t>(PointKind::duplicate);
template <>
DELONE_HIDDEN inline constexpr std::int64_t largest_number<HalfspaceKind> =
    static_cast<std::int64_t>(HalfspaceKind::trivial);

/// Whether data of this type may be of this kind.
template <PlainData Data>
DELONE_HIDDEN constexpr bool fits(DataKind kind) {
  if constexpr (std::same_as<Data, ComplexData>)
    return kind <= DataKind::hull_boundary;
  else if constexpr (std::same_as<Data, VoronoiData>)
    return kind == DataKind::unknown || kind >= DataKind::voronoi;
  else
    return kind == Data::kind;
}

/// `Data`, or const Data.
template <class MaybeConst, class Data>
concept SameData = std::same_as<std::remove_const_t<MaybeConst>, Data>;

// Each for_each_array() calls visit(array, items, shape) for every array and visit.lists(lists, offsets,
// items) for every list of lists. Shapes are those that the sizes of the other arrays require. Data that are
// const are written, others read.

/// One number, left out of exact data.
template <class Data, class Visitor>
void visit_tolerance(Data& data, Visitor&& visit) {
  std::vector<double> tolerance(data.tolerance == 0 ? 0 : 1, data.tolerance);
  if (!std::is_const_v<Data> || !tolerance.empty())
    visit(Array{.name = "tolerance", .required = false, .finite = true}, tolerance, {tolerance.size()});
  if constexpr (!std::is_const_v<Data>) data.tolerance = tolerance.empty() ? 0 : tolerance[0];
}

/// One number for each axis, left out where all are the same.
template <class Data, class Visitor>
void visit_axis_tolerances(Data& data, Visitor&& visit) {
  if (!std::is_const_v<Data> || !data.axis_tolerances.empty())
    visit(Array{.name = "axis_tolerances", .required = false, .finite = true}, data.axis_tolerances,
          {static_cast<std::size_t>(data.dimension)});
}

template <SameData<ComplexData> Data, class Visitor>
void for_each_array(Data& data, Visitor&& visit) {
  const auto d = static_cast<std::size_t>(data.dimension),
             corners = static_cast<std::size_t>(data.affine_dimension + 1);
  visit(Array{.name = "points", .finite = true}, data.points, {data.num_points(), d});
  visit(Array{.name = "cells", .other_name = "simplices"}, data.cells, {data.num_cells(), corners});
  visit(Array{.name = "neighbors", .required = false}, data.neighbors, {data.num_cells(), corners});
  visit(Array{.name = "vertex_of_point", .required = false}, data.vertex_of_point, {data.num_points()});
  if (!std::is_const_v<Data> || !data.weights.empty())
    visit(Array{.name = "weights", .required = false, .finite = true}, data.weights, {data.num_points()});
  visit_tolerance(data, visit);
  if (!data.is_periodic()) return;
  visit(Array{.name = "lattice", .required = false, .finite = true}, data.lattice, {data.rank(), d});
  const std::size_t r = data.rank();
  visit(Array{.name = "cell_offsets", .required = false}, data.cell_offsets, {data.num_cells(), corners * r});
  visit(Array{.name = "neighbor_offsets", .required = false}, data.neighbor_offsets,
        {data.num_cells(), corners * r});
  visit(Array{.name = "point_offsets", .required = false}, data.point_offsets, {data.num_points(), r});
  std::vector<double> unit(data.unit == 0 ? 0 : 1, data.unit);
  if (!std::is_const_v<Data> || !unit.empty())
    visit(Array{.name = "unit", .required = false, .finite = true}, unit, {unit.size()});
  if constexpr (!std::is_const_v<Data>) data.unit = unit.empty() ? 0 : unit[0];
}

template <SameData<HullData> Data, class Visitor>
void for_each_array(Data& data, Visitor&& visit) {
  const auto d = static_cast<std::size_t>(data.dimension),
             k = static_cast<std::size_t>(std::max(data.affine_dimension, 0));
  visit(Array{.name = "points", .finite = true}, data.points, {data.num_points(), d});
  visit(Array{"cells"}, data.cells, {data.num_cells(), k});
  visit(Array{"neighbors"}, data.neighbors, {data.num_cells(), k});
  visit(Array{"facet_of_cell"}, data.facet_of_cell, {data.num_cells()});
  visit.lists(Lists{"facet_offsets", "facet_vertices"}, data.facet_offsets, data.facet_vertices);
  visit(Array{"equations"}, data.equations, {data.num_facets(), d + 1});
  visit(Array{"equation_errors"}, data.equation_errors, {data.num_facets()});
  visit(Array{"ridge_facets"}, data.ridge_facets, {data.num_ridges(), 2});
  visit.lists(Lists{"ridge_offsets", "ridge_vertices"}, data.ridge_offsets, data.ridge_vertices);
  visit(Array{"vertices"}, data.vertices, {data.vertices.size()});
  visit(Array{"vertex_of_point"}, data.vertex_of_point, {data.num_points()});
  visit(Array{"point_kinds"}, data.point_kinds, {data.num_points()});
  if (!std::is_const_v<Data> || !data.axes.empty())
    visit(Array{.name = "axes", .required = false}, data.axes, {k});
  if (std::is_const_v<Data> && data.tolerance == 0) return;
  std::vector<double> tolerance;
  if (data.tolerance > 0) tolerance = {data.tolerance, data.max_distance};
  visit(Array{.name = "tolerance", .required = false, .finite = true}, tolerance, {2});
  if constexpr (!std::is_const_v<Data>)
    if (tolerance.size() == 2) data.tolerance = tolerance[0], data.max_distance = tolerance[1];
  visit_axis_tolerances(data, visit);
}

template <SameData<IntersectionData> Data, class Visitor>
void for_each_array(Data& data, Visitor&& visit) {
  const auto d = static_cast<std::size_t>(data.dimension), m = data.num_halfspaces();
  visit(Array{.name = "halfspaces", .finite = true}, data.halfspaces, {m, d + 1});
  visit(Array{"first_of_halfspace"}, data.first_of_halfspace, {m});
  visit(Array{"kinds"}, data.kinds, {data.kinds.size()});
  visit(Array{"witness"}, data.witness, {data.witness.size()});
  visit(Array{"interior_point"}, data.interior_point, {data.interior_point.size()});
  visit(Array{"axes"}, data.axes, {data.axes.size()});
  visit(Array{"vertices"}, data.vertices, {data.num_vertices(), d});
  visit.lists(Lists{"vertex_offsets", "vertex_halfspaces"}, data.vertex_offsets, data.vertex_halfspaces);
  visit(Array{"directions"}, data.directions, {data.num_directions(), d});
  visit.lists(Lists{"direction_offsets", "direction_halfspaces"}, data.direction_offsets,
              data.direction_halfspaces);
  visit(Array{"edges"}, data.edges, {data.num_edges(), 2});
  visit(Array{"rays"}, data.rays, {data.num_rays(), 2});
  visit(Array{"facet_halfspaces"}, data.facet_halfspaces, {data.num_facets()});
  visit.lists(Lists{"facet_offsets", "facet_vertices"}, data.facet_offsets, data.facet_vertices);
  visit.lists(Lists{"facet_direction_offsets", "facet_directions"}, data.facet_direction_offsets,
              data.facet_directions);
  visit(Array{"lineality"}, data.lineality, {data.lineality.size() / d, d});
  visit(Array{"dual_points"}, data.dual_points, {data.dual_points.size() / d, d});
  visit(Array{"dual_equations"}, data.dual_equations, {data.dual_equations.size() / (d + 1), d + 1});
}

template <SameData<VoronoiData> Data, class Visitor>
void for_each_array(Data& data, Visitor&& visit) {
  const auto d = static_cast<std::size_t>(data.dimension),
             k = static_cast<std::size_t>(std::max(data.affine_dimension, 0));
  visit(Array{.name = "points", .finite = true}, data.points, {data.num_points(), d});
  if (!std::is_const_v<Data> || !data.weights.empty())
    visit(Array{.name = "weights", .required = false, .finite = true}, data.weights, {data.num_points()});
  visit(Array{"vertices"}, data.vertices, {data.num_vertices(), d});
  visit(Array{"ridge_points"}, data.ridge_points, {data.num_ridges(), 2});
  visit.lists(Lists{"ridge_offsets", "ridge_vertices", "ridge_vertices"}, data.ridge_offsets,
              data.ridge_vertices);
  visit.lists(Lists{"region_offsets", "region_vertices", "regions"}, data.region_offsets,
              data.region_vertices);
  visit(Array{"point_region"}, data.point_region, {data.num_points()});
  visit(Array{"ray_vertices"}, data.ray_vertices, {data.num_rays()});
  visit(Array{"ray_directions"}, data.ray_directions, {data.num_rays(), d});
  visit(Array{"ray_points"}, data.ray_points, {data.num_rays(), k});
  visit_tolerance(data, visit);
  visit_axis_tolerances(data, visit);
}

}  // namespace delone::io
