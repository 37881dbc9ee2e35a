// SPDX-License-Identifier: BSD-3-Clause
// delone.Delaunay, Regular and FurthestSite: how they are made, changed, copied and pickled.
#include "bind_edits.hpp"

#include "arrays.hpp"
#include "docs_edits.hpp"
#include "docstring.hpp"
#include "neighbor_changes.hpp"
#include "pickling.hpp"

#include <pybind11/stl.h>

#include <delone/forecast.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;
using Held = HeldTriangulation;

// One C++ class for each Python class.
template <Form F>
class HeldForm : public Held {
 public:
  HeldForm(int dimension, const BuildArguments& arguments) : Held(F, dimension, arguments) {}
};
using HeldDelaunay = HeldForm<Form::delaunay>;
using HeldRegular = HeldForm<Form::regular>;
using HeldFurthestSite = HeldForm<Form::furthest_site>;

/// One weight for each of so many points or rows; of one, a number may be its weight.
py::array_t<double> as_weights(const py::object& object, py::ssize_t count, const std::string& name) {
  auto weights = as_doubles(object, name);
  if (weights.ndim() == 0 && count == 1) weights = py::array_t<double>(weights.attr("reshape")(1));
  if (weights.ndim() != 1 || weights.shape(0) != count)
    throw py::value_error(name + ": an array of shape (" + std::to_string(count) + ",), not " +
                          shown(weights.attr("shape")));
  return weights;
}

/// Points of the dimension and with the columns of the triangulation.
py::array_t<double> as_more_points(const Held& held, const py::object& object, const std::string& name) {
  auto points = python::as_more_points(object, held.dimension(), name);
  require_columns(object, held.columns(), name);
  return points;
}

/// Rows of the triangulation, see as_rows() of arrays.hpp.
RowNumbers as_rows(const Held& held, const py::object& object, const std::string& name,
                   const std::string& list) {
  return python::as_rows(object, name, list,
                         [&] { return count(held, [](const Triangulation& t) { return t.num_rows(); }); });
}

void add(Held& held, const py::object& points, const py::object& weights, const py::object& progress) {
  const auto rows = as_more_points(held, points, "points");
  require_index(weights, index_of(points), "weights");
  const auto their_weights =
      held.form() == Form::regular ? as_weights(weights, rows.shape(0), "weights") : py::array_t<double>(0);
  Supervisor supervisor(progress);
  supervisor.run([&, x = numbers(rows), w = numbers(their_weights)] { held.add(x, w); });
  if (rows.shape(0) > 0) held.set_row_index(py::none());
}

/// Says that points are expected to need more memory than is available. Where there is a limit of memory, or
/// of time below a minute, that will say it.
void warn_of_memory(const py::array_t<double>& rows, const BuildArguments& arguments) {
  constexpr double short_time = 60;
  if (arguments.memory_limit > 0 || (arguments.time_limit > 0 && arguments.time_limit < short_time)) return;
  ForecastOptions options;
  options.threads = static_cast<unsigned>(arguments.threads);
  Supervisor supervisor;
  const std::string text =
      supervisor.run([&, points = PointsView(numbers(rows), static_cast<int>(rows.shape(1)))] {
        return memory_warning(points, points.dimension(), options);
      });
  if (!text.empty() && PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0)
    throw py::error_already_set();
}

template <class T>
std::unique_ptr<T> construct(const py::object& points, const py::object& weights, std::uint64_t seed,
                             std::string order, int threads, const py::object& progress,
                             const py::object& memory_limit, const py::object& time_limit) {
  const auto rows = as_points(points, "points");
  auto held = std::make_unique<T>(static_cast<int>(rows.shape(1)),
                                  BuildArguments{seed, std::move(order), threads,
                                                 as_memory_limit(memory_limit), as_time_limit(time_limit)});
  const py::object index = index_of(points);
  require_index(weights, index, "weights");
  if (held->form() != Form::furthest_site) warn_of_memory(rows, held->arguments());
  add(*held, rows, weights, progress);
  held->set_columns(columns_of(points));
  held->set_row_index(index);
  return held;
}

