// SPDX-License-Identifier: BSD-3-Clause
// delone.ConvexHull.
#include "arrays.hpp"
#include "data_members.hpp"
#include "docstring.hpp"
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
  HeldHull(int dimension, const BuildArguments& arguments, double tolerance)
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
    return guard_.ask([&] { return question(static_cast<const Polytope&>(hull_)); });
  }

  void add(const py::object& points, const py::object& progress) {
    const auto rows = as_points(points, "points");
    require_columns(points, columns_, "points");
    if (rows.shape(1) != dimension())
      throw py::value_error("points: an array of shape (n, " + std::to_string(dimension()) + "), not " +
                            shown(rows.attr("shape")));
    guard_.change(progress, [&, x = numbers(rows)] {
      batches_.reserve(batches_.size() + 1);
      hull_.insert_range(x);
      if (!x.empty()) batches_.push_back(x.size() / static_cast<std::size_t>(dimension()));
      data_.reset();
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
    return ask([this](const Polytope& hull) {
      const std::lock_guard lock(data_mutex_);
      if (!data_) data_ = std::make_shared<const HullData>(hull.to_data());
      return data_;
    });
  }
  std::vector<std::size_t> batches() const {
    return ask([this](const Polytope&) { return batches_; });
  }

 private:
  static Options with_tolerance(Options options, double tolerance) {
    options.tolerance = tolerance;
    return options;
  }

  BuildArguments arguments_;
  py::object columns_ = py::none(), index_ = py::none();
  Guard guard_;  // of all members below
  ConvexHull<> hull_;
  std::vector<std::size_t> batches_;
  mutable std::mutex data_mutex_;  // of data_, under the guard
  mutable std::shared_ptr<const HullData> data_;
};

std::unique_ptr<HeldHull> construct(const py::object& points, double tolerance, std::uint64_t seed,
                                    std::string order, int threads, const py::object& progress,
                                    const py::object& memory_limit, const py::object& time_limit) {
  const auto rows = as_points(points, "points");
  auto held =
      std::make_unique<HeldHull>(static_cast<int>(rows.shape(1)),
                                 BuildArguments{seed, std::move(order), threads,
                                                as_memory_limit(memory_limit), as_time_limit(time_limit)},
                                 tolerance);
  held->add(rows, progress);
  held->set_columns(columns_of(points));
  held->set_row_index(index_of(points));
  return held;
}

py::tuple of_extreme_points(const py::object& points, double tolerance, std::uint64_t seed, std::string order,
                            int threads, const py::object& progress, const py::object& memory_limit,
                            const py::object& time_limit) {
  const auto rows = as_points(points, "points");
  auto held =
      std::make_unique<HeldHull>(static_cast<int>(rows.shape(1)),
                                 BuildArguments{seed, std::move(order), threads,
                                                as_memory_limit(memory_limit), as_time_limit(time_limit)},
                                 tolerance);
  py::array which = list_view(held->add_extreme(rows, progress));
  held->set_columns(columns_of(points));
  if (const py::object index = index_of(points); !index.is_none()) held->set_row_index(index[which]);
  return py::make_tuple(py::cast(std::move(held)), which);
}

std::size_t width(const HullData& data) {
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
  held.ask([&](const Polytope& hull) {
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
  held.ask([&, x = queries.coordinates(), out = result.mutable_data()](const Polytope& hull) {
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
      held.ask([x = query.coordinates()](const Polytope& hull) { return hull.visible_facets(x); }));
}

py::dict statistics(const HeldHull& held) {
  return as_dict(held.ask([](const Polytope& hull) { return hull.statistics(); }));
}

std::string repr(const HeldHull& held) {
  return held.ask([](const Polytope& hull) {
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
  held.ask([&](const Polytope& hull) {
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
  const double tolerance = held.ask([](const Polytope& hull) { return hull.tolerance(); });
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
        state[6].cast<double>());
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

constexpr const char* hull_doc = R"(
ConvexHull(points, *, tolerance=0.0, seed=0, order='automatic', threads=0, progress=None, memory_limit=None,
           time_limit=None)

The convex hull of points, (n, d) numbers that are exact in float64, in any dimension d >= 1.

Exact: a function of the set of points. Duplicates are merged, and flat points have the hull in their flat, of
affine dimension k <= d. A *cell* is a simplex of the boundary with k vertices; a *facet* is one of the polytope
and consists of one cell, or of several in one hyperplane. Index arrays are int32, and read-only as all arrays.
Arguments and errors as in Delaunay; methods release the GIL.

tolerance, a distance >= 0 with the unit of the coordinates: if positive, the exact hull of some of the points, so few
that none can be left out, such that no point is farther than this outside of it; `max_distance` bounds how far. It is
convex and closed, its vertices are rows of the input, and distances are decided exactly. The farthest points are taken
first. A facet consists of cells whose vertices are within the tolerance of the plane of its largest cell, which is that
of `equations`. Points near a flat of fewer dimensions have the hull of their projections on `axes` in it.
ValueError if it is negative, NaN, infinite, or larger than the set along every axis.

Cost: O(n) cells for evenly spread points,
at worst O(n^(d/2)). Source: incremental insertion with perturbed ties, doi:10.1016/j.comgeo.2010.09.010.)";

constexpr const char* of_extreme_points_doc = R"(
The hull of the extreme ones of points, (n, d), alone: (hull, rows), where row i of the hull is points[rows[i]]. The
hull may have other rows, too, in no particular order, but all vertices of its cells are extreme. Where many points lie
in the hyperplanes of facets there are far fewer cells than in the hull of all points. Arguments, errors and exactness
as in the constructor. A copy by pickling may number cells otherwise.)";

constexpr const char* insert_range_doc = R"(
Adds points, (n, d), as the next rows: all of them, or none if it raises. Arrays taken before stay as they are.
Errors as in the constructor; ValueError for another number of columns. Cost: that of the new points, unless one
raises the affine dimension: then the hull is built anew.)";

constexpr const char* locate_doc = R"(
Where each query (..., d) lies, exactly: a delone.Locations, one entry for each query. Kinds: inside, on_boundary,
outside, outside_affine_hull. `cell`: from outside a cell that is visible; on the boundary one whose hyperplane
contains the query; inside one that a ray from an interior point through the query leaves by; else -1. `face`: on
the boundary the extreme rows of the smallest face that contains the query. InputError for NaN or infinity. Cost: a
walk over cells for each query.)";

constexpr const char* neighbors_doc = R"(
(m, k) cells: neighbor j is across the ridge opposite vertex j of the cell. All are >= 0: a boundary has no end.)";

constexpr const char* ridges_doc = R"(
(facets (r, 2), offsets (r+1,), rows): the two facets that meet in ridge i, the smaller number first, and its
extreme rows, rows[offsets[i]:offsets[i+1]], increasing.)";

constexpr const char* equations_doc = R"(
(f, d+1) float64: the unit outward normal and the offset of each facet, with the unit of the coordinates;
normal . x + offset <= 0 inside, up to equation_errors. For k < d normals are parallel to the flat.)";

constexpr const char* equation_errors_doc = R"(
(f,) float64: the largest difference between the exact signed distance of a point of the hull from the facet and
that of the rounded equation, evaluated without error; infinite when k < d.)";

