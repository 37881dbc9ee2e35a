// SPDX-License-Identifier: BSD-3-Clause
// delone.PeriodicDelaunay and delone.PeriodicRegular.
#include "arrays.hpp"
#include "data_members.hpp"
#include "docs_periodic.hpp"
#include "docstring.hpp"
#include "held_periodic.hpp"
#include "module.hpp"
#include "neighbor_changes.hpp"
#include "pickling.hpp"
#include "running.hpp"
#include "saving.hpp"
#include "site_cells.hpp"

#include <pybind11/stl.h>

#include <delone/neighbor_changes.hpp>
#include <delone/periodic.hpp>
#include <delone/periodic_faces.hpp>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;

/// One C++ class for each Python class.
struct HeldPeriodicDelaunay : HeldPeriodic {
  using HeldPeriodic::HeldPeriodic;
};
struct HeldPeriodicRegular : HeldPeriodic {
  using HeldPeriodic::HeldPeriodic;
};

Lattice as_lattice(const py::object& lattice, const py::object& axes, int dimension) {
  const auto rows =
      as_doubles(py::module_::import("delone._lattice").attr("vectors")(lattice, axes, dimension), "lattice");
  const auto numbers_of = numbers(rows);
  return {dimension, {numbers_of.begin(), numbers_of.end()}};
}

PeriodicOptions as_periodic_options(bool exact, bool wrap, const py::object& unit) {
  PeriodicOptions options{exact, wrap, 0};
  if (!unit.is_none()) {
    if (PyNumber_Check(unit.ptr()) == 0) throw py::type_error("unit: a finite number above 0, or None");
    options.unit = py::float_(unit);
    if (!(options.unit > 0 && std::isfinite(options.unit)))
      throw py::value_error("unit: a finite number above 0, or None");
  }
  return options;
}

template <class Make>
HeldPeriodic::Held made(const BuildArguments& arguments, const py::object& progress, Make make) {
  const Options options = arguments.to_options();
  Supervisor supervisor(progress);
  return supervisor.run([&]() -> HeldPeriodic::Held { return make(options); });
}

HeldPeriodic::Held make_delaunay(std::span<const double> points, const Lattice& lattice,
                                 const PeriodicOptions& how, const Options& options) {
  return std::make_shared<const PeriodicDelaunay<>>(PointsView(points, lattice.dimension), lattice, how,
                                                    options);
}
HeldPeriodic::Held make_regular(std::span<const double> points, std::span<const double> weights,
                                const Lattice& lattice, const PeriodicOptions& how, const Options& options) {
  return std::make_shared<const PeriodicRegular<>>(PointsView(points, lattice.dimension), weights, lattice,
                                                   how, options);
}

std::unique_ptr<HeldPeriodicDelaunay> construct_delaunay(
    const py::object& points, const py::object& lattice, const py::object& axes, bool exact, bool wrap,
    const py::object& unit, std::uint64_t seed, std::string order, int threads, const py::object& progress,
    const py::object& memory_limit, const py::object& time_limit) {
  const auto rows = as_points(points, "points");
  const Lattice box = as_lattice(lattice, axes, static_cast<int>(rows.shape(1)));
  const PeriodicOptions how = as_periodic_options(exact, wrap, unit);
  const BuildArguments arguments{seed, std::move(order), threads, as_memory_limit(memory_limit),
                                 as_time_limit(time_limit)};
  return std::make_unique<HeldPeriodicDelaunay>(
      made(arguments, progress,
           [&](const Options& options) { return make_delaunay(numbers(rows), box, how, options); }),
      how, threads);
}