/// The arguments of an edit, converted and checked.
struct Edits {
  std::vector<std::size_t> remove = {}, move = {}, reweight = {};
  py::array_t<double> to = {}, weights = {}, insert = {}, insert_weights = {};
};

void make(Held& held, const Edits& edits, const py::object& progress) {
  Supervisor supervisor(progress);
  supervisor.run([&, to = numbers(edits.to), weights = numbers(edits.weights), insert = numbers(edits.insert),
                  insert_weights = numbers(edits.insert_weights)] {
    held.edit({.remove = edits.remove,
               .move = edits.move,
               .to = PointsView(to, held.dimension()),
               .reweight = edits.reweight,
               .weights = weights,
               .insert = PointsView(insert, held.dimension()),
               .insert_weights = insert_weights});
  });
  if (edits.insert.size() > 0) held.set_row_index(py::none());
}

/// Puts rows and their new points into an edit: a row and a point, (d,), or as many of both. Messages about
/// either begin with `of`.
void put_moves(Edits& edits, const Held& held, const py::object& rows, const py::object& points,
               const std::string& of) {
  RowNumbers numbers = as_rows(held, rows, of + "rows", "move");
  const std::string name = of + "points";
  const auto d = static_cast<py::ssize_t>(held.dimension());
  if (numbers.is_single) {
    require_columns(points, held.columns(), name);
    const auto point = as_doubles(points, name);
    if (point.ndim() != 1 || point.shape(0) != d)
      throw py::value_error(name + ": an array of shape (" + std::to_string(d) + ",), not " +
                            shown(point.attr("shape")));
    edits.to = as_points(point.attr("reshape")(1, d), name);
  } else {
    edits.to = as_more_points(held, points, name);
    if (static_cast<std::size_t>(edits.to.shape(0)) != numbers.rows.size())
      throw py::value_error(name + ": an array of shape (" + std::to_string(numbers.rows.size()) + ", " +
                            std::to_string(d) + "), not " + shown(edits.to.attr("shape")));
  }
  edits.move = std::move(numbers.rows);
}

/// The same for weights.
void put_weights(Edits& edits, const Held& held, const py::object& rows, const py::object& weights,
                 const std::string& of) {
  RowNumbers numbers = as_rows(held, rows, of + "rows", "set_weights");
  const std::string name = of + "weights";
  if (numbers.is_single) {
    const auto weight = as_doubles(weights, name);
    if (weight.ndim() != 0) throw py::value_error(name + ": a number, not " + shown(weight.attr("shape")));
    edits.weights = as_weights(weight.attr("reshape")(1), 1, name);
  } else {
    edits.weights = as_weights(weights, static_cast<py::ssize_t>(numbers.rows.size()), name);
  }
  edits.reweight = std::move(numbers.rows);
}

std::pair<py::object, py::object> as_pair(const py::object& object, const char* text) {
  if ((PyTuple_Check(object.ptr()) == 0 && PyList_Check(object.ptr()) == 0) || py::len(object) != 2)
    throw py::type_error(text);
  return {object[py::int_(0)], object[py::int_(1)]};
}

void remove(Held& held, const py::object& rows, const py::object& progress) {
  make(held, {.remove = as_rows(held, rows, "rows", "remove").rows}, progress);
}

void move(Held& held, const py::object& rows, const py::object& points, const py::object& progress) {
  Edits edits;
  put_moves(edits, held, rows, points, "");
  make(held, edits, progress);
}

void set_weights(Held& held, const py::object& rows, const py::object& weights, const py::object& progress) {
  Edits edits;
  put_weights(edits, held, rows, weights, "");
  make(held, edits, progress);
}