constexpr const char* plane_distance_doc = R"(
(..., f) float64: the signed distances of queries (..., d) from the hyperplanes of the facets, positive outside.
Rounded; where a sign must be exact take locate() or visible_facets(). Cost:
O(f d) for each query.)";

constexpr const char* visible_facets_doc = R"(
The facets that have the point, (d,), strictly beyond their hyperplane, exactly; increasing numbers. Empty for a point
of the hull, or off its flat. InputError for NaN or infinity. Cost: that of the visible cells, and a walk.)";

constexpr const char* statistics_doc = R"(
What the construction has cost: a dict of counts (created_cells, visited_cells, insertions, and the tests decided by
the stages filter, direct, exact, perturbed), order_seconds, build_seconds and cell_bytes.)";

}  // namespace

void bind_convex_hull(py::module_& module) {
  py::class_<HeldHull> type(module, "ConvexHull", text(hull_doc));
  type.def(py::init(&construct), "points"_a, py::kw_only(), "tolerance"_a = 0.0, "seed"_a = 0,
           "order"_a = "automatic", "threads"_a = 0, "progress"_a = py::none(), "memory_limit"_a = py::none(),
           "time_limit"_a = py::none());
  type.def_static("of_extreme_points", &of_extreme_points, "points"_a, py::kw_only(), "tolerance"_a = 0.0,
                  "seed"_a = 0, "order"_a = "automatic", "threads"_a = 0, "progress"_a = py::none(),
                  "memory_limit"_a = py::none(), "time_limit"_a = py::none(), text(of_extreme_points_doc));
  type.def("insert_range", &HeldHull::add, "points"_a, py::kw_only(), "progress"_a = py::none(),
           text(insert_range_doc));
  type.def_property_readonly("dimension", &HeldHull::dimension,
                             "d >= 1, the number of coordinates of a point.")
      .def_property_readonly(
          "affine_dimension", asking([](const Polytope& h) { return h.affine_dimension(); }),
          "k <= d, of the smallest flat that contains all points; 0 for one distinct point, "
          "-1 for none.")
      .def_property_readonly("tolerance", asking([](const Polytope& h) { return h.tolerance(); }),
                             "The argument of the constructor; 0.0: the hull is exact.")
      .def_property_readonly(
          "max_distance", asking([](const Polytope& h) { return h.max_distance(); }),
          "No point is farther outside of the hull than this: a bound, rounded up, at most `tolerance`.")
      .def_property_readonly(
          "axes",
          [](const HeldHull& h) {
            return py::tuple(py::cast(h.ask([](const Polytope& p) { return p.axes(); })));
          },
          "k coordinate axes onto which the flat of the points projects one-to-one, increasing: a tuple.")
      .def_property_readonly("num_points", asking([](const Polytope& h) { return h.num_points(); }),
                             "n, the rows of the input, duplicates included.")
      .def_property_readonly("num_duplicates", asking([](const Polytope& h) { return h.num_duplicates(); }),
                             "How many rows are equal to an earlier one.")
      .def_property_readonly("num_vertices", asking([](const Polytope& h) { return h.num_vertices(); }),
                             "How many distinct points are extreme: in no segment between two others.")
      .def_property_readonly("num_cells", asking([](const Polytope& h) { return h.num_cells(); }),
                             "m, the simplices of the boundary.")
      .def_property_readonly("num_facets", asking([](const Polytope& h) { return h.num_facets(); }),
                             "f, the facets of the polytope; also len().")
      .def_property_readonly("num_ridges", asking([](const Polytope& h) { return h.num_ridges(); }),
                             "r, the ridges of the polytope: where two facets meet.")
      .def("__len__", asking([](const Polytope& h) { return h.num_facets(); }))
      .def_property_readonly("columns", &HeldHull::columns, "As those of Delaunay.")
      .def_property_readonly("_index", &HeldHull::row_index)
      .def("_sample", &sample, "limit"_a)
      .def_property_readonly("points", &points, "(n, d) float64: all rows of the input, in their order.")
      .def_property_readonly(
          "cells",
          [](const HeldHull& h) {
            const auto data = h.data();
            return rows_view(data->cells, data->num_cells(), width(*data), data);
          },
          "(m, k) input rows, in no particular order. With a point inside put first each is positively "
          "oriented when k = d > 1.")
      .def_property_readonly(
          "neighbors",
          [](const HeldHull& h) {
            const auto data = h.data();
            return rows_view(data->neighbors, data->num_cells(), width(*data), data);
          },
          text(neighbors_doc))
      .def_property_readonly("facet_of_cell", &list_of<&HullData::facet_of_cell>,
                             "(m,) numbers 0 ... f-1: the facet each cell is part of.")
      .def_property_readonly("vertices", &list_of<&HullData::vertices>,
                             "The rows of the extreme points, increasing; of equal rows the first.")
      .def_property_readonly("vertex_of_point", &list_of<&HullData::vertex_of_point>,
                             "(n,) the first row that is equal to each row.")
      .def_property_readonly(
          "facets",
          [](const HeldHull& h) {
            return py::make_tuple(list_of<&HullData::facet_offsets>(h),
                                  list_of<&HullData::facet_vertices>(h));
          },
          "(offsets (f+1,), rows): the extreme rows of facet i are rows[offsets[i]:offsets[i+1]], "
          "increasing.")
      .def_property_readonly(
          "ridges",
          [](const HeldHull& h) {
            const auto data = h.data();
            return py::make_tuple(rows_view(data->ridge_facets, data->num_ridges(), 2, data),
                                  list_view(data->ridge_offsets, data),
                                  list_view(data->ridge_vertices, data));
          },
          text(ridges_doc))
      .def_property_readonly(
          "equations",
          [](const HeldHull& h) {
            const auto data = h.data();
            return rows_view(data->equations, data->num_facets(),
                             static_cast<std::size_t>(data->dimension) + 1, data);
          },
          text(equations_doc))
      .def_property_readonly(
          "equation_errors",
          [](const HeldHull& h) {
            const auto data = h.data();
            return list_view(data->equation_errors, data);
          },
          text(equation_errors_doc))
      .def_property_readonly(
          "point_kinds",
          [](const HeldHull& h) {
            const auto data = h.data();
            return view<std::uint8_t>(
                {reinterpret_cast<const std::uint8_t*>(data->point_kinds.data()), data->point_kinds.size()},
                {static_cast<py::ssize_t>(data->point_kinds.size())}, data);
          },
          "(n,) uint8: 0 extreme, 1 on the boundary otherwise (or outside, within the tolerance), 2 "
          "interior, 3 "
          "equal to an earlier row.")
      .def_property_readonly(
          "volume", asking([](const Polytope& h) { return h.volume().value; }),
          "The k-dimensional volume, >= 0, off by at most volume_error; 0 for k < 1. Cost: O(m d^3), once.")
      .def_property_readonly(
          "volume_error", asking([](const Polytope& h) { return h.volume().error; }),
          "A bound of how far `volume` is from the exact one; infinite where numbers overflow.")
      .def_property_readonly(
          "area", asking([](const Polytope& h) { return h.area().value; }),
          "The (k-1)-dimensional volume of the boundary, >= 0, off by at most area_error; 2 for k = 1.")
      .def_property_readonly(
          "area_error", asking([](const Polytope& h) { return h.area().error; }),
          "A bound of how far `area` is from the exact one; infinite where numbers overflow.")
      .def_property_readonly(
          "f_vector",
          [](const HeldHull& h) {
            return py::tuple(py::cast(h.ask([](const Polytope& p) { return p.f_vector(); })));
          },
          "The number of faces of the polytope of each dimension 0 ... k-1: a tuple. With a tolerance, faces "
          "are "
          "the sets of vertices that facets have in common. Cost: up to O(faces f "
          "k), "
          "and memory for all faces of one dimension.")
      .def_property_readonly("hash", asking([](const Polytope& h) { return h.hash().hex(); }),
                             "32 hexadecimal digits that depend on the coordinates of the cells' vertices "
                             "and the set of cells only; the command prints the same. Cost: O(m k).")
      .def_property_readonly("statistics", &statistics, text(statistics_doc))
      .def(
          "contains", &contains, "queries"_a,
          "Whether each query (..., d) is inside or on the boundary, exactly: (...) bool. Errors and cost as "
          "in locate().")
      .def("locate", &locate, "queries"_a, text(locate_doc))
      .def("plane_distance", &plane_distance, "queries"_a, text(plane_distance_doc))
      .def("visible_facets", &visible_facets, "point"_a, text(visible_facets_doc))
      .def("_data",
           [](const HeldHull& h) { return to_python(h.ask([](const Polytope& p) { return p.to_data(); })); })
      .def("__repr__", &repr)
      .def(py::pickle(&state_of_hull, &restored_hull));
  define_save(type, [](const HeldHull& held, const SaveArguments& to) {
    held.ask([&](const Polytope& p) { to.save(p, [&] { return p.to_data(); }); });
  });
  define_to_html(type,
                 [](const HeldHull& h, const HtmlOptions& options) { return html_of(h.data(), options); });
}

}  // namespace delone::python