std::unique_ptr<HeldPeriodicRegular> construct_regular(
    const py::object& points, const py::object& weights, const py::object& lattice, const py::object& axes,
    bool exact, bool wrap, const py::object& unit, std::uint64_t seed, std::string order, int threads,
    const py::object& progress, const py::object& memory_limit, const py::object& time_limit) {
  const auto rows = as_points(points, "points");
  const auto of_rows = as_doubles(weights, "weights");
  if (of_rows.ndim() != 1 || of_rows.shape(0) != rows.shape(0))
    throw py::value_error("weights: an array of shape (" + std::to_string(rows.shape(0)) + ",), not " +
                          shown(of_rows.attr("shape")));
  const Lattice box = as_lattice(lattice, axes, static_cast<int>(rows.shape(1)));
  const PeriodicOptions how = as_periodic_options(exact, wrap, unit);
  const BuildArguments arguments{seed, std::move(order), threads, as_memory_limit(memory_limit),
                                 as_time_limit(time_limit)};
  return std::make_unique<HeldPeriodicRegular>(made(arguments, progress,
                                                    [&](const Options& options) {
                                                      return make_regular(numbers(rows), numbers(of_rows),
                                                                          box, how, options);
                                                    }),
                                               how, threads);
}

py::ssize_t corners(const PeriodicTriangulation& t) {
  return std::max(t.affine_dimension(), 0) + py::ssize_t{1};
}

template <class T>
py::array cell_rows(const HeldPeriodic& held, std::span<const T> (PeriodicTriangulation::*member)() const,
                    bool has_offsets) {
  const auto items = held.ask([&](const PeriodicTriangulation& t) { return (t.*member)(); });
  const PeriodicTriangulation& t = held.get();
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(t.num_cells()), corners(t)};
  if (has_offsets) shape.push_back(t.rank());
  return view<T>(items, std::move(shape), held.owner());
}

std::string periodic_repr(const HeldPeriodic& held) {
  const PeriodicTriangulation& t = held.get();
  return std::string("<delone.") + (t.is_regular() ? "PeriodicRegular: " : "PeriodicDelaunay: ") +
         std::to_string(t.num_points()) + " points, dimension " + std::to_string(t.dimension()) +
         ", periodic in " + std::to_string(t.rank()) + (t.rank() == 1 ? " direction>" : " directions>");
}

py::array periodic_lattice(const HeldPeriodic& held) {
  const PeriodicTriangulation& t = held.get();
  return view<double>(t.lattice().vectors, {t.rank(), t.dimension()}, held.owner());
}
py::array periodic_points(const HeldPeriodic& held) {
  const PeriodicTriangulation& t = held.get();
  return view<double>(t.points(), {static_cast<py::ssize_t>(t.num_points()), t.dimension()}, held.owner());
}
py::array periodic_weights(const HeldPeriodic& held) {
  return view<double>(held.get().weights(), {static_cast<py::ssize_t>(held.get().weights().size())},
                      held.owner());
}

py::tuple periodic_state(const HeldPeriodic& held) {
  return py::make_tuple(periodic_points(held), periodic_weights(held), periodic_lattice(held),
                        held.options().unit);
}
template <class Held>
Held restored_periodic(const py::tuple& given, bool is_regular) {
  return from_state(given, 4, "a periodic triangulation", [&](const py::tuple& state) {
    const auto points = as_points(state[0], "points");
    const auto weights = as_doubles(state[1], "weights"), lattice = as_doubles(state[2], "lattice");
    const PeriodicOptions how{.unit = state[3].cast<double>()};
    const Lattice box{static_cast<int>(points.shape(1)), {lattice.data(), lattice.data() + lattice.size()}};
    return Held(made({}, py::none(),
                     [&](const Options& options) {
                       return is_regular ? make_regular(numbers(points), numbers(weights), box, how, options)
                                         : make_delaunay(numbers(points), box, how, options);
                     }),
                how, 0);
  });
}

/// Answers of the locator, without the GIL.
template <class Question>
auto ask_locator(const HeldPeriodic& held, Question question) {
  Supervisor supervisor;
  return supervisor.run([&] { return question(held.locator(), Execution{.threads = held.threads()}); });
}
template <class T>
std::span<T> span_of_answers(py::array_t<T>& array) {
  return {array.mutable_data(), static_cast<std::size_t>(array.size())};
}

