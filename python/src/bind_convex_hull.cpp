// SPDX-License-Identifier: BSD-3-Clause
// delone.ConvexHull.
#include "arrays.hpp"
#include "data_members.hpp"
#include "docs_convex_hull.hpp"
#include "docs_polyhedra.hpp"
#include "docstring.hpp"
#include "held_polyhedron.hpp"
#include "html.hpp"
#include "module.hpp"
#include "pickling.hpp"
#include "running.hpp"
#include "saving.hpp"

#include <pybind11/stl.h>

#include <delone/convex_hull.hpp>

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;

/// A hull and its arrays.
class HeldHull {
 public:
  HeldHull(int dimension, const BuildArguments& arguments, const Tolerances& tolerance)
      : arguments_(arguments), hull_(dimension, with_tolerance(arguments.to_options(), tolerance)) {}

  int dimension() const { return hull_.dimension(); }
  const BuildArguments& arguments() const { return arguments_; }
  /// The labels of the columns of the DataFrame that it was made of, a tuple, or None.
  const py::object& columns() const { return columns_; }
  void set_columns(py::object columns) { columns_ = std::move(columns); }
  /// The index of the DataFrame, see index_of(); None once rows were added.
  const py::object& row_index() const { return index_; }
  void set_row_index(py::object index) { index_ = std::move(index); }

  /// Returns question(hull).
  template <class Question>
  auto ask(Question question) const {
    return guard_.ask([&] { return question(static_cast<const ConvexHullBase&>(hull_)); });
  }

  void add(const py::object& points, const py::object& progress) {
    const auto rows = as_more_points(points, dimension(), "points");
    require_columns(points, columns_, "points");
    guard_.change(progress, [&, x = numbers(rows)] {
      batches_.reserve(batches_.size() + 1);
      hull_.insert_range(x);
      if (!x.empty()) batches_.push_back(x.size() / static_cast<std::size_t>(dimension()));
      data_.reset();
      cells_.reset();
    });
    if (rows.shape(0) > 0) index_ = py::none();
  }

  /// The extreme ones of points, into a hull without rows; which of the points its rows are.
  std::vector<SignedIndex> add_extreme(const py::array_t<double>& points, const py::object& progress) {
    std::vector<SignedIndex> rows;
    guard_.change(progress, [&, x = numbers(points)] {
      rows = hull_.insert_extreme_points(x);
      if (!rows.empty()) batches_.push_back(rows.size());
    });
    return rows;
  }

  /// The arrays. Later insertions do not change them.
  std::shared_ptr<const HullData> data() const {
    return ask([this](const ConvexHullBase& hull) {
      const std::lock_guard lock(data_mutex_);
      if (!data_) data_ = std::make_shared<const HullData>(hull.to_data());
      return data_;
    });
  }
  /// Those of them that cost little. Later insertions do not change them.
  std::shared_ptr<const HullCells> cells() const {
    return ask([this](const ConvexHullBase& hull) {
      const std::lock_guard lock(data_mutex_);
      if (!cells_) cells_ = std::make_shared<const HullCells>(hull.to_cells());
      return cells_;
    });
  }
  std::vector<std::size_t> batches() const {
    return ask([this](const ConvexHullBase&) { return batches_; });
  }

 private:
  static Options with_tolerance(Options options, const Tolerances& tolerance) {
    options.tolerance = tolerance.tolerance;
    options.axis_tolerances = tolerance.of_axes;
    return options;
  }

  BuildArguments arguments_;
  py::object columns_ = py::none(), index_ = py::none();
  Guard guard_;  // of all members below
  ConvexHull<> hull_;
  std::vector<std::size_t> batches_;
  mutable std::mutex data_mutex_;  // of what follows, under the guard
  mutable std::shared_ptr<const HullData> data_;
  mutable std::shared_ptr<const HullCells> cells_;
};

