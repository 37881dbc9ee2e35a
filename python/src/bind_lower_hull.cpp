// SPDX-License-Identifier: BSD-3-Clause
// delone.LowerHull.
#include "arrays.hpp"
#include "data_members.hpp"
#include "docs_lower_hull.hpp"
#include "docstring.hpp"
#include "messages/in_quotes.hpp"
#include "module.hpp"
#include "pickling.hpp"
#include "running.hpp"
#include "saving.hpp"

#include <delone/lower_hull.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;

HullSide side_of(const std::string& side) {
  if (side == "lower") return HullSide::lower;
  if (side == "upper") return HullSide::upper;
  throw py::value_error("side: 'lower' or 'upper', not " + messages::in_quotes(side));
}

/// A lower or upper hull, and its points; none of it changes.
class HeldLowerHull {
 public:
  HeldLowerHull(const py::object& points, const std::string& side, double tolerance,
                const BuildArguments& arguments, const py::object& progress) {
    const auto rows = as_points(points, "points");
    if (rows.shape(1) < 2) throw py::value_error("points: a composition and a height, 2 numbers at least");
    Options options = arguments.to_options();
    options.tolerance = tolerance;
    const HullSide which = side_of(side);
    columns_ = columns_of(points);
    row_index_ = index_of(points);
    Supervisor supervisor(progress);
    supervisor.run([&, x = numbers(rows), d = static_cast<int>(rows.shape(1))] {
      hull_ = std::make_shared<const LowerHull<>>(x, d, which, options);
      points_ = std::make_shared<const std::vector<double>>(x.begin(), x.end());
    });
  }

  const LowerHullBase& hull() const { return *hull_; }
  /// The labels of the columns of the DataFrame that it was made of, a tuple, or None.
  const py::object& columns() const { return columns_; }
  void set_columns(py::object columns) { columns_ = std::move(columns); }
  /// The index of the DataFrame, see index_of().
  const py::object& row_index() const { return row_index_; }
  /// Those of the compositions alone.
  py::object composition_columns() const {
    return columns_.is_none() ? columns_ : py::object(columns_[py::slice(0, -1, 1)]);
  }
  const std::shared_ptr<const LowerHull<>>& owner() const { return hull_; }
  const std::shared_ptr<const std::vector<double>>& points() const { return points_; }
  std::size_t dimension() const { return static_cast<std::size_t>(hull_->dimension()); }
  std::size_t width() const { return static_cast<std::size_t>(hull_->composition_dimension() + 1); }

 private:
  py::object columns_ = py::none(), row_index_ = py::none();
  std::shared_ptr<const LowerHull<>> hull_;
  std::shared_ptr<const std::vector<double>> points_;
};

py::array list(const HeldLowerHull& held, std::span<const SignedIndex> items) {
  return view(items, {static_cast<py::ssize_t>(items.size())}, held.owner());
}
py::array table(const HeldLowerHull& held, std::span<const SignedIndex> items) {
  return view(items,
              {static_cast<py::ssize_t>(held.hull().num_cells()), static_cast<py::ssize_t>(held.width())},
              held.owner());
}

Queries compositions(const HeldLowerHull& held, const py::object& object) {
  return {object, held.hull().dimension() - 1, held.composition_columns(), "compositions"};
}

/// Asks in parts, between which the work can be stopped: answer(coordinates of some queries).
template <class Answer>
py::object in_parts(const Queries& queries, std::size_t width, Answer answer) {
  auto result = queries.answers<double>();
  Supervisor supervisor;
  supervisor.run([&, x = queries.coordinates(), out = result.mutable_data()] {
    // What is not finite is refused at once, with its place among all queries.
    const bool is_finite = std::all_of(x.begin(), x.end(), [](double c) { return std::isfinite(c); });
    const std::size_t most = is_finite ? 256 : queries.size();
    for (std::size_t first = 0; first < queries.size(); first += most) {
      cancellation_point();
      const std::size_t count = std::min(most, queries.size() - first);
      const std::vector<double> found = answer(x.subspan(first * width, count * width));
      std::copy(found.begin(), found.end(), out + first);
    }
  });
  return Queries::scalar_if_single(result);
}

py::object heights(const HeldLowerHull& held, const py::object& object) {
  return in_parts(compositions(held, object), held.dimension() - 1,
                  [&](std::span<const double> x) { return held.hull().heights(x); });
}

py::object height_above(const HeldLowerHull& held, const py::object& object, double tolerance) {
  const Queries queries(object, held.hull().dimension(), held.columns(), "points");
  static_cast<void>(held.hull().height_above(std::span<const double>(), tolerance));  // of a bad tolerance
  return in_parts(queries, held.dimension(),
                  [&](std::span<const double> x) { return held.hull().height_above(x, tolerance); });
}

py::object find_simplex(const HeldLowerHull& held, const py::object& object) {
  const Queries queries = compositions(held, object);
  auto result = queries.answers<SignedIndex>();
  const std::size_t width = held.dimension() - 1;
  Supervisor supervisor;
  supervisor.run([&, x = queries.coordinates(), out = result.mutable_data()] {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      cancellation_point();
      const auto found = held.hull().find_cell(x.subspan(i * width, width));
      out[i] = found ? static_cast<SignedIndex>(*found) : -1;
    }
  });
  return Queries::scalar_if_single(result);
}

}  // namespace

