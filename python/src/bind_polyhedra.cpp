// SPDX-License-Identifier: BSD-3-Clause
// Binds delone.Polyhedron: its constructors and its properties. Operations are in
// bind_polyhedron_operations.cpp.
#include "arrays.hpp"
#include "docs_polyhedra.hpp"
#include "docstring.hpp"
#include "held_polyhedron.hpp"
#include "module.hpp"
#include "pickling.hpp"

#include <delone/polyhedron_io.hpp>

#include <pybind11/stl.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;

constexpr double infinite = std::numeric_limits<double>::infinity();

template <class Numbers>
py::array index_list(const Numbers& numbers) {
  return list_view(std::vector<SignedIndex>(numbers.begin(), numbers.end()));
}

/// A property for rows of integers as they are, or rounded. `extra`: entries beyond the coordinates.
template <RationalRows (Polyhedron::*Rows)() const, HeldPolyhedron::Array Which, std::size_t extra = 0>
py::object integers_of(const HeldPolyhedron& held) {
  return held.kept(Which, [&] {
    return integer_array(held.ask([](const Polyhedron& p) { return (p.*Rows)(); }), held.dimension() + extra);
  });
}
template <RationalRows (Polyhedron::*Rows)() const, HeldPolyhedron::Array Which, std::size_t extra = 0>
py::object doubles_of(const HeldPolyhedron& held) {
  return held.kept(Which, [&] {
    const RationalRows rows = held.ask([](const Polyhedron& p) { return (p.*Rows)(); });
    return scaled_double_array(rows, held.dimension() + extra, held.dimension());
  });
}

py::object rounded_vertices(const HeldPolyhedron& held) {
  return held.kept(HeldPolyhedron::vertices, [&] {
    return double_array(held.ask([](const Polyhedron& p) { return p.vertices(); }), held.dimension());
  });
}
py::object fractions_of_vertices(const HeldPolyhedron& held) {
  return held.kept(HeldPolyhedron::vertex_fractions, [&] {
    return fraction_array(held.ask([](const Polyhedron& p) { return p.vertices(); }), held.dimension());
  });
}

template <std::vector<std::pair<std::size_t, std::size_t>> (Polyhedron::*Pairs)() const,
          HeldPolyhedron::Array Which>
py::object pairs_of(const HeldPolyhedron& held) {
  return held.kept(Which, [&] {
    const auto pairs = held.ask([](const Polyhedron& p) { return (p.*Pairs)(); });
    std::vector<SignedIndex> numbers;
    numbers.reserve(2 * pairs.size());
    for (const auto& [first, second] : pairs)
      numbers.insert(numbers.end(), {static_cast<SignedIndex>(first), static_cast<SignedIndex>(second)});
    return rows_view(std::move(numbers), pairs.size(), 2);
  });
}

/// A question about one vertex, ray or facet. Numbers are signed here so that the message has negative ones.
template <std::vector<std::size_t> (Polyhedron::*List)(std::size_t) const>
auto list_at(const char* what) {
  return [what](const HeldPolyhedron& held, py::ssize_t number) {
    if (number < 0)
      throw Error(Errc::invalid_argument, "there is no " + std::string(what) + " " + std::to_string(number));
    return index_list((held.polyhedron().*List)(static_cast<std::size_t>(number)));
  };
}

py::array row_kinds(const HeldPolyhedron& held) {
  std::vector<std::uint8_t> kinds;
  for (const RowKind kind : held.kinds()) kinds.push_back(static_cast<std::uint8_t>(kind));
  return list_view(std::move(kinds));
}

/// As the library has them, from the kinds that a pickle keeps.
py::array redundant_rows(const HeldPolyhedron& held) {
  std::vector<SignedIndex> rows;
  const std::vector<RowKind>& kinds = held.kinds();
  for (std::size_t i = 0; i < kinds.size() && !held.polyhedron().is_empty(); ++i)
    if (kinds[i] == RowKind::duplicate || kinds[i] == RowKind::redundant)
      rows.push_back(static_cast<SignedIndex>(i));
  return list_view(std::move(rows));
}

double rounded_volume(const HeldPolyhedron& held) {
  const auto found = held.ask([](const Polyhedron& p) { return p.volume(); });
  return found ? found->to_double() : infinite;
}
py::object volume_fraction(const HeldPolyhedron& held) {
  const auto found = held.ask([](const Polyhedron& p) { return p.volume(); });
  return found ? to_fraction(*found) : py::none();
}