std::unique_ptr<HeldHull> construct(const py::object& points, const py::object& tolerance, std::uint64_t seed,
                                    std::string order, int threads, const py::object& progress,
                                    const py::object& memory_limit, const py::object& time_limit) {
  const auto rows = as_points(points, "points");
  auto held =
      std::make_unique<HeldHull>(static_cast<int>(rows.shape(1)),
                                 BuildArguments{seed, std::move(order), threads,
                                                as_memory_limit(memory_limit), as_time_limit(time_limit)},
                                 as_tolerances(tolerance, static_cast<int>(rows.shape(1))));
  held->add(rows, progress);
  held->set_columns(columns_of(points));
  held->set_row_index(index_of(points));
  return held;
}

py::tuple of_extreme_points(const py::object& points, const py::object& tolerance, std::uint64_t seed,
                            std::string order, int threads, const py::object& progress,
                            const py::object& memory_limit, const py::object& time_limit) {
  const auto rows = as_points(points, "points");
  auto held =
      std::make_unique<HeldHull>(static_cast<int>(rows.shape(1)),
                                 BuildArguments{seed, std::move(order), threads,
                                                as_memory_limit(memory_limit), as_time_limit(time_limit)},
                                 as_tolerances(tolerance, static_cast<int>(rows.shape(1))));
  py::array which = list_view(held->add_extreme(rows, progress));
  held->set_columns(columns_of(points));
  if (const py::object index = index_of(points); !index.is_none()) held->set_row_index(index[which]);
  return py::make_tuple(py::cast(std::move(held)), which);
}

template <class Data>
std::size_t width(const Data& data) {
  return static_cast<std::size_t>(std::max(data.affine_dimension, 0));
}

template <std::vector<SignedIndex> HullData::*Member>
py::array list_of(const HeldHull& held) {
  const auto data = held.data();
  return list_view((*data).*Member, data);
}

py::object locate(const HeldHull& held, const py::object& object) {
  const Queries queries(object, held);
  const std::size_t count = queries.size(), d = static_cast<std::size_t>(held.dimension());
  std::vector<std::uint8_t> kinds(count);
  std::vector<SignedIndex> cells(count), rows;
  std::vector<std::int64_t> offsets{0};
  const auto x = queries.coordinates();
  held.ask([&](const ConvexHullBase& hull) {
    for (std::size_t i = 0; i < count; ++i) {
      cancellation_point();
      const Containment where = hull.locate(x.subspan(i * d, d));
      kinds[i] = static_cast<std::uint8_t>(where.kind);
      cells[i] = where.cell;
      rows.insert(rows.end(), where.face.begin(), where.face.end());
      offsets.push_back(static_cast<std::int64_t>(rows.size()));
    }
  });
  return py::module_::import("delone._locations")
      .attr("Locations")(list_view(std::move(kinds)), list_view(std::move(cells)),
                         list_view(std::move(offsets)), list_view(std::move(rows)),
                         py::make_tuple("inside", "on_boundary", "outside", "outside_affine_hull"));
}

py::object contains(const HeldHull& held, const py::object& object) {
  const Queries queries(object, held);
  auto result = queries.answers<bool>();
  const std::size_t d = static_cast<std::size_t>(held.dimension());
  held.ask([&, x = queries.coordinates(), out = result.mutable_data()](const ConvexHullBase& hull) {
    for (std::size_t i = 0; i < x.size() / d; ++i) {
      cancellation_point();
      out[i] = hull.contains(x.subspan(i * d, d));
    }
  });
  return Queries::scalar_if_single(result);
}

py::array plane_distance(const HeldHull& held, const py::object& object) {
  const Queries queries(object, held);
  const auto data = held.data();
  const std::size_t facets = data->num_facets(), d = static_cast<std::size_t>(held.dimension());
  auto result = queries.answers<double>({facets});
  const auto x = queries.coordinates();
  double* out = result.mutable_data();
  Supervisor supervisor;
  supervisor.run([&] {
    for (std::size_t i = 0; i < x.size() / d; ++i) {
      cancellation_point();
      for (std::size_t f = 0; f < facets; ++f) {
        const double* const equation = data->equations.data() + f * (d + 1);
        double sum = equation[d];
        for (std::size_t j = 0; j < d; ++j) sum += equation[j] * x[i * d + j];
        *out++ = sum;
      }
    }
  });
  return result;
}