void bind_lower_hull(py::module_& module) {
  using Held = HeldLowerHull;
  py::class_<Held> type(module, "LowerHull", text(docs::lower_hull::hull));
  type.def(py::init([](const py::object& points, const std::string& side, double tolerance,
                       std::uint64_t seed, std::string order, int threads, const py::object& progress,
                       const py::object& memory_limit, const py::object& time_limit) {
             return std::make_unique<Held>(
                 points, side, tolerance,
                 BuildArguments{seed, std::move(order), threads, as_memory_limit(memory_limit),
                                as_time_limit(time_limit)},
                 progress);
           }),
           "points"_a, "side"_a = "lower", py::kw_only(), "tolerance"_a = 0.0, "seed"_a = 0,
           "order"_a = "automatic", "threads"_a = 0, "progress"_a = py::none(), "memory_limit"_a = py::none(),
           "time_limit"_a = py::none());
  type.def_property_readonly(
          "dimension", [](const Held& h) { return h.hull().dimension(); },
          "The number d >= 2 of coordinates of a point, its height included.")
      .def_property_readonly(
          "composition_dimension", [](const Held& h) { return h.hull().composition_dimension(); },
          "The affine dimension c <= d-1 of the compositions; -1 without points.")
      .def_property_readonly(
          "composition_axes", [](const Held& h) { return py::tuple(py::cast(h.hull().composition_axes())); },
          "The c axes onto which the flat of the compositions projects one-to-one, increasing, a tuple.")
      .def_property_readonly(
          "side", [](const Held& h) { return h.hull().side() == HullSide::lower ? "lower" : "upper"; },
          "The side, 'lower' or 'upper'.")
      .def_property_readonly(
          "tolerance", [](const Held& h) { return h.hull().tolerance(); },
          "The tolerance of the constructor; 0.0: the hull is exact.")
      .def_property_readonly(
          "max_distance", [](const Held& h) { return h.hull().max_distance(); },
          "A bound on the distance of points outside along the last axis; at most `tolerance`.")
      .def_property_readonly(
          "num_points", [](const Held& h) { return h.hull().num_points(); }, "The number n of input rows.")
      .def_property_readonly(
          "num_cells", [](const Held& h) { return h.hull().num_cells(); },
          "The number m of simplices; also len().")
      .def_property_readonly(
          "num_facets", [](const Held& h) { return h.hull().num_facets(); },
          "The number f of facets: cells in one hyperplane belong to one facet.")
      .def("__len__", [](const Held& h) { return h.hull().num_cells(); })
      .def_property_readonly(
          "points",
          [](const Held& h) {
            return rows_view(*h.points(), h.hull().num_points(), h.dimension(), h.points());
          },
          "All input rows in their order, (n, d) float64.")
      .def_property_readonly(
          "cells", [](const Held& h) { return table(h, h.hull().cells()); },
          "The vertices of each cell, (m, c+1) input rows; positively oriented on `composition_axes`.")
      .def_property_readonly(
          "neighbors", [](const Held& h) { return table(h, h.hull().neighbors()); },
          "The neighbors of each cell, (m, c+1) cells: number j is opposite vertex j, -1 at the border of "
          "the domain.")
      .def_property_readonly(
          "facet_of_cell", [](const Held& h) { return list(h, h.hull().facet_of_cell()); },
          "The facet of each cell, (m,).")
      .def_property_readonly(
          "vertices", [](const Held& h) { return list(h, h.hull().vertices()); },
          "The rows of the extreme points of this side (stable phases), increasing; of equal rows the first.")
      .def("find_simplex", &find_simplex, "compositions"_a, text(docs::lower_hull::find_simplex))
      .def("heights", &heights, "compositions"_a, text(docs::lower_hull::heights))
      .def("height_above", &height_above, "points"_a, py::kw_only(), "tolerance"_a = 0.0,
           text(docs::lower_hull::height_above))
      .def_property_readonly("columns", &Held::columns,
                             "The labels of the columns of the DataFrame it was made of, a tuple, or None; "
                             "queries must have them, too.")
      .def_property_readonly("_index", &Held::row_index)
      .def("_data",
           [](const Held& h) {
             Supervisor supervisor;
             return to_python(supervisor.run([&] { return h.hull().to_data(); }));
           })
      .def("__repr__",
           [](const Held& h) {
             const LowerHullBase& hull = h.hull();
             return std::string("<delone.LowerHull: the ") +
                    (hull.side() == HullSide::lower ? "lower" : "upper") + " hull of " +
                    std::to_string(hull.num_points()) + " points in dimension " +
                    std::to_string(hull.dimension()) + ", " + std::to_string(hull.vertices().size()) +
                    " vertices, " + std::to_string(hull.num_cells()) + " cells>";
           })
      .def(py::pickle(
          [](const Held& h) {
            return py::make_tuple(rows_view(*h.points(), h.hull().num_points(), h.dimension(), h.points()),
                                  h.hull().side() == HullSide::lower ? "lower" : "upper",
                                  h.hull().tolerance(), h.columns());
          },
          [](const py::tuple& given) {
            return from_state(given, 4, "a lower hull", [](const py::tuple& state) {
              auto held = std::make_unique<Held>(state[0], state[1].cast<std::string>(),
                                                 state[2].cast<double>(), BuildArguments{}, py::none());
              held->set_columns(as_columns(state[3], held->hull().dimension()));
              return held;
            });
          }));
  define_save(type, [](const Held& held, const SaveArguments& to) {
    if (to.qhull) throw py::value_error("qhull: Qhull has no output for lower hulls");
    Supervisor supervisor;
    supervisor.run([&] { to.save_data(held.hull().to_data()); });
  });
}

}  // namespace delone::python