/// Lower and upper bounds, which to_object() makes objects of; infinities where there are none.
template <class ToObject>
py::object box_array(const std::optional<RationalBox>& box, const char* type, ToObject to_object) {
  if (!box) return py::none();
  py::list rows;
  for (const auto* bounds : {&box->lower, &box->upper}) {
    py::list row;
    for (const std::optional<Rational>& bound : *bounds)
      row.append(bound ? to_object(*bound) : py::float_(bounds == &box->lower ? -infinite : infinite));
    rows.append(row);
  }
  const auto shape = py::make_tuple(2, box->lower.size());
  return read_only(py::module_::import("numpy").attr("array")(rows, py::dtype(type)).attr("reshape")(shape));
}
py::object rounded_box(const HeldPolyhedron& held) {
  return box_array(held.ask([](const Polyhedron& p) { return p.bounding_box(); }), "d",
                   [](const Rational& x) { return py::object(py::float_(x.to_double())); });
}
py::object fraction_box(const HeldPolyhedron& held) {
  return box_array(held.ask([](const Polyhedron& p) { return p.bounding_box(); }), "O", to_fraction);
}
py::object integer_box(const HeldPolyhedron& held) {
  const auto box = held.ask([](const Polyhedron& p) { return p.integer_bounding_box(); });
  const auto is_small = [](const std::optional<Rational>& x) { return x && x->to_int64().has_value(); };
  const bool are_small = box && std::all_of(box->lower.begin(), box->lower.end(), is_small) &&
                         std::all_of(box->upper.begin(), box->upper.end(), is_small);
  return box_array(box, are_small ? "q" : "O", to_int);
}

py::object contains_points(const HeldPolyhedron& held, const py::object& points) {
  const ExactArray queries = as_exact_queries(points, "points");
  const std::size_t d = held.dimension();
  if (queries.length(queries.shape.size() - 1) != d)
    throw py::value_error("points: an array of shape (..., " + std::to_string(d) + "), not " +
                          shown(py::tuple(py::cast(queries.shape))));
  py::array_t<bool> answers(std::vector<py::ssize_t>(queries.shape.begin(), queries.shape.end() - 1));
  bool* const out = answers.mutable_data();
  held.ask([&, count = static_cast<std::size_t>(answers.size())](const Polyhedron& p) {
    for (std::size_t i = 0; i < count; ++i) {
      cancellation_point();
      out[i] = p.contains({queries.entries.data() + i * d, d});
    }
    return count;
  });
  return Queries::scalar_if_single(answers);
}

template <Optimum (Polyhedron::*Optimize)(std::span<const Rational>) const>
py::object optimum(const HeldPolyhedron& held, const py::object& c) {
  const std::vector<Rational> function = as_exact_vector(c, "c", held.dimension());
  const Optimum found = held.ask([&](const Polyhedron& p) { return (p.*Optimize)(function); });
  constexpr bool is_largest = Optimize == &Polyhedron::maximize;
  const bool is_attained = found.state == Optimum::State::attained;
  const double value = is_attained                                ? found.value.to_double()
                       : found.state == Optimum::State::unbounded ? (is_largest ? infinite : -infinite)
                                                                  : std::numeric_limits<double>::quiet_NaN();
  return py::module_::import("delone._polyhedra")
      .attr("Optimum")(is_attained                                ? "attained"
                       : found.state == Optimum::State::unbounded ? "unbounded"
                                                                  : "empty",
                       value, is_attained ? to_fraction(found.value) : py::none(), index_list(found.vertices),
                       index_list(found.rays));
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return ", " + std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string repr_of_polyhedron(const HeldPolyhedron& held) {
  const Polyhedron& p = held.polyhedron();
  std::string text = "<delone.Polyhedron: dimension " + std::to_string(p.dimension());
  if (p.is_empty()) return text + ", empty>";
  if (p.affine_dimension() < p.dimension())
    text += ", affine dimension " + std::to_string(p.affine_dimension());
  text += counted(p.num_vertices(), "vertex", "vertices");
  if (p.num_rays() > 0) text += counted(p.num_rays(), "ray", "rays");
  if (p.num_lines() > 0) text += counted(p.num_lines(), "line", "lines");
  return text + counted(p.num_inequalities(), "facet", "facets") + ">";
}

/// The description with fewer rows: whether it is that of inequalities, its rows of integers, and the kinds
/// of the rows that were given.
py::tuple state_of_polyhedron(const HeldPolyhedron& held) {
  const Polyhedron& p = held.polyhedron();
  const std::size_t d = held.dimension();
  const bool has_inequalities =
      p.num_inequalities() + p.num_equations() < p.num_vertices() + p.num_rays() + p.num_lines();
  if (has_inequalities || p.is_empty())
    return py::make_tuple(d, true, integer_array(p.inequalities(), d + 1),
                          integer_array(p.equations(), d + 1), py::none(), row_kinds(held));
  return py::make_tuple(d, false, integer_array(p.vertex_integers(), d + 1), integer_array(p.rays(), d),
                        integer_array(p.lines(), d), row_kinds(held));
}

RationalRows rows_of_state(const py::object& state, std::size_t width) {
  ExactArray rows = as_exact(state, "the state of a polyhedron", 2);
  if (rows.length(1) != width) throw py::value_error("not the state of a polyhedron");
  return to_rows(std::move(rows));
}

RationalRows points_of_integers(const RationalRows& rows, std::size_t d) {
  RationalRows points;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<Rational> point;
    for (const Rational& x : rows[i].first(d)) point.emplace_back(x, rows[i].back());
    points.push_back(point);
  }
  return points;
}