py::tuple find_periodic_simplices(const HeldPeriodic& held, const py::object& object) {
  const Queries queries(object, held.dimension());
  auto cells = queries.answers<SignedIndex>();
  auto offsets = queries.answers<std::int32_t>({static_cast<std::size_t>(held.get().rank())});
  ask_locator(
      held,
      [&, to = PeriodicLocatedArrays{.cells = span_of_answers(cells), .offsets = span_of_answers(offsets)},
       x = queries.coordinates()](const PeriodicPointLocator& locator, const Execution& how) {
        locator.locate(x, to, how);
      });
  return py::make_tuple(Queries::scalar_if_single(cells), offsets);
}

py::tuple periodic_barycentric(const HeldPeriodic& held, const py::object& object) {
  const Queries queries(object, held.dimension());
  auto cells = queries.answers<SignedIndex>();
  auto offsets = queries.answers<std::int32_t>({static_cast<std::size_t>(held.get().rank())});
  auto weights = queries.answers<double>({static_cast<std::size_t>(held.get().affine_dimension() + 1)});
  ask_locator(held, [&,
                     to = PeriodicLocatedArrays{.cells = span_of_answers(cells),
                                                .offsets = span_of_answers(offsets),
                                                .barycentric = span_of_answers(weights)},
                     x = queries.coordinates()](const PeriodicPointLocator& locator, const Execution& how) {
    locator.locate(x, to, how);
  });
  return py::make_tuple(Queries::scalar_if_single(cells), offsets, weights);
}

py::object locate_periodic(const HeldPeriodic& held, const py::object& object) {
  const Queries queries(object, held.dimension());
  auto found =
      ask_locator(held, [x = queries.coordinates()](const PeriodicPointLocator& locator,
                                                    const Execution& how) { return locator.locate(x, how); });
  const std::size_t count = found.kinds.size(), faces = found.face_rows.size(),
                    rank = static_cast<std::size_t>(held.get().rank());
  std::vector<std::uint8_t> kinds(count);
  std::transform(found.kinds.begin(), found.kinds.end(), kinds.begin(),
                 [](Location::Kind kind) { return static_cast<std::uint8_t>(kind); });
  return py::module_::import("delone._locations")
      .attr("Locations")(
          list_view(std::move(kinds)), list_view(std::move(found.cells)),
          list_view(std::move(found.face_offsets)), list_view(std::move(found.face_rows)),
          py::make_tuple("in_cell", "on_face", "on_vertex", "outside_hull", "outside_affine_hull"),
          rows_view(std::move(found.offsets), count, rank),
          rows_view(std::move(found.face_lattice), faces, rank));
}

py::tuple periodic_nearest(const HeldPeriodic& held, const py::object& object) {
  const Queries queries(object, held.dimension());
  auto rows = queries.answers<SignedIndex>();
  auto offsets = queries.answers<std::int32_t>({static_cast<std::size_t>(held.get().rank())});
  auto distances = queries.answers<double>();
  ask_locator(held, [&,
                     to = PeriodicNearestArrays{span_of_answers(rows), span_of_answers(offsets),
                                                span_of_answers(distances)},
                     x = queries.coordinates()](const PeriodicPointLocator& locator, const Execution& how) {
    locator.nearest(x, to, how);
  });
  return py::make_tuple(Queries::scalar_if_single(rows), offsets, Queries::scalar_if_single(distances));
}

