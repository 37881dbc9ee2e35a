// SPDX-License-Identifier: BSD-3-Clause
// delone.Triangulation: the arrays of Delaunay, Regular and FurthestSite, and their answers. What makes and
// changes them is in bind_edits.cpp.
#include "arrays.hpp"
#include "bind_edits.hpp"
#include "data_members.hpp"
#include "docs_triangulation.hpp"
#include "docstring.hpp"
#include "html.hpp"
#include "module.hpp"
#include "sample.hpp"
#include "saving.hpp"
#include "triangulation.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace delone::python {
namespace {

using namespace py::literals;
using Rows = py::array_t<SignedIndex, py::array::c_style | py::array::forcecast>;
using Reals = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Held = HeldTriangulation;

const char* name_of(const Held& held) {
  return held.form() == Form::regular         ? "Regular"
         : held.form() == Form::furthest_site ? "FurthestSite"
                                              : "Delaunay";
}

std::shared_ptr<const Cells> cells_of(const Held& held) {
  Supervisor supervisor;
  return supervisor.run([&] { return held.cells(); });
}
std::shared_ptr<const ComplexData> data_of(const Held& held) {
  auto cells = cells_of(held);
  return {cells, &cells->data};
}
std::size_t width(const ComplexData& data) { return static_cast<std::size_t>(data.affine_dimension + 1); }

py::array duplicates(const Held& held) {
  const auto data = data_of(held);
  std::vector<SignedIndex> pairs;
  for (std::size_t row = 0; row < data->vertex_of_point.size(); ++row) {
    const SignedIndex first = data->vertex_of_point[row];
    if (first >= 0 && static_cast<std::size_t>(first) != row)
      pairs.insert(pairs.end(), {static_cast<SignedIndex>(row), first});
  }
  const std::size_t count = pairs.size() / 2;
  return rows_view(std::move(pairs), count, 2);
}

py::array cell_of_point(const Held& held) {
  const auto data = data_of(held);
  std::vector<SignedIndex> cell(data->vertex_of_point.size(), -1);
  for (std::size_t i = 0; i < data->cells.size(); ++i)
    cell[static_cast<std::size_t>(data->cells[i])] = static_cast<SignedIndex>(i / width(*data));
  for (std::size_t row = 0; row < cell.size(); ++row)
    if (const SignedIndex first = data->vertex_of_point[row]; first >= 0)
      cell[row] = cell[static_cast<std::size_t>(first)];
  return list_view(std::move(cell));
}

/// A point inside, followed by the vertices of a facet, must be positively oriented. Moving vertex j of a
/// cell to the front takes j transpositions.
py::array hull_facets(const Held& held) {
  const auto data = data_of(held);
  const std::size_t size = width(*data);
  std::vector<SignedIndex> facets;
  for (std::size_t i = 0; i < data->cells.size(); ++i) {
    if (data->neighbors[i] >= 0) continue;
    const std::size_t slot = i % size, first = facets.size();
    for (std::size_t j = 0; j < size; ++j)
      if (j != slot) facets.push_back(data->cells[i - slot + j]);
    if (slot % 2 == 1 && size > 2) std::swap(facets[first], facets[first + 1]);
  }
  const std::size_t columns = size == 0 ? 0 : size - 1;
  const std::size_t count =
      static_cast<std::size_t>(std::count(data->neighbors.begin(), data->neighbors.end(), -1));
  return rows_view(std::move(facets), count, columns);
}

py::tuple vertex_neighbors(const Held& held) {
  Supervisor supervisor;
  std::vector<std::int64_t> offsets{0};
  std::vector<SignedIndex> rows;
  supervisor.run([&] {
    held.with_locator([&](const Triangulation& engine, const PointLocator& locator, const Cells& cells) {
      const PointLocator::Edges& edges = locator.edges();
      rows.reserve(edges.vertices.size());
      for (std::size_t row = 0; row < engine.num_rows(); ++row) {
        cancellation_point();
        const auto first = static_cast<std::ptrdiff_t>(rows.size());
        if (cells.data.vertex_of_point[row] == static_cast<SignedIndex>(row)) {
          const Index v = index(engine.vertex_at(row));
          for (std::size_t e = edges.offsets[v]; e < edges.offsets[v + 1]; ++e)
            rows.push_back(static_cast<SignedIndex>(engine.row_of(edges.vertices[e])));
          std::sort(rows.begin() + first, rows.end());
        }
        offsets.push_back(static_cast<std::int64_t>(rows.size()));
      }
    });
  });
  return py::make_tuple(list_view(std::move(offsets)), list_view(std::move(rows)));
}

/// Locates queries into arrays.
void locate_into(const Held& held, const Queries& queries, double tolerance, const LocatedArrays& to) {
  const LocateOptions options{.tolerance = tolerance};
  const Execution how{.threads = held.threads()};
  Supervisor supervisor;
  supervisor.run([&, x = queries.coordinates()] {
    held.with_locator([&](const Triangulation&, const PointLocator& locator, const Cells& cells) {
      locator.locate(x, options, cells.numbers, to, how);
    });
  });
}
std::span<SignedIndex> span_of(py::array_t<SignedIndex>& array) {
  return {array.mutable_data(), static_cast<std::size_t>(array.size())};
}

py::object find_simplices(const Held& held, const py::object& object, double tolerance) {
  const Queries queries(object, held);
  auto cells = queries.answers<SignedIndex>();
  locate_into(held, queries, tolerance, {.cells = span_of(cells)});
  return Queries::scalar_if_single(cells);
}

/// The cell of one query, an array as as_vector() has them; −1 outside; −2 for anything else.
SignedIndex find_one(const Held& held, const py::object& object) {
  const std::span<const double> query = as_vector(object, held.dimension());
  if (query.empty()) return -2;
  SignedIndex cell = -1;
  Supervisor supervisor;
  supervisor.run([&] {
    held.with_locator([&](const Triangulation&, const PointLocator& locator, const Cells& cells) {
      locator.locate(query, LocateOptions{.coordinates = false}, cells.numbers, {.cells = {&cell, 1}},
                     {.threads = 1});
    });
  });
  return cell;
}

py::object locate_queries(const Held& held, const py::object& object, double tolerance) {
  const Queries queries(object, held);
  const LocateOptions options{.tolerance = tolerance};
  const Execution how{.threads = held.threads()};
  LocatedPoints found;
  Supervisor supervisor;
  supervisor.run([&, x = queries.coordinates()] {
    held.with_locator([&](const Triangulation&, const PointLocator& locator, const Cells& cells) {
      found = locator.locate(x, options, cells.numbers, how);
    });
  });
  std::vector<std::uint8_t> kinds(found.kinds.size());
  std::transform(found.kinds.begin(), found.kinds.end(), kinds.begin(),
                 [](Location::Kind kind) { return static_cast<std::uint8_t>(kind); });
  return py::module_::import("delone._locations")
      .attr("Locations")(
          list_view(std::move(kinds)), list_view(std::move(found.cells)),
          list_view(std::move(found.face_offsets)), list_view(std::move(found.face_rows)),
          py::make_tuple("in_cell", "on_face", "on_vertex", "outside_hull", "outside_affine_hull"));
}

py::tuple barycentric(const Held& held, const py::object& object, double tolerance) {
  const Queries queries(object, held);
  const auto size =
      static_cast<std::size_t>(ask(held, [](const Triangulation& t) { return t.affine_dimension(); }) + 1);
  auto cells = queries.answers<SignedIndex>();
  auto weights_array = queries.answers<double>({size});
  locate_into(
      held, queries, tolerance,
      {.cells = span_of(cells),
       .barycentric = {weights_array.mutable_data(), static_cast<std::size_t>(weights_array.size())}});
  return py::make_tuple(Queries::scalar_if_single(cells), weights_array);
}

/// For each query (q×d) the number of a cell that accepts it by its rounded barycentric coordinates: those of
/// the affine maps `transform` (m, d+1, d) are in [−tolerance, 1+tolerance], but at facets whose neighbor has
/// NaN as its map in [−broad, 1+tolerance]. The cell of the query, or that at the facet it is beyond, is
/// tried first, with the cells next to it and to those around it that have no map; then all within `radius`,
/// roughly the nearest first. −1 if none accepts.
py::array find_accepting(const Held& held, const py::object& object, const Reals& transform,
                         const Rows& neighbors, double tolerance, double broad, double radius) {
  const Queries queries(object, held);
  const auto d = static_cast<std::size_t>(held.dimension());
  const auto count = static_cast<std::size_t>(neighbors.shape(0));
  if (transform.size() != static_cast<py::ssize_t>(count * d * (d + 1)) ||
      neighbors.size() != static_cast<py::ssize_t>(count * (d + 1)))
    throw py::value_error("transform (m, d+1, d) and neighbors (m, d+1) of all cells are needed");
  auto found = queries.answers<SignedIndex>();
  std::fill_n(found.mutable_data(), queries.size(), SignedIndex{-1});
  Supervisor supervisor;
  supervisor.run([&, x = queries.coordinates(), out = found.mutable_data(), maps = transform.data(),
                  across = neighbors.data()] {
    held.with_locator([&](const Triangulation& engine, const PointLocator& locator, const Cells& cells) {
      const auto map_of = [&](SignedIndex cell) {
        return maps + static_cast<std::size_t>(cell) * d * (d + 1);
      };
      const auto accepts = [&](SignedIndex cell, const double* q) {
        const double* const map = map_of(cell);
        if (std::isnan(map[0])) return false;
        double last = 1;
        for (std::size_t i = 0; i <= d; ++i) {
          double c = last;
          if (i < d) {
            c = 0;
            for (std::size_t j = 0; j < d; ++j) c += map[i * d + j] * (q[j] - map[d * d + j]);
            last -= c;
          }
          if (!(c <= 1 + tolerance)) return false;
          if (c >= -tolerance) continue;
          const SignedIndex other = across[static_cast<std::size_t>(cell) * (d + 1) + i];
          if (!(c >= -broad) || other < 0 || !std::isnan(map_of(other)[0])) return false;
        }
        return true;
      };
      const auto number_of = [&](CellId cell) {
        const SignedIndex number = cells.numbers.row(cell);
        return static_cast<std::size_t>(number) < count ? number : SignedIndex{-1};
      };
      std::array<SignedIndex, 32> tried;
      const auto accepting_near = [&](SignedIndex start, const double* q) {
        std::size_t size = 0;
        tried[size++] = start;
        for (std::size_t i = 0; i < size; ++i) {
          const SignedIndex cell = tried[i];
          if (accepts(cell, q)) return cell;
          if (i > 0 && !std::isnan(map_of(cell)[0])) continue;
          for (std::size_t j = 0; j <= d && size < tried.size(); ++j) {
            const SignedIndex other = across[static_cast<std::size_t>(cell) * (d + 1) + j];
            const auto end = tried.begin() + static_cast<std::ptrdiff_t>(size);
            if (static_cast<std::size_t>(other) < count && std::find(tried.begin(), end, other) == end)
              tried[size++] = other;
          }
        }
        return SignedIndex{-1};
      };
      const Complex complex = engine.complex();
      std::vector<std::size_t> others;
      std::vector<double> coordinates_of_others;
      locator.locate(x, {.coordinates = false}, [&](std::size_t query, const LocatedPoint& where) {
        const double* const q = x.data() + query * d;
        const bool is_inside = !where.barycentric.empty();
        if (is_inside || where.cell != invalid_cell) {
          const SignedIndex start = number_of(
              is_inside ? where.cell : complex.neighbor(where.cell, complex.infinite_index(where.cell)));
          if (start >= 0) out[query] = accepting_near(start, q);
        }
        if (out[query] >= 0) return;
        others.push_back(query);
        coordinates_of_others.insert(coordinates_of_others.end(), q, q + d);
      });
      locator.cells_within(coordinates_of_others, radius, [&](std::size_t other, CellId cell) {
        cancellation_point();
        const SignedIndex number = number_of(cell);
        if (number < 0 || !accepts(number, coordinates_of_others.data() + other * d)) return true;
        out[others[other]] = number;
        return false;
      });
    });
  });
  return found;
}

/// |a − b| without intermediate overflow or underflow.
double distance(const double* a, const double* b, std::size_t d) {
  double squares = 0, largest = 0;
  for (std::size_t j = 0; j < d; ++j) squares += (a[j] - b[j]) * (a[j] - b[j]);
  if (squares > 1e-280 && squares < 1e300) return std::sqrt(squares);
  const double scale = squares < 1 ? 1 : 0.5;  // where differences overflow, halves do not
  for (std::size_t j = 0; j < d; ++j) largest = std::max(largest, std::fabs(scale * a[j] - scale * b[j]));
  if (largest == 0) return 0;
  squares = 0;
  for (std::size_t j = 0; j < d; ++j) {
    const double component = (scale * a[j] - scale * b[j]) / largest;
    squares += component * component;
  }
  return largest * std::sqrt(squares) / scale;
}

/// The distance of a query from a vertex; for a regular triangulation the power.
double distance_or_power(const Held& held, const Triangulation& engine, const double* q, VertexId v) {
  const double length = distance(q, engine.point(v).data(), static_cast<std::size_t>(held.dimension()));
  if (held.form() != Form::regular) return length;
  return length * length - static_cast<const Regular<>&>(engine).weight(v);
}

/// Calls visit(query, rank, vertex) for the vertices nearest to each query, from several threads at once.
template <class Visit>
void visit_nearest(const PointLocator& locator, std::span<const double> queries, std::optional<std::size_t> k,
                   unsigned threads, Visit visit) {
  if (!k)
    locator.nearest(queries,
                    [&](std::size_t query, VertexId v) {
                      if (v != invalid_vertex) visit(query, 0, v);
                    },
                    {.threads = threads});
  else
    locator.nearest(queries, *k,
                    [&](std::size_t query, std::span<const VertexId> found) {
                      for (std::size_t rank = 0; rank < found.size(); ++rank) visit(query, rank, found[rank]);
                    },
                    {.threads = threads});
}

py::tuple nearest(const Held& held, const py::object& object, std::optional<py::ssize_t> k) {
  if (k && *k < 1) throw py::value_error("k: at least 1, not " + std::to_string(*k));
  const Queries queries(object, held);
  const auto width = static_cast<std::size_t>(k.value_or(1));
  auto rows = k ? queries.answers<SignedIndex>({width}) : queries.answers<SignedIndex>();
  auto distances = k ? queries.answers<double>({width}) : queries.answers<double>();
  std::fill_n(rows.mutable_data(), rows.size(), SignedIndex{-1});
  std::fill_n(distances.mutable_data(), distances.size(), std::numeric_limits<double>::quiet_NaN());
  Supervisor supervisor;
  supervisor.run([&, x = queries.coordinates(), row = rows.mutable_data(), at = distances.mutable_data()] {
    held.with_locator([&](const Triangulation& engine, const PointLocator& locator, const Cells&) {
      const auto d = static_cast<std::size_t>(held.dimension());
      visit_nearest(locator, x, k ? std::optional(width) : std::nullopt, held.threads(),
                    [&](std::size_t query, std::size_t rank, VertexId v) {
                      row[query * width + rank] = static_cast<SignedIndex>(engine.row_of(v));
                      at[query * width + rank] = distance_or_power(held, engine, x.data() + query * d, v);
                    });
    });
  });
  return py::make_tuple(Queries::scalar_if_single(rows), Queries::scalar_if_single(distances));
}

py::dict construction_statistics(const Held& held) {
  return as_dict(ask(held, [](const Triangulation& t) { return t.statistics(); }));
}

std::string repr(const Held& held) {
  return count(held, [&](const Triangulation& t) {
    std::string text = std::string("<delone.") + name_of(held) + ": " + std::to_string(t.num_points()) +
                       " points in dimension " + std::to_string(t.dimension());
    if (t.affine_dimension() < t.dimension())
      text += ", affine dimension " + std::to_string(t.affine_dimension());
    return text + ", " + std::to_string(t.num_finite_cells()) + " cells>";
  });
}

}  // namespace