std::unique_ptr<HeldPolyhedron> restored_polyhedron(const py::tuple& given) {
  return from_state(given, 6, "a polyhedron", [](const py::tuple& state) {
    const int dimension = state[0].cast<int>();
    const bool has_inequalities = state[1].cast<bool>();
    const auto numbers = state[5].cast<py::array_t<std::uint8_t, py::array::forcecast>>();
    std::vector<RowKind> kinds;
    for (py::ssize_t i = 0; i < numbers.size(); ++i) {
      const std::uint8_t kind = numbers.ndim() == 1 ? numbers.at(i) : 255;
      if (kind > static_cast<std::uint8_t>(RowKind::redundant))
        throw py::value_error("not the state of a polyhedron");
      kinds.push_back(static_cast<RowKind>(kind));
    }
    if (dimension < 0) throw py::value_error("not the state of a polyhedron");
    const auto d = static_cast<std::size_t>(dimension);
    const RationalRows first = rows_of_state(state[2], d + 1),
                       second = rows_of_state(state[3], has_inequalities ? d + 1 : d);
    const RationalRows lines = has_inequalities ? RationalRows() : rows_of_state(state[4], d);
    Supervisor supervisor;
    return std::make_unique<HeldPolyhedron>(supervisor.run([&] {
      return has_inequalities
                 ? Polyhedron::from_inequalities(first, second, dimension)
                 : Polyhedron::from_generators(points_of_integers(first, d), second, lines, dimension);
    }),
                                            std::move(kinds));
  });
}

void bind_description(PolyhedronClass& type) {
  using P = Polyhedron;
  type.def_property_readonly("vertices", &rounded_vertices, text(docs::polyhedra::vertices))
      .def_property_readonly("vertex_integers",
                             &integers_of<&P::vertex_integers, HeldPolyhedron::vertex_integers, 1>,
                             text(docs::polyhedra::vertex_integers))
      .def_property_readonly("vertex_fractions", &fractions_of_vertices,
                             "The vertices, (v, d) objects: exact, as fractions.Fraction.")
      .def_property_readonly("rays", &doubles_of<&P::rays, HeldPolyhedron::rays>, text(docs::polyhedra::rays))
      .def_property_readonly(
          "ray_integers", &integers_of<&P::rays, HeldPolyhedron::ray_integers>,
          "The directions of the rays, (r, d) integers without a common divisor; int64, or "
          "objects if they do not fit.")
      .def_property_readonly("lines", &doubles_of<&P::lines, HeldPolyhedron::lines>,
                             text(docs::polyhedra::lines))
      .def_property_readonly(
          "line_integers", &integers_of<&P::lines, HeldPolyhedron::line_integers>,
          "The directions of the lines, (l, d) integers; int64, or objects if they do not fit.")
      .def_property_readonly("inequalities", &doubles_of<&P::inequalities, HeldPolyhedron::inequalities, 1>,
                             text(docs::polyhedra::inequalities))
      .def_property_readonly(
          "inequality_integers", &integers_of<&P::inequalities, HeldPolyhedron::inequality_integers, 1>,
          "The inequalities, (f, d+1) integers without a common divisor in each row; int64, "
          "or objects if they do not fit.")
      .def_property_readonly("equations", &doubles_of<&P::equations, HeldPolyhedron::equations, 1>,
                             text(docs::polyhedra::equations))
      .def_property_readonly("equation_integers",
                             &integers_of<&P::equations, HeldPolyhedron::equation_integers, 1>,
                             "The equations, (e, d+1) integers; int64, or objects if they do not fit.");
}