py::tuple periodic_faces(const HeldPeriodic& held, int dimension) {
  PeriodicFaces found = held.ask(
      [&](const PeriodicTriangulation& t) { return faces(t, dimension, {.threads = held.threads()}); });
  const auto count = static_cast<py::ssize_t>(found.size());
  const auto owner = std::make_shared<const PeriodicFaces>(std::move(found));
  std::vector<std::uint8_t> on_hull(owner->on_hull.begin(), owner->on_hull.end());
  return py::make_tuple(
      view<SignedIndex>(owner->vertices, {count, owner->dimension + py::ssize_t{1}}, owner),
      view<std::int32_t>(owner->offsets, {count, owner->dimension + py::ssize_t{1}, owner->rank}, owner),
      list_view(std::move(on_hull)).attr("view")("bool"));
}

py::array periodic_alpha_values(const HeldPeriodic& held, int dimension) {
  return list_view(std::move(held.ask([&](const PeriodicTriangulation& t) {
                                   return alpha_values(t, dimension, {.threads = held.threads()});
                                 })
                                 .values));
}

py::tuple periodic_site_cells(const HeldPeriodic& held, bool neighbors, bool vertices, bool proper) {
  const SiteCellsOptions options{.faces = proper ? CellFaces::proper : CellFaces::triangulated,
                                 .neighbors = neighbors,
                                 .vertices = vertices};
  return as_tuple(held.ask(
      [&](const PeriodicTriangulation& t) { return site_cells(t, options, {.threads = held.threads()}); }));
}

/// Calls make(from, points, lattice or null) without the GIL, for a step of a triangulation.
template <class Made, class Step>
HeldPeriodic::Held made_step(const HeldPeriodic& held, const py::array_t<double>& rows,
                             const py::object& lattice, const py::object& progress, Step step) {
  std::optional<Lattice> box;
  if (!lattice.is_none()) box = as_lattice(lattice, py::none(), held.dimension());
  Supervisor supervisor(progress);
  return supervisor.run([&, from = held.owner()]() -> HeldPeriodic::Held {
    return std::make_shared<const Made>(
        step(static_cast<const Made&>(*from), PointsView(numbers(rows), held.dimension()), box));
  });
}

std::unique_ptr<HeldPeriodicDelaunay> moved_delaunay(const HeldPeriodicDelaunay& held,
                                                     const py::object& points, const py::object& lattice,
                                                     const py::object& progress) {
  const auto rows = as_more_points(points, held.dimension(), "points");
  return std::make_unique<HeldPeriodicDelaunay>(
      made_step<PeriodicDelaunay<>>(
          held, rows, lattice, progress,
          [](const PeriodicDelaunay<>& from, PointsView to, const std::optional<Lattice>& box) {
            return box ? from.moved(to, *box) : from.moved(to);
          }),
      held.options(), static_cast<int>(held.threads()));
}

std::unique_ptr<HeldPeriodicRegular> moved_regular(const HeldPeriodicRegular& held, const py::object& points,
                                                   const py::object& weights, const py::object& lattice,
                                                   const py::object& progress) {
  const auto rows = as_more_points(points, held.dimension(), "points");
  const auto of_rows =
      as_doubles(weights.is_none() ? py::object(periodic_weights(held)) : weights, "weights");
  if (of_rows.ndim() != 1)
    throw py::value_error("weights: an array of shape (n,), not " + shown(of_rows.attr("shape")));
  return std::make_unique<HeldPeriodicRegular>(
      made_step<PeriodicRegular<>>(
          held, rows, lattice, progress,
          [&](const PeriodicRegular<>& from, PointsView to, const std::optional<Lattice>& box) {
            return box ? from.moved(to, numbers(of_rows), *box) : from.moved(to, numbers(of_rows));
          }),
      held.options(), static_cast<int>(held.threads()));
}

py::tuple changed_periodic_neighbors(const HeldPeriodic& before, const HeldPeriodic& after) {
  Supervisor supervisor;
  return as_tuple(supervisor.run([&, a = before.owner(), b = after.owner()] {
    return changed_neighbors(*a, *b, {.threads = after.threads()});
  }));
}