py::array visible_facets(const HeldHull& held, const py::object& point) {
  const Queries query(point, held, "point");
  if (query.size() != 1) throw py::value_error("point: one point of shape (d,)");
  return list_view(
      held.ask([x = query.coordinates()](const ConvexHullBase& hull) { return hull.visible_facets(x); }));
}

py::dict statistics(const HeldHull& held) {
  return as_dict(held.ask([](const ConvexHullBase& hull) { return hull.statistics(); }));
}

std::string repr(const HeldHull& held) {
  return held.ask([](const ConvexHullBase& hull) {
    std::string text = "<delone.ConvexHull: " + std::to_string(hull.num_points()) + " points in dimension " +
                       std::to_string(hull.dimension());
    if (hull.affine_dimension() < hull.dimension())
      text += ", affine dimension " + std::to_string(hull.affine_dimension());
    return text + ", " + std::to_string(hull.num_vertices()) + " vertices, " +
           std::to_string(hull.num_facets()) + " facets>";
  });
}

py::array points(const HeldHull& held) {
  const auto data = held.data();
  return rows_view(data->points, data->num_points(), static_cast<std::size_t>(data->dimension), data);
}

/// What pictures are drawn from: the vertices of up to `limit` cells, evenly chosen, (s, k, d) float64, and
/// the facets that these belong to, (s,).
py::tuple sample(const HeldHull& held, std::size_t limit) {
  std::vector<double> corners;
  std::vector<SignedIndex> facets;
  std::size_t k = 0;
  held.ask([&](const ConvexHullBase& hull) {
    const HullData& data = hull.data();
    k = width(data);
    const std::size_t step = data.num_cells() / std::max<std::size_t>(limit, 1) + 1;
    for (std::size_t cell = 0; cell < data.num_cells(); cell += step) {
      facets.push_back(data.facet_of_cell[cell]);
      for (std::size_t i = 0; i < k; ++i) {
        const auto x = hull.point(static_cast<std::size_t>(data.cells[cell * k + i]));
        corners.insert(corners.end(), x.begin(), x.end());
      }
    }
  });
  const auto d = static_cast<std::size_t>(held.dimension());
  const std::size_t count = facets.size();
  return py::make_tuple(rows_view(std::move(corners), count * k, d).attr("reshape")(count, k, d),
                        list_view(std::move(facets)));
}

py::tuple state_of_hull(const HeldHull& held) {
  const BuildArguments& a = held.arguments();
  const auto of_axes = held.ask([](const ConvexHullBase& hull) { return hull.axis_tolerances(); });
  const py::object tolerance =
      as_argument(held.ask([](const ConvexHullBase& hull) { return hull.tolerance(); }), of_axes);
  for (;;) {
    const std::vector<std::size_t> batches = held.batches();
    const py::array rows = points(held);
    // Other threads may have added rows meanwhile.
    if (num_rows(batches) == static_cast<std::size_t>(rows.shape(0)))
      return py::make_tuple(held.dimension(), rows, batches_to_state(batches), a.seed, a.order, a.threads,
                            tolerance, held.columns());
  }
}

std::unique_ptr<HeldHull> restored_hull(const py::tuple& given) {
  return from_state(given, 8, "a hull", [](const py::tuple& state) {
    const auto points = as_points(state[1], "points");
    auto held = std::make_unique<HeldHull>(
        state[0].cast<int>(),
        BuildArguments{state[3].cast<std::uint64_t>(), state[4].cast<std::string>(), state[5].cast<int>()},
        as_tolerances(state[6], state[0].cast<int>()));
    add_batches(state[2], points.shape(0),
                [&](const py::slice& rows) { held->add(points[rows], py::none()); });
    held->set_columns(as_columns(state[7], held->dimension()));
    return held;
  });
}

template <class Question>
auto asking(Question question) {
  return [question](const HeldHull& held) { return held.ask(question); };
}

}  // namespace

