// SPDX-License-Identifier: BSD-3-Clause
// Plain data (delone/data.hpp) as dictionaries of arrays and back, with the names that files have
// (docs/formats.md).
#pragma once

#include "arrays.hpp"
#include "messages.hpp"
#include "messages/in_quotes.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <delone/data.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace delone::python {

/// What the data are called in Python.
template <PlainData Data>
constexpr const char* kind_of = std::is_same_v<Data, ComplexData>        ? "complex"
                                : std::is_same_v<Data, HullData>         ? "hull"
                                : std::is_same_v<Data, IntersectionData> ? "intersection"
                                                                         : "diagram";

// Each calls visit(name, array, columns) for every array, of one dimension if columns is 1 (of two, with one
// column, where the last argument says so), and visit(name, number) for every number.

template <class Data, class Visit>
requires std::same_as<std::remove_const_t<Data>, ComplexData>
void for_each_member(Data& data, Visit visit) {
  visit("dimension", data.dimension);
  visit("affine_dimension", data.affine_dimension);
  const auto d = static_cast<std::size_t>(data.dimension),
             corners = static_cast<std::size_t>(std::max(data.affine_dimension + 1, 0));
  visit("points", data.points, d, true);
  visit("cells", data.cells, corners, true);
  visit("neighbors", data.neighbors, corners, true);
  visit("vertex_of_point", data.vertex_of_point);
  visit("weights", data.weights);
  visit("tolerance", data.tolerance);
  visit("kind", data.kind);
  if (!data.is_periodic()) return;
  visit("lattice", data.lattice, d, true);
  visit("cell_offsets", data.cell_offsets, corners * data.rank(), true);
  visit("neighbor_offsets", data.neighbor_offsets, corners * data.rank(), true);
  visit("point_offsets", data.point_offsets, data.rank(), true);
  visit("unit", data.unit);
}

template <class Data, class Visit>
requires std::same_as<std::remove_const_t<Data>, HullData>
void for_each_member(Data& data, Visit visit) {
  visit("dimension", data.dimension);
  visit("affine_dimension", data.affine_dimension);
  const auto d = static_cast<std::size_t>(data.dimension),
             k = static_cast<std::size_t>(std::max(data.affine_dimension, 0));
  visit("points", data.points, d, true);
  visit("cells", data.cells, k, true);
  visit("neighbors", data.neighbors, k, true);
  visit("facet_of_cell", data.facet_of_cell);
  visit("facet_offsets", data.facet_offsets);
  visit("facet_vertices", data.facet_vertices);
  visit("equations", data.equations, d + 1, true);
  visit("equation_errors", data.equation_errors);
  visit("ridge_facets", data.ridge_facets, 2, true);
  visit("ridge_offsets", data.ridge_offsets);
  visit("ridge_vertices", data.ridge_vertices);
  visit("vertices", data.vertices);
  visit("vertex_of_point", data.vertex_of_point);
  visit("point_kinds", data.point_kinds);
  visit("axes", data.axes);
  visit("tolerance", data.tolerance);
  visit("max_distance", data.max_distance);
  visit("axis_tolerances", data.axis_tolerances);
  visit("kind", data.kind);
}

template <class Data, class Visit>
requires std::same_as<std::remove_const_t<Data>, IntersectionData>
void for_each_member(Data& data, Visit visit) {
  visit("dimension", data.dimension);
  visit("rank", data.rank);
  visit("state", data.state);
  visit("bounded", data.bounded);
  visit("interior_point_is_exact", data.interior_point_is_exact);
  const auto d = static_cast<std::size_t>(data.dimension);
  visit("halfspaces", data.halfspaces, d + 1, true);
  visit("first_of_halfspace", data.first_of_halfspace);
  visit("kinds", data.kinds);
  visit("witness", data.witness);
  visit("interior_point", data.interior_point);
  visit("axes", data.axes);
  visit("vertices", data.vertices, d, true);
  visit("vertex_offsets", data.vertex_offsets);
  visit("vertex_halfspaces", data.vertex_halfspaces);
  visit("directions", data.directions, d, true);
  visit("direction_offsets", data.direction_offsets);
  visit("direction_halfspaces", data.direction_halfspaces);
  visit("edges", data.edges, 2, true);
  visit("rays", data.rays, 2, true);
  visit("facet_halfspaces", data.facet_halfspaces);
  visit("facet_offsets", data.facet_offsets);
  visit("facet_vertices", data.facet_vertices);
  visit("facet_direction_offsets", data.facet_direction_offsets);
  visit("facet_directions", data.facet_directions);
  visit("lineality", data.lineality, d, true);
  visit("dual_points", data.dual_points, d, true);
  visit("dual_equations", data.dual_equations, d + 1, true);
  visit("kind", data.kind);
}

template <class Data, class Visit>
requires std::same_as<std::remove_const_t<Data>, VoronoiData>
void for_each_member(Data& data, Visit visit) {
  visit("dimension", data.dimension);
  visit("affine_dimension", data.affine_dimension);
  const auto d = static_cast<std::size_t>(data.dimension),
             k = static_cast<std::size_t>(std::max(data.affine_dimension, 0));
  visit("points", data.points, d, true);
  visit("weights", data.weights);
  visit("vertices", data.vertices, d, true);
  visit("ridge_points", data.ridge_points, 2, true);
  visit("ridge_vertices", data.ridge_vertices);
  visit("ridge_offsets", data.ridge_offsets);
  visit("region_vertices", data.region_vertices);
  visit("region_offsets", data.region_offsets);
  visit("point_region", data.point_region);
  visit("ray_vertices", data.ray_vertices);
  visit("ray_directions", data.ray_directions, d, true);
  visit("ray_points", data.ray_points, k, true);
  visit("tolerance", data.tolerance);
  visit("axis_tolerances", data.axis_tolerances);
  visit("kind", data.kind);
}