template <auto Member>
auto of_polyhedron() {
  return [](const HeldPolyhedron& held) { return (held.polyhedron().*Member)(); };
}

void bind_figures(PolyhedronClass& type) {
  using P = Polyhedron;
  type.def_property_readonly("dimension", of_polyhedron<&P::dimension>(),
                             "The number d of coordinates, >= 0.")
      .def_property_readonly("affine_dimension", of_polyhedron<&P::affine_dimension>(),
                             "The dimension k <= d of the affine hull; -1 for the empty set.")
      .def_property_readonly("is_empty", of_polyhedron<&P::is_empty>(), "Whether there is no point.")
      .def_property_readonly("is_bounded", of_polyhedron<&P::is_bounded>(),
                             "Whether there are no rays and no lines; so is the empty set.")
      .def_property_readonly("num_vertices", of_polyhedron<&P::num_vertices>(), "The number v of vertices.")
      .def_property_readonly("num_rays", of_polyhedron<&P::num_rays>(), "The number r of rays.")
      .def_property_readonly("num_lines", of_polyhedron<&P::num_lines>(),
                             "The number l of lines: the dimension of the lineality space.")
      .def_property_readonly("num_inequalities", of_polyhedron<&P::num_inequalities>(),
                             "The number f of inequalities, one for each facet.")
      .def_property_readonly("num_equations", of_polyhedron<&P::num_equations>(),
                             "The number e of equations: d - k, and 1 for the empty set.")
      .def_property_readonly(
          "hash", [](const HeldPolyhedron& h) { return h.ask([](const P& p) { return p.hash().hex(); }); },
          "The canonical hash of the set, 32 hexadecimal digits.")
      .def_property_readonly("row_kinds", &row_kinds, text(docs::polyhedra::row_kinds))
      .def_property_readonly("redundant_rows", &redundant_rows, text(docs::polyhedra::redundant_rows))
      .def_property_readonly("volume", &rounded_volume, text(docs::polyhedra::volume))
      .def_property_readonly("volume_fraction", &volume_fraction,
                             "The volume, exact: a fractions.Fraction; None if it is infinite.")
      .def_property_readonly("bounding_box", &rounded_box, text(docs::polyhedra::bounding_box))
      .def_property_readonly("bounding_box_fractions", &fraction_box,
                             "The same, exact: (2, d) objects, fractions.Fraction, or a float where it is "
                             "infinite.")
      .def_property_readonly("integer_bounding_box", &integer_box,
                             text(docs::polyhedra::integer_bounding_box));
}

void bind_faces_of_polyhedra(PolyhedronClass& type) {
  using P = Polyhedron;
  type.def("facets_of_vertex", list_at<&P::facets_of_vertex>("vertex"), "vertex"_a,
           text(docs::polyhedra::facets_of_vertex))
      .def("facets_of_ray", list_at<&P::facets_of_ray>("ray"), "ray"_a, text(docs::polyhedra::facets_of_ray))
      .def("vertices_of_facet", list_at<&P::vertices_of_facet>("facet"), "facet"_a,
           text(docs::polyhedra::vertices_of_facet))
      .def("rays_of_facet", list_at<&P::rays_of_facet>("facet"), "facet"_a,
           text(docs::polyhedra::rays_of_facet))
      .def_property_readonly("adjacent_vertices",
                             &pairs_of<&P::adjacent_vertices, HeldPolyhedron::adjacent_vertices>,
                             text(docs::polyhedra::adjacent_vertices))
      .def_property_readonly("adjacent_facets",
                             &pairs_of<&P::adjacent_facets, HeldPolyhedron::adjacent_facets>,
                             text(docs::polyhedra::adjacent_facets))
      .def_property_readonly(
          "f_vector",
          [](const HeldPolyhedron& h) {
            return py::tuple(py::cast(h.ask([](const P& p) { return p.f_vector(); })));
          },
          text(docs::polyhedra::f_vector));
}