void edit(Held& held, const py::object& insert, const py::object& insert_weights, const py::object& remove,
          const py::object& move, const py::object& weights, const py::object& progress) {
  Edits edits;
  if (!insert.is_none()) {
    edits.insert = as_more_points(held, insert, "insert");
    require_index(insert_weights, index_of(insert), "insert_weights");
  }
  const py::ssize_t num_inserted = insert.is_none() ? 0 : edits.insert.shape(0);
  if (!insert_weights.is_none())
    edits.insert_weights = as_weights(insert_weights, num_inserted, "insert_weights");
  else if (held.form() == Form::regular && num_inserted > 0)
    throw py::value_error("insert_weights: an array of shape (" + std::to_string(num_inserted) +
                          ",), not None");
  if (!remove.is_none()) edits.remove = as_rows(held, remove, "remove", "remove").rows;
  if (!move.is_none()) {
    const auto [rows, points] = as_pair(move, "move: a pair (rows, points), or None");
    put_moves(edits, held, rows, points, "move: ");
  }
  if (!weights.is_none()) {
    const auto [rows, numbers] = as_pair(weights, "weights: a pair (rows, weights), or None");
    put_weights(edits, held, rows, numbers, "weights: ");
  }
  make(held, edits, progress);
}

py::object has_row(const Held& held, const py::object& object) {
  const RowNumbers rows = as_rows(held, object, "rows", "has_row");
  py::array_t<bool> answers(static_cast<py::ssize_t>(rows.rows.size()));
  Supervisor supervisor;
  supervisor.run([&, out = answers.mutable_data()] {
    held.with_unsorted([&](const Triangulation& engine) {
      for (std::size_t i = 0; i < rows.rows.size(); ++i) {
        if (rows.rows[i] >= engine.num_rows())
          throw Error(Errc::invalid_argument,
                      place_in("has_row", rows.rows.size(), i) + ": row " + std::to_string(rows.rows[i]) +
                          " is not a row of the input",
                      {i});
        out[i] = engine.has_row(rows.rows[i]);
      }
    });
  });
  return rows.is_single ? py::object(answers[py::int_(0)]) : answers;
}

/// Ids as the arrays of indices have them.
template <class Id>
py::array id_view(const std::vector<Id>& ids, const std::shared_ptr<const void>& owner) {
  static_assert(sizeof(Id) == sizeof(SignedIndex));
  return view<SignedIndex>({reinterpret_cast<const SignedIndex*>(ids.data()), ids.size()},
                           {static_cast<py::ssize_t>(ids.size())}, owner);
}

py::object changes(const Held& held) {
  Supervisor supervisor;
  const auto all = supervisor.run([&] { return held.changes(); });
  if (!all) return py::none();
  return py::module_::import("delone._changes")
      .attr("Changes")(id_view(all->removed_cells, all), id_view(all->created_cells, all),
                       id_view(all->added_vertices, all), id_view(all->removed_vertices, all),
                       id_view(all->hidden_vertices, all), id_view(all->reappeared_vertices, all),
                       id_view(all->moved_vertices, all));
}

py::array cell_ids(const Held& held) {
  return list_view(ask(held, [](const Triangulation& t) {
    std::vector<SignedIndex> ids;
    ids.reserve(t.num_finite_cells());
    for (const CellId c : t.finite_cells()) ids.push_back(static_cast<SignedIndex>(index(c)));
    return ids;
  }));
}

py::array vertex_ids(const Held& held) {
  return list_view(count(held, [](const Triangulation& t) {
    std::vector<SignedIndex> ids(t.num_rows());
    for (std::size_t row = 0; row < ids.size(); ++row)
      ids[row] = static_cast<SignedIndex>(index(t.vertex_at(row)));  // -1 for invalid_vertex
    return ids;
  }));
}