template <class Class>
void define_members(Class& type) {
  type.def_property_readonly(
          "dimension", [](const HeldPeriodic& h) { return h.get().dimension(); },
          "The number d >= 1 of coordinates of a point.")
      .def_property_readonly(
          "affine_dimension", [](const HeldPeriodic& h) { return h.get().affine_dimension(); },
          "The dimension k <= d of the smallest flat that contains all points and lattice "
          "vectors; -1 without points.")
      .def_property_readonly(
          "rank", [](const HeldPeriodic& h) { return h.get().rank(); }, "The number r of lattice vectors.")
      .def_property_readonly(
          "num_points", [](const HeldPeriodic& h) { return h.get().num_points(); }, "The number n of points.")
      .def_property_readonly(
          "num_vertices", [](const HeldPeriodic& h) { return h.get().num_vertices(); },
          "The number of points that are vertices.")
      .def_property_readonly(
          "num_duplicates", [](const HeldPeriodic& h) { return h.get().num_duplicates(); },
          "The number of points that are translates of earlier ones.")
      .def_property_readonly(
          "num_hidden", [](const HeldPeriodic& h) { return h.get().num_hidden(); },
          "The number of hidden points.")
      .def_property_readonly(
          "num_cells",
          [](const HeldPeriodic& h) {
            return h.ask([](const PeriodicTriangulation& t) { return t.num_cells(); });
          },
          "The number m of cells.")
      .def_property_readonly(
          "num_ghosts", [](const HeldPeriodic& h) { return h.get().num_ghosts(); },
          "The number of translates that were inserted.")
      .def_property_readonly("points", &periodic_points,
                             "The points where they were given, on the grid, (n, d) float64.")
      .def_property_readonly("lattice", &periodic_lattice, "The lattice vectors on the grid, (r, d) float64.")
      .def_property_readonly(
          "displacement", [](const HeldPeriodic& h) { return h.get().displacement(); },
          "The most that a coordinate of a point or lattice vector has moved onto the grid.")
      .def_property_readonly(
          "cells", [](const HeldPeriodic& h) { return cell_rows(h, &PeriodicTriangulation::cells, false); },
          text(docs::periodic::cells))
      .def_property_readonly(
          "cell_offsets",
          [](const HeldPeriodic& h) { return cell_rows(h, &PeriodicTriangulation::cell_offsets, true); },
          text(docs::periodic::cell_offsets))
      .def_property_readonly(
          "neighbors",
          [](const HeldPeriodic& h) { return cell_rows(h, &PeriodicTriangulation::neighbors, false); },
          text(docs::periodic::neighbors))
      .def_property_readonly(
          "neighbor_offsets",
          [](const HeldPeriodic& h) { return cell_rows(h, &PeriodicTriangulation::neighbor_offsets, true); },
          text(docs::periodic::neighbor_offsets))
      .def_property_readonly(
          "vertex_of_point",
          [](const HeldPeriodic& h) {
            const auto items = h.get().vertex_of_point();
            return view<SignedIndex>(items, {static_cast<py::ssize_t>(items.size())}, h.owner());
          },
          text(docs::periodic::vertex_of_point))
      .def_property_readonly(
          "point_offsets",
          [](const HeldPeriodic& h) {
            return view<std::int32_t>(h.get().point_offsets(),
                                      {static_cast<py::ssize_t>(h.get().num_points()), h.get().rank()},
                                      h.owner());
          },
          text(docs::periodic::point_offsets))
      .def_property_readonly(
          "is_simplicial",
          [](const HeldPeriodic& h) {
            return h.ask([](const PeriodicTriangulation& t) { return t.is_simplicial(); });
          },
          "Whether cells are told by their rows: no two edges have the same ends, and none the same end "
          "twice.")
      .def_property_readonly(
          "hash",
          [](const HeldPeriodic& h) {
            return h.ask([](const PeriodicTriangulation& t) { return t.hash().hex(); });
          },
          text(docs::periodic::hash))
      .def_property_readonly(
          "statistics", [](const HeldPeriodic& h) { return as_dict(h.get().statistics()); },
          text(docs::periodic::statistics))
      .def("_data",
           [](const HeldPeriodic& h) {
             return to_python(h.ask([](const PeriodicTriangulation& t) { return t.to_data(); }));
           })
      .def("find_simplex", &find_periodic_simplices, "queries"_a, text(docs::periodic::find_simplex))
      .def("locate", &locate_periodic, "queries"_a, text(docs::periodic::locate))
      .def("barycentric", &periodic_barycentric, "queries"_a, text(docs::periodic::barycentric))
      .def("nearest", &periodic_nearest, "queries"_a, text(docs::periodic::nearest))
      .def("_faces", &periodic_faces, "dimension"_a)
      .def("alpha_values", &periodic_alpha_values, "dimension"_a, text(docs::periodic::alpha_values))
      .def("_site_cells", &periodic_site_cells, "neighbors"_a, "vertices"_a, "proper"_a)
      .def("__len__",
           [](const HeldPeriodic& h) {
             return h.ask([](const PeriodicTriangulation& t) { return t.num_cells(); });
           })
      .def("__repr__", &periodic_repr);
  define_save(type, [](const HeldPeriodic& h, const SaveArguments& arguments) {
    if (arguments.qhull)
      throw Error(Errc::unsupported, "the output of Qhull has no offsets for a periodic triangulation");
    h.ask([&](const PeriodicTriangulation& t) {
      arguments.save_data(t.to_data());
      return true;
    });
  });
}

}  // namespace