std::vector<Polyhedron> as_polyhedra(const py::object& given) {
  if (!py::isinstance<py::iterable>(given))
    throw py::type_error("polyhedra: a sequence of Polyhedron, not " + shown(given));
  std::vector<Polyhedron> polyhedra;
  for (const py::handle item : given) {
    if (!py::isinstance<HeldPolyhedron>(item))
      throw py::type_error("polyhedra: " + std::to_string(polyhedra.size()) + " is " + shown(item) +
                           ", not a Polyhedron");
    polyhedra.push_back(item.cast<const HeldPolyhedron&>().polyhedron());
  }
  return polyhedra;
}

py::object volume_of_union(const py::object& given, int threads, const py::object& progress,
                           const py::object& memory_limit, const py::object& time_limit) {
  const std::vector<Polyhedron> polyhedra = as_polyhedra(given);
  const CallArguments call{threads, progress, memory_limit, time_limit};
  const auto found = call.run([&](const Options& options) { return union_volume(polyhedra, options); });
  return found ? to_fraction(*found) : py::none();
}

py::list intersections_of(const py::object& given, std::size_t most_members, int threads,
                          const py::object& progress, const py::object& memory_limit,
                          const py::object& time_limit) {
  const std::vector<Polyhedron> polyhedra = as_polyhedra(given);
  const CallArguments call{threads, progress, memory_limit, time_limit};
  py::list all;
  for (PolyhedraIntersection& part :
       call.run([&](const Options& options) { return intersections(polyhedra, most_members, options); }))
    all.append(py::make_tuple(py::tuple(py::cast(part.members)),
                              std::make_unique<HeldPolyhedron>(std::move(part.polyhedron))));
  return all;
}

}  // namespace

void bind_polyhedra(py::module_& module) {
  PolyhedronClass type(module, "Polyhedron", text(docs::polyhedra::polyhedron));
  bind_polyhedron_operations(type);
  bind_description(type);
  bind_figures(type);
  bind_faces_of_polyhedra(type);
  type.def("contains", &contains_points, "points"_a, text(docs::polyhedra::contains))
      .def(
          "__contains__",
          [](const HeldPolyhedron& held, const py::object& point) {
            const std::vector<Rational> x = as_exact_vector(point, "point", held.dimension());
            return held.ask([&](const Polyhedron& p) { return p.contains(x); });
          },
          "point"_a)
      .def(
          "includes",
          [](const HeldPolyhedron& held, const HeldPolyhedron& other) {
            return held.ask([&](const Polyhedron& p) { return p.includes(other.polyhedron()); });
          },
          "other"_a, text(docs::polyhedra::includes))
      .def("maximize", &optimum<&Polyhedron::maximize>, "c"_a, text(docs::polyhedra::maximize))
      .def("minimize", &optimum<&Polyhedron::minimize>, "c"_a, text(docs::polyhedra::minimize))
      .def("__eq__",
           [](const HeldPolyhedron& held, const py::object& other) -> py::object {
             if (!py::isinstance<HeldPolyhedron>(other))
               return py::reinterpret_borrow<py::object>(Py_NotImplemented);
             const Polyhedron& theirs = other.cast<const HeldPolyhedron&>().polyhedron();
             return py::bool_(held.ask([&](const Polyhedron& p) { return p == theirs; }));
           })
      .def("__hash__",
           [](const HeldPolyhedron& h) {
             return py::hash(py::str(h.ask([](const Polyhedron& p) { return p.hash().hex(); })));
           })
      .def("__repr__", &repr_of_polyhedron)
      .def(
          "_save",
          [](const HeldPolyhedron& held, const py::object& to, const std::string& format) {
            const auto path = py::module_::import("os").attr("fsencode")(to).cast<std::string>();
            held.ask([&](const Polyhedron& p) {
              write_polyhedron(path, p, format);
              return true;
            });
          },
          "path"_a, "format"_a)
      .def(py::pickle(&state_of_polyhedron, &restored_polyhedron));
  module.def("_union_volume", &volume_of_union, "polyhedra"_a, "threads"_a, "progress"_a, "memory_limit"_a,
             "time_limit"_a, "What delone.union_volume returns.");
  module.def("_intersections", &intersections_of, "polyhedra"_a, "most_members"_a, "threads"_a, "progress"_a,
             "memory_limit"_a, "time_limit"_a, "The fields of each delone.PolyhedraIntersection.");
}

}  // namespace delone::python