py::tuple compact_ids(Held& held) {
  Supervisor supervisor;
  const CompactedIds ids = supervisor.run([&] { return held.compact_ids(); });
  held.set_row_index(py::none());
  const auto signed_ids = [](const auto& from, auto number) {
    std::vector<SignedIndex> to(from.size());
    std::transform(from.begin(), from.end(), to.begin(), number);
    return list_view(std::move(to));
  };
  return py::make_tuple(
      signed_ids(ids.vertices, [](VertexId v) { return static_cast<SignedIndex>(index(v)); }),
      signed_ids(ids.rows, [](std::size_t row) { return static_cast<SignedIndex>(row); }));
}

template <class T>
std::shared_ptr<T> clone(const T& held) {
  auto copy = std::make_shared<T>(held.dimension(), held.arguments());
  Supervisor supervisor;
  supervisor.run([&] { copy->become_copy_of(held); });
  copy->set_columns(held.columns());
  copy->set_row_index(held.row_index());
  return copy;
}

/// For copy.copy() and copy.deepcopy(): a clone; of a class derived in Python what its pickle makes.
template <class T>
py::object copy(const py::object& self) {
  const T& held = self.cast<const T&>();
  const py::type type = py::type::of(self);
  if (type.is(py::type::of<T>())) return py::cast(clone(held));
  const py::object made = type.attr("__new__")(type);
  made.attr("__setstate__")(self.attr("__getstate__")());
  return made;
}

/// All threads lock the one at the lower address first, so that none waits for another in a circle.
py::tuple changes_of_neighbors(const Held& before, const Held& after) {
  Supervisor supervisor;
  return as_tuple(supervisor.run([&] {
    if (&before == &after)
      return before.with_unsorted([](const Triangulation& t) { return changed_neighbors(t, t); });
    const bool in_order = std::less<>()(&before, &after);
    return (in_order ? before : after).with_unsorted([&](const Triangulation& first) {
      return (in_order ? after : before).with_unsorted([&](const Triangulation& second) {
        return in_order ? changed_neighbors(first, second) : changed_neighbors(second, first);
      });
    });
  }));
}

py::array hidden(const Held& held) {
  return list_view(count(held, [](const Triangulation& t) {
    const std::vector<std::size_t> rows = t.hidden_rows();
    return std::vector<SignedIndex>(rows.begin(), rows.end());
  }));
}

template <class... Arguments>
void change(Held& held, void (Held::*member)(Arguments...), Arguments... arguments) {
  Supervisor supervisor;
  supervisor.run([&] { (held.*member)(arguments...); });
}

py::tuple state(const Held& held) {
  const BuildArguments& a = held.arguments();
  for (;;) {
    const std::uint64_t version = held.version();
    Supervisor supervisor;
    const std::vector<std::size_t> batches = supervisor.run([&] { return held.batches(); });
    const py::array rows = points_of(held);
    const py::object numbers = held.form() == Form::regular ? py::object(weights_of(held)) : py::none();
    if (version == held.version())  // no other thread has changed it meanwhile
      return py::make_tuple(held.dimension(), rows, numbers, batches_to_state(batches), a.seed, a.order,
                            a.threads, held.columns());
  }
}

/// The rows that were removed: all their coordinates are NaN.
std::vector<std::size_t> removed_rows(const py::array_t<double>& points) {
  std::vector<std::size_t> removed;
  if (points.ndim() != 2 || points.shape(1) == 0) return removed;
  const auto d = static_cast<std::size_t>(points.shape(1));
  const double* const first = points.data();
  for (std::size_t row = 0; row < static_cast<std::size_t>(points.shape(0)); ++row)
    if (std::all_of(first + row * d, first + (row + 1) * d, [](double x) { return std::isnan(x); }))
      removed.push_back(row);
  return removed;
}