void bind_periodic(py::module_& module) {
  py::class_<HeldPeriodic> base(module, "PeriodicTriangulation", text(docs::periodic::base));
  define_members(base);
  module.def("_changed_periodic_neighbors", &changed_periodic_neighbors, "before"_a, "after"_a);
  py::class_<HeldPeriodicDelaunay, HeldPeriodic>(module, "PeriodicDelaunay", text(docs::periodic::delaunay))
      .def(py::init(&construct_delaunay), "points"_a, "lattice"_a, "axes"_a = py::none(), py::kw_only(),
           "exact"_a = false, "wrap"_a = true, "unit"_a = py::none(), "seed"_a = 0, "order"_a = "automatic",
           "threads"_a = 0, "progress"_a = py::none(), "memory_limit"_a = py::none(),
           "time_limit"_a = py::none())
      .def(py::pickle(
          &periodic_state,
          [](const py::tuple& given) { return restored_periodic<HeldPeriodicDelaunay>(given, false); }))
      .def("moved", &moved_delaunay, "points"_a, py::kw_only(), "lattice"_a = py::none(),
           "progress"_a = py::none(), text(docs::periodic::moved));
  py::class_<HeldPeriodicRegular, HeldPeriodic>(module, "PeriodicRegular", text(docs::periodic::regular))
      .def(py::init(&construct_regular), "points"_a, "weights"_a, "lattice"_a, "axes"_a = py::none(),
           py::kw_only(), "exact"_a = false, "wrap"_a = true, "unit"_a = py::none(), "seed"_a = 0,
           "order"_a = "automatic", "threads"_a = 0, "progress"_a = py::none(), "memory_limit"_a = py::none(),
           "time_limit"_a = py::none())
      .def_property_readonly("weights", &periodic_weights, "The weights, (n,) float64.")
      .def(py::pickle(
          &periodic_state,
          [](const py::tuple& given) { return restored_periodic<HeldPeriodicRegular>(given, true); }))
      .def("moved", &moved_regular, "points"_a, "weights"_a = py::none(), py::kw_only(),
           "lattice"_a = py::none(), "progress"_a = py::none(), text(docs::periodic::moved_with_weights));
}

}  // namespace delone::python