void bind_triangulations(py::module_& module) {
  py::class_<Held, std::shared_ptr<Held>> base(module, "Triangulation", text(docs::triangulation::base));
  base.def_property_readonly("dimension", &Held::dimension, "The number d of coordinates.")
      .def_property_readonly(
          "affine_dimension",
          [](const Held& h) { return count(h, [](const Triangulation& t) { return t.affine_dimension(); }); },
          "The dimension k <= d of the smallest flat that contains all points; 0 for one distinct point, -1 "
          "for none.")
      .def_property_readonly(
          "axes",
          [](const Held& h) {
            return py::tuple(py::cast(ask(h, [](const Triangulation& t) { return t.axes(); })));
          },
          "The k coordinate axes onto which the flat of the points projects one-to-one, increasing, a tuple.")
      .def_property_readonly(
          "num_points",
          [](const Held& h) { return count(h, [](const Triangulation& t) { return t.num_points(); }); },
          "The number of existing rows.")
      .def_property_readonly(
          "num_rows",
          [](const Held& h) { return count(h, [](const Triangulation& t) { return t.num_rows(); }); },
          text(docs::triangulation::num_rows))
      .def_property_readonly(
          "num_vertices",
          [](const Held& h) { return count(h, [](const Triangulation& t) { return t.num_vertices(); }); },
          "The number of distinct points that are not hidden.")
      .def_property_readonly(
          "num_duplicates",
          [](const Held& h) { return count(h, [](const Triangulation& t) { return t.num_duplicates(); }); },
          "The number of rows that are equal to an earlier one.")
      .def_property_readonly(
          "num_cells",
          [](const Held& h) { return count(h, [](const Triangulation& t) { return t.num_finite_cells(); }); },
          "The number m of cells.")
      .def(
          "__len__",
          [](const Held& h) { return count(h, [](const Triangulation& t) { return t.num_finite_cells(); }); })
      .def_property_readonly("points", &points_of,
                             "The points, (n, d) float64, read-only; NaN for removed rows.")
      .def_property_readonly(
          "cells",
          [](const Held& h) {
            const auto data = data_of(h);
            return rows_view(data->cells, data->num_cells(), width(*data), data);
          },
          text(docs::triangulation::cells))
      .def_property_readonly(
          "neighbors",
          [](const Held& h) {
            const auto data = data_of(h);
            return rows_view(data->neighbors, data->num_cells(), width(*data), data);
          },
          "The neighbors of each cell, (m, k+1) cells: number j is opposite vertex j, -1 outside the hull.")
      .def_property_readonly(
          "vertex_of_point",
          [](const Held& h) {
            const auto data = data_of(h);
            return list_view(data->vertex_of_point, data);
          },
          text(docs::triangulation::vertex_of_point))
      .def_property_readonly("duplicates", &duplicates,
                             "The rows that are equal to an earlier one, and that one, (r, 2).")
      .def_property_readonly(
          "cell_of_point", &cell_of_point,
          "A cell with each row as a vertex, (n,); -1 if the row is hidden or was removed.")
      .def_property_readonly("hull_facets", &hull_facets, text(docs::triangulation::hull_facets))
      .def_property_readonly("vertex_neighbors", &vertex_neighbors,
                             text(docs::triangulation::vertex_neighbors))
      .def_property_readonly(
          "hash",
          [](const Held& h) {
            return ask(h, [&](const Triangulation& t) { return t.hash({.threads = h.threads()}).hex(); });
          },
          text(docs::triangulation::hash))
      .def_property_readonly("statistics", &construction_statistics, text(docs::triangulation::statistics))
      .def("find_simplex", &find_simplices, "queries"_a, py::kw_only(), "tolerance"_a = 0.0,
           text(docs::triangulation::find_simplex))
      .def("locate", &locate_queries, "queries"_a, py::kw_only(), "tolerance"_a = 0.0,
           text(docs::triangulation::locate))
      .def("barycentric", &barycentric, "queries"_a, py::kw_only(), "tolerance"_a = 0.0,
           text(docs::triangulation::barycentric))
      .def_property_readonly("columns", &Held::columns, text(docs::triangulation::columns))
      .def_property_readonly("_index", &Held::row_index)
      .def("_sample", &sample, "limit"_a)
      .def("_find_one", &find_one, "query"_a)
      .def("_find_accepting", &find_accepting, "queries"_a, "transform"_a, "neighbors"_a, "tolerance"_a,
           "broad"_a, "radius"_a)
      .def("nearest", &nearest, "queries"_a, "k"_a = py::none(), text(docs::triangulation::nearest))
      .def(
          "_data",
          [](const Held& h) { return to_python(ask(h, [](const Triangulation& t) { return t.to_data(); })); })
      .def("__repr__", &repr);

  define_save(base, [](const Held& held, const SaveArguments& to) {
    ask(held, [&](const Triangulation& t) { to.save(t, [&] { return t.to_data(); }); });
  });

  define_to_html(base, [](const Held& held, const HtmlOptions& options) {
    Supervisor supervisor;
    return supervisor.run([&] {
      return held.with_engine(
          [&](const Triangulation& engine) { return to_html(engine.to_data(), options); });
    });
  });

  bind_edits(module, base);
}

}  // namespace delone::python