/// The array with the first row that was not removed, or 0, in the places of those that were.
py::array_t<double> with_rows_filled(const py::array_t<double>& array,
                                     const std::vector<std::size_t>& removed) {
  const auto rows = static_cast<std::size_t>(array.shape(0));
  const std::size_t width = rows == 0 ? 0 : static_cast<std::size_t>(array.size()) / rows;
  py::array_t<double> filled(array.attr("copy")("C"));
  double* const first = filled.mutable_data();
  std::size_t kept = 0;
  while (kept < removed.size() && removed[kept] == kept) ++kept;
  for (const std::size_t row : removed)
    if (kept < rows)
      std::copy_n(first + kept * width, width, first + row * width);
    else
      std::fill_n(first + row * width, width, 0.0);
  return filled;
}

/// Rows that were removed come as duplicates, which cost nothing, and are removed again.
template <class T>
std::unique_ptr<T> restored(const py::tuple& given) {
  return from_state(given, 8, "a triangulation", [](const py::tuple& state) {
    const auto numbers = as_doubles(state[1], "points");
    const std::vector<std::size_t> removed = removed_rows(numbers);
    const auto points = as_points(removed.empty() ? numbers : with_rows_filled(numbers, removed), "points");
    auto held = std::make_unique<T>(
        state[0].cast<int>(),
        BuildArguments{state[4].cast<std::uint64_t>(), state[5].cast<std::string>(), state[6].cast<int>()});
    py::object weights = py::none();
    if (held->form() == Form::regular) {
      const auto all = as_weights(state[2], points.shape(0), "weights");
      weights = removed.empty() ? all : with_rows_filled(all, removed);
    }
    add_batches(state[3], points.shape(0), [&](const py::slice& rows) {
      add(*held, points[rows], weights.is_none() ? weights : py::object(weights[rows]), py::none());
    });
    if (!removed.empty()) make(*held, {.remove = removed}, py::none());
    held->set_columns(as_columns(state[7], held->dimension()));
    return held;
  });
}

template <class T>
using Class = py::class_<T, Held, std::shared_ptr<T>>;

template <class T>
void bind_copies(Class<T>& type) {
  type.def(py::pickle([](const T& held) { return state(held); },
                      [](const py::tuple& state) { return restored<T>(state); }))
      .def("clone", &clone<T>, text(docs::edits::clone))
      .def("__copy__", &copy<T>)
      .def(
          "__deepcopy__", [](const py::object& self, const py::object&) { return copy<T>(self); }, "memo"_a);
}

template <class T>
void bind_points_only(Class<T>& type) {
  type.def(
      py::init([](const py::object& points, std::uint64_t seed, std::string order, int threads,
                  const py::object& progress, const py::object& memory_limit, const py::object& time_limit) {
        return construct<T>(points, py::none(), seed, std::move(order), threads, progress, memory_limit,
                            time_limit);
      }),
      "points"_a, py::kw_only(), "seed"_a = 0, "order"_a = "automatic", "threads"_a = 0,
      "progress"_a = py::none(), "memory_limit"_a = py::none(), "time_limit"_a = py::none());
  type.def(
      "insert_range",
      [](T& held, const py::object& points, const py::object& progress) {
        add(held, points, py::none(), progress);
      },
      "points"_a, py::kw_only(), "progress"_a = py::none(), text(docs::edits::insert_range));
  type.def(
      "edit",
      [](T& held, const py::object& insert, const py::object& remove, const py::object& move,
         const py::object& progress) { edit(held, insert, py::none(), remove, move, py::none(), progress); },
      py::kw_only(), "insert"_a = py::none(), "remove"_a = py::none(), "move"_a = py::none(),
      "progress"_a = py::none(), text(docs::edits::edit));
  bind_copies(type);
}

}  // namespace