void bind_convex_hull(py::module_& module) {
  py::class_<HeldHull> type(module, "ConvexHull", text(docs::convex_hull::hull));
  type.def(py::init(&construct), "points"_a, py::kw_only(), "tolerance"_a = 0.0, "seed"_a = 0,
           "order"_a = "automatic", "threads"_a = 0, "progress"_a = py::none(), "memory_limit"_a = py::none(),
           "time_limit"_a = py::none());
  type.def_static("of_extreme_points", &of_extreme_points, "points"_a, py::kw_only(), "tolerance"_a = 0.0,
                  "seed"_a = 0, "order"_a = "automatic", "threads"_a = 0, "progress"_a = py::none(),
                  "memory_limit"_a = py::none(), "time_limit"_a = py::none(),
                  text(docs::convex_hull::of_extreme_points));
  type.def("insert_range", &HeldHull::add, "points"_a, py::kw_only(), "progress"_a = py::none(),
           text(docs::convex_hull::insert_range));
  type.def_property_readonly("dimension", &HeldHull::dimension,
                             "The number d >= 1 of coordinates of a point.")
      .def_property_readonly("affine_dimension",
                             asking([](const ConvexHullBase& h) { return h.affine_dimension(); }),
                             "The dimension k <= d of the smallest flat that contains all points; 0 for one "
                             "distinct point, -1 for none.")
      .def_property_readonly("tolerance", asking([](const ConvexHullBase& h) { return h.tolerance(); }),
                             "The tolerance of the constructor, the largest one of those of the axes; 0.0: "
                             "the hull is exact.")
      .def_property_readonly(
          "axis_tolerances",
          [](const HeldHull& h) {
            return list_view(h.ask([](const ConvexHullBase& p) { return p.axis_tolerances(); }));
          },
          text(docs::convex_hull::axis_tolerances))
      .def_property_readonly("max_distance", asking([](const ConvexHullBase& h) { return h.max_distance(); }),
                             "A bound, rounded up, on the distance of points outside the hull; at most "
                             "`tolerance`. If axes have tolerances of their own, as along the axis of the "
                             "largest.")
      .def_property_readonly(
          "axes",
          [](const HeldHull& h) {
            return py::tuple(py::cast(h.ask([](const ConvexHullBase& p) { return p.axes(); })));
          },
          "The k coordinate axes onto which the flat of the points projects one-to-one, increasing, a tuple.")
      .def_property_readonly("num_points", asking([](const ConvexHullBase& h) { return h.num_points(); }),
                             "The number n of input rows, duplicates included.")
      .def_property_readonly("num_duplicates",
                             asking([](const ConvexHullBase& h) { return h.num_duplicates(); }),
                             "The number of rows that are equal to an earlier one.")
      .def_property_readonly("num_vertices", asking([](const ConvexHullBase& h) { return h.num_vertices(); }),
                             "The number of distinct extreme points: those in no segment between two others.")
      .def_property_readonly("num_cells", asking([](const ConvexHullBase& h) { return h.num_cells(); }),
                             "The number m of simplices of the boundary.")
      .def_property_readonly("num_facets", asking([](const ConvexHullBase& h) { return h.num_facets(); }),
                             "The number f of facets of the polytope; also len().")
      .def_property_readonly("num_ridges", asking([](const ConvexHullBase& h) { return h.num_ridges(); }),
                             "The number r of ridges of the polytope, in which two facets meet.")
      .def("__len__", asking([](const ConvexHullBase& h) { return h.num_facets(); }))
      .def_property_readonly("columns", &HeldHull::columns,
                             "The labels of the columns of the DataFrame it was made of, a tuple, or None; "
                             "see `Delaunay.columns`.")
      .def_property_readonly("_index", &HeldHull::row_index)
      .def("_sample", &sample, "limit"_a)
      .def_property_readonly("points", &points, "All input rows in their order, (n, d) float64.")
      .def_property_readonly(
          "cells",
          [](const HeldHull& h) {
            const auto all = h.cells();
            return rows_view(all->cells, all->num_cells(), width(*all), all);
          },
          text(docs::convex_hull::cells))
      .def_property_readonly(
          "neighbors",
          [](const HeldHull& h) {
            const auto all = h.cells();
            return rows_view(all->neighbors, all->num_cells(), width(*all), all);
          },
          "The neighbors of each cell, (m, k) cells: number j is across the ridge opposite vertex j.")
      .def_property_readonly("facet_of_cell", &list_of<&HullData::facet_of_cell>,
                             "The facet of each cell, (m,).")
      .def_property_readonly(
          "vertices",
          [](const HeldHull& h) {
            const auto all = h.cells();
            return list_view(all->vertices, all);
          },
          "The rows of the extreme points, increasing; of equal rows the first.")
      .def_property_readonly("vertex_of_point", &list_of<&HullData::vertex_of_point>,
                             "The first row that is equal to each row, (n,).")
      .def_property_readonly(
          "facets",
          [](const HeldHull& h) {
            return py::make_tuple(list_of<&HullData::facet_offsets>(h),
                                  list_of<&HullData::facet_vertices>(h));
          },
          text(docs::convex_hull::facets))
      .def_property_readonly(
          "ridges",
          [](const HeldHull& h) {
            const auto data = h.data();
            return py::make_tuple(rows_view(data->ridge_facets, data->num_ridges(), 2, data),
                                  list_view(data->ridge_offsets, data),
                                  list_view(data->ridge_vertices, data));
          },
          text(docs::convex_hull::ridges))
      .def_property_readonly(
          "equations",
          [](const HeldHull& h) {
            const auto data = h.data();
            return rows_view(data->equations, data->num_facets(),
                             static_cast<std::size_t>(data->dimension) + 1, data);
          },
          text(docs::convex_hull::equations))
      .def_property_readonly(
          "equation_errors",
          [](const HeldHull& h) {
            const auto data = h.data();
            return list_view(data->equation_errors, data);
          },
          text(docs::convex_hull::equation_errors))
      .def_property_readonly(
          "point_kinds",
          [](const HeldHull& h) {
            const auto data = h.data();
            return view<std::uint8_t>(
                {reinterpret_cast<const std::uint8_t*>(data->point_kinds.data()), data->point_kinds.size()},
                {static_cast<py::ssize_t>(data->point_kinds.size())}, data);
          },
          text(docs::convex_hull::point_kinds))
      .def_property_readonly("volume", asking([](const ConvexHullBase& h) { return h.volume().value; }),
                             text(docs::convex_hull::volume))
      .def_property_readonly("volume_error", asking([](const ConvexHullBase& h) { return h.volume().error; }),
                             "A bound on the error of `volume`; infinite if numbers overflow.")
      .def_property_readonly(
          "area", asking([](const ConvexHullBase& h) { return h.area().value; }),
          "The (k-1)-dimensional volume of the boundary, off by at most `area_error`; 2 for k = 1.")
      .def_property_readonly("area_error", asking([](const ConvexHullBase& h) { return h.area().error; }),
                             "A bound on the error of `area`; infinite if numbers overflow.")
      .def_property_readonly(
          "f_vector",
          [](const HeldHull& h) {
            return py::tuple(py::cast(h.ask([](const ConvexHullBase& p) { return p.f_vector(); })));
          },
          text(docs::convex_hull::f_vector))
      .def_property_readonly("hash", asking([](const ConvexHullBase& h) { return h.hash().hex(); }),
                             text(docs::convex_hull::hash))
      .def_property_readonly("statistics", &statistics, text(docs::convex_hull::statistics))
      .def("contains", &contains, "queries"_a, text(docs::convex_hull::contains))
      .def("locate", &locate, "queries"_a, text(docs::convex_hull::locate))
      .def("plane_distance", &plane_distance, "queries"_a, text(docs::convex_hull::plane_distance))
      .def("visible_facets", &visible_facets, "point"_a, text(docs::convex_hull::visible_facets))
      .def("_data",
           [](const HeldHull& h) {
             return to_python(h.ask([](const ConvexHullBase& p) { return p.to_data(); }));
           })
      .def("__repr__", &repr)
      .def(py::pickle(&state_of_hull, &restored_hull));
  define_save(type, [](const HeldHull& held, const SaveArguments& to) {
    held.ask([&](const ConvexHullBase& p) { to.save(p, [&] { return p.to_data(); }); });
  });
  define_to_polyhedron(type, text(docs::polyhedra::of_hull), [](const HeldHull& h) { return h.data(); });
  define_to_html(type,
                 [](const HeldHull& h, const HtmlOptions& options) { return html_of(h.data(), options); });
}

}  // namespace delone::python