/// Puts members into a dictionary, as views of data that `owner` keeps alive.
template <class Data>
class ToDict {
 public:
  ToDict(py::dict& out, const std::shared_ptr<const Data>& owner) : out_(out), owner_(owner) {}

  template <class T>
  void operator()(const char* name, const std::vector<T>& items, std::size_t columns = 1,
                  bool is_table = false) const {
    using Shown = std::conditional_t<std::is_enum_v<T>, std::uint8_t, T>;
    static_assert(sizeof(Shown) == sizeof(T));
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(columns == 0 ? 0 : items.size() / columns)};
    if (is_table) shape.push_back(static_cast<py::ssize_t>(columns));
    out_[name] = view<Shown>({reinterpret_cast<const Shown*>(items.data()), items.size()}, shape, owner_);
  }
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(const char* name, Number number) const { out_[name] = number; }
  /// None if it is unknown.
  void operator()(const char* name, DataKind kind) const {
    out_[name] = kind == DataKind::unknown ? py::object(py::none()) : py::str(std::string(name_of(kind)));
  }
  void operator()(const char* name, IntersectionState state) const {
    constexpr const char* names[] = {"full", "flat", "empty"};
    out_[name] = names[static_cast<std::size_t>(state)];
  }

 private:
  py::dict& out_;
  const std::shared_ptr<const Data>& owner_;
};

/// (kind, members), for delone._data.
template <PlainData Data>
py::tuple to_python(Data&& data) {
  const auto owner = std::make_shared<const Data>(std::move(data));
  py::dict members;
  for_each_member(*owner, ToDict<Data>(members, owner));
  if constexpr (!std::is_same_v<Data, IntersectionData>)
    if (!owner->column_names.empty()) members["column_names"] = py::cast(owner->column_names);
  return py::make_tuple(kind_of<Data>, members);
}

/// Takes members from a dictionary; those that are missing or None stay empty. Raises ValueError, or
/// TypeError, naming the member.
class FromDict {
 public:
  explicit FromDict(const py::dict& from) : from_(from) {}

  template <class T>
  void operator()(const char* name, std::vector<T>& items, std::size_t columns = 1,
                  bool is_table = false) const {
    const py::object given = find(name);
    if (given.is_none()) return;
    py::array array;
    if constexpr (std::is_same_v<T, double>) {
      const auto numbers = as_doubles(given, name);
      items.assign(numbers.data(), numbers.data() + numbers.size());
      array = numbers;
    } else {
      array = py::array::ensure(given);
      if (!array || (array.dtype().kind() != 'i' && array.dtype().kind() != 'u' && array.size() > 0))
        throw py::type_error(std::string(name) + ": an array of integers");
      const auto numbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>(array);
      items.clear();  // offsets begin with an entry
      items.reserve(static_cast<std::size_t>(numbers.size()));
      for (py::ssize_t i = 0; i < numbers.size(); ++i) {
        const std::int64_t number = numbers.data()[i];
        if (number < least<T>() || number > largest<T>())
          throw py::value_error(std::string(name) + ": " + std::to_string(number) +
                                " is beyond the range of " + std::to_string(least<T>()) + " to " +
                                std::to_string(largest<T>()));
        items.push_back(static_cast<T>(number));
      }
    }
    const bool fits =
        items.empty() || (is_table ? array.ndim() == 2 && array.shape(1) == static_cast<py::ssize_t>(columns)
                                   : array.ndim() == 1);
    if (!fits)
      throw py::value_error(std::string(name) + ": an array of shape (" +
                            (is_table ? "…, " + std::to_string(columns) + ")" : std::string("…,)")) +
                            ", not " + shown(array.attr("shape")));
  }
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(const char* name, Number& number) const {
    if (const py::object given = find(name); !given.is_none()) number = given.cast<Number>();
  }
  void operator()(const char* name, DataKind& kind) const {
    const py::object given = find(name);
    if (given.is_none()) return;
    const auto text = given.cast<std::string>();
    const auto known = find_data_kind(text);
    if (!known)
      throw py::value_error(std::string(name) + ": " + messages::in_quotes(text) + " is no kind of data");
    kind = *known;
  }
  void operator()(const char*, const DataKind&) const {}  // of a type of one kind
  void operator()(const char* name, IntersectionState& state) const {
    const py::object given = find(name);
    if (given.is_none()) return;
    const auto text = given.cast<std::string>();
    state = text == "flat"    ? IntersectionState::flat
            : text == "empty" ? IntersectionState::empty
                              : IntersectionState::full;
  }

 private:
  template <class T>
  static constexpr std::int64_t least() {
    if constexpr (std::is_enum_v<T>)
      return 0;
    else
      return static_cast<std::int64_t>(std::numeric_limits<T>::min());
  }
  template <class T>
  static constexpr std::int64_t largest() {
    if constexpr (std::is_same_v<T, PointKind>)
      return static_cast<std::int64_t>(PointKind::duplicate);
    else if constexpr (std::is_same_v<T, HalfspaceKind>)
      return static_cast<std::int64_t>(HalfspaceKind::trivial);
    else
      return static_cast<std::int64_t>(std::numeric_limits<T>::max());
  }
  py::object find(const char* name) const {
    return from_.contains(name) ? py::object(from_[name]) : py::object(py::none());
  }

  const py::dict& from_;
};

template <PlainData Data>
Data from_python(const py::dict& members) {
  Data data;
  for_each_member(data, FromDict(members));
  if constexpr (!std::is_same_v<Data, IntersectionData>)
    if (members.contains("column_names"))
      data.column_names = members["column_names"].template cast<std::vector<std::string>>();
  return data;
}

}  // namespace delone::python