void bind_edits(py::module_& module, py::class_<Held, std::shared_ptr<Held>>& base) {
  module.def("_changed_neighbors", &changes_of_neighbors, "before"_a, "after"_a);
  base.def("remove", &remove, "rows"_a, py::kw_only(), "progress"_a = py::none(), text(docs::edits::remove))
      .def("move", &move, "rows"_a, "points"_a, py::kw_only(), "progress"_a = py::none(),
           text(docs::edits::move))
      .def("has_row", &has_row, "rows"_a, text(docs::edits::has_row))
      .def(
          "record_changes", [](Held& held, bool wanted) { change(held, &Held::record_changes, wanted); },
          "wanted"_a = true, text(docs::edits::record_changes))
      .def_property_readonly("changes", &changes, text(docs::edits::changes))
      .def_property_readonly(
          "cell_ids", &cell_ids,
          "The id of each cell, (m,), increasing; a cell keeps its id as long as it exists.")
      .def_property_readonly("vertex_ids", &vertex_ids, text(docs::edits::vertex_ids))
      .def(
          "record_undo", [](Held& held, bool wanted) { change(held, &Held::record_undo, wanted); },
          "wanted"_a = true, text(docs::edits::record_undo))
      .def_property_readonly(
          "can_undo",
          [](const Held& h) { return count(h, [](const Triangulation& t) { return t.can_undo(); }); },
          "Whether there is an insertion or edit that `undo` can take back.")
      .def(
          "undo", [](Held& held) { change(held, &Held::undo); }, text(docs::edits::undo))
      .def("compact_ids", &compact_ids, text(docs::edits::compact_ids));

  py::class_<HeldDelaunay, Held, std::shared_ptr<HeldDelaunay>> delaunay(module, "Delaunay",
                                                                         text(docs::edits::delaunay));
  bind_points_only(delaunay);

  py::class_<HeldRegular, Held, std::shared_ptr<HeldRegular>> regular(module, "Regular",
                                                                      text(docs::edits::regular));
  regular.def(py::init([](const py::object& points, const py::object& weights, std::uint64_t seed,
                          std::string order, int threads, const py::object& progress,
                          const py::object& memory_limit, const py::object& time_limit) {
                return construct<HeldRegular>(points, weights, seed, std::move(order), threads, progress,
                                              memory_limit, time_limit);
              }),
              "points"_a, "weights"_a, py::kw_only(), "seed"_a = 0, "order"_a = "automatic", "threads"_a = 0,
              "progress"_a = py::none(), "memory_limit"_a = py::none(), "time_limit"_a = py::none());
  regular.def(
      "insert_range",
      [](HeldRegular& held, const py::object& points, const py::object& weights, const py::object& progress) {
        add(held, points, weights, progress);
      },
      "points"_a, "weights"_a, py::kw_only(), "progress"_a = py::none(),
      text(docs::edits::insert_range_regular));
  regular.def("set_weights", &set_weights, "rows"_a, "weights"_a, py::kw_only(), "progress"_a = py::none(),
              text(docs::edits::set_weights));
  regular.def("edit", &edit, py::kw_only(), "insert"_a = py::none(), "insert_weights"_a = py::none(),
              "remove"_a = py::none(), "move"_a = py::none(), "weights"_a = py::none(),
              "progress"_a = py::none(), text(docs::edits::edit_regular));
  const auto bind_hidden = [](auto& type) {
    type.def_property_readonly("hidden", &hidden, "The hidden rows, increasing.")
        .def_property_readonly(
            "num_hidden",
            [](const Held& h) { return count(h, [](const Triangulation& t) { return t.num_hidden(); }); },
            "The number of hidden rows.");
  };
  regular.def_property_readonly("weights", &weights_of,
                                "The weights, (n,) float64, read-only; NaN for removed rows.");
  bind_hidden(regular);
  bind_copies(regular);

  py::class_<HeldFurthestSite, Held, std::shared_ptr<HeldFurthestSite>> furthest(
      module, "FurthestSite", text(docs::edits::furthest_site));
  bind_points_only(furthest);
  bind_hidden(furthest);
}

}  // namespace delone::python
