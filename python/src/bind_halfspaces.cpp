// SPDX-License-Identifier: BSD-3-Clause
// delone.HalfspaceIntersection.
#include "arrays.hpp"
#include "data_members.hpp"
#include "docs_halfspaces.hpp"
#include "docs_polyhedra.hpp"
#include "docstring.hpp"
#include "held_polyhedron.hpp"
#include "html.hpp"
#include "module.hpp"
#include "pickling.hpp"
#include "running.hpp"
#include "saving.hpp"

#include <pybind11/stl.h>

#include <delone/halfspaces.hpp>

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;

const char* name_of(IntersectionState state) {
  return state == IntersectionState::full ? "full" : state == IntersectionState::flat ? "flat" : "empty";
}

/// An intersection and its arrays.
class HeldIntersection {
 public:
  HeldIntersection(const py::object& halfspaces, const py::object& interior_point,
                   const BuildArguments& arguments, const py::object& progress)
      : arguments_(arguments) {
    const auto rows = as_rows(halfspaces);
    dimension_ = static_cast<int>(rows.shape(1)) - 1;
    columns_ = columns_of(halfspaces);
    py::array_t<double> interior(0);
    has_interior_ = !interior_point.is_none();
    if (has_interior_) interior = as_doubles(interior_point, "interior_point");
    if (has_interior_ && (interior.ndim() != 1 || interior.shape(0) != dimension_))
      throw py::value_error("interior_point: an array of shape (" + std::to_string(dimension_) + ",), not " +
                            shown(interior.attr("shape")) +
                            (interior.ndim() > 0 && interior.shape(0) == rows.shape(0)
                                 ? "; A x <= b is one array of halfspaces, numpy.c_[A, -b]"
                                 : ""));
    guard_.change(progress, [&, h = numbers(rows), p = numbers(interior)] {
      const Options options = arguments_.to_options();
      if (has_interior_)
        intersection_.emplace(h, dimension_, p, options);
      else
        intersection_.emplace(h, dimension_, options);
    });
  }

  int dimension() const { return dimension_; }
  const BuildArguments& arguments() const { return arguments_; }
  bool has_interior_point() const { return has_interior_; }
  /// The labels of the columns of the DataFrame of its halfspaces, a tuple, or None.
  const py::object& columns() const { return columns_; }
  void set_columns(py::object columns) { columns_ = std::move(columns); }

  template <class Question>
  auto ask(Question question) const {
    return guard_.ask(
        [&] { return question(static_cast<const HalfspaceIntersectionBase&>(*intersection_)); });
  }

  void add(const py::object& halfspaces, const py::object& progress) {
    const auto rows = as_more_points(halfspaces, dimension_ + 1, "halfspaces");
    require_columns(halfspaces, columns_, "halfspaces");
    guard_.change(progress, [&, h = numbers(rows)] {
      intersection_->insert_range(h);
      halfspaces_.reset();
      vertices_.reset();
    });
  }

  /// The arrays, without the halfspaces. Later insertions do not change them.
  std::shared_ptr<const IntersectionData> data() const {
    return ask([](const HalfspaceIntersectionBase& intersection) { return intersection.shared_data(); });
  }
  /// Those of them that cost little. Later insertions do not change them.
  std::shared_ptr<const IntersectionVertices> vertices() const {
    return ask([this](const HalfspaceIntersectionBase& intersection) {
      const std::lock_guard lock(held_mutex_);
      if (!vertices_) vertices_ = std::make_shared<const IntersectionVertices>(intersection.to_vertices());
      return vertices_;
    });
  }
  /// A copy of all arrays.
  IntersectionData to_data() const {
    return ask([](const HalfspaceIntersectionBase& intersection) { return intersection.to_data(); });
  }
  /// The halfspaces, a view of what is copied on first use after a change.
  py::array halfspaces() const {
    const auto rows = ask([this](const HalfspaceIntersectionBase& intersection) {
      const std::lock_guard lock(held_mutex_);
      if (!halfspaces_)
        halfspaces_ = std::make_shared<const std::vector<double>>(intersection.to_data().halfspaces);
      return halfspaces_;
    });
    const auto width = static_cast<std::size_t>(dimension_) + 1;
    return rows_view(*rows, rows->size() / width, width, rows);
  }

 private:
  static py::array_t<double> as_rows(const py::object& halfspaces) {
    auto rows = as_points(halfspaces, "halfspaces");
    if (rows.shape(1) < 2) throw py::value_error("halfspaces: an array of shape (m, d+1), d at least 1");
    return rows;
  }

  BuildArguments arguments_;
  py::object columns_ = py::none();
  int dimension_ = 0;
  bool has_interior_ = false;
  Guard guard_;  // of all members below
  std::optional<HalfspaceIntersection<>> intersection_;
  mutable std::mutex held_mutex_;  // of what follows, under the guard
  mutable std::shared_ptr<const std::vector<double>> halfspaces_;
  mutable std::shared_ptr<const IntersectionVertices> vertices_;
};

/// Rows of d + extra numbers.
template <std::vector<double> IntersectionData::*Member, std::size_t extra = 0>
py::array rows_of(const HeldIntersection& held) {
  const auto data = held.data();
  const auto width = static_cast<std::size_t>(held.dimension()) + extra;
  return rows_view((*data).*Member, ((*data).*Member).size() / width, width, data);
}
template <std::vector<SignedIndex> IntersectionData::*Member>
py::array list_of(const HeldIntersection& held) {
  const auto data = held.data();
  return list_view((*data).*Member, data);
}
template <std::vector<SignedIndex> IntersectionData::*Member>
py::array pairs_of(const HeldIntersection& held) {
  const auto data = held.data();
  return rows_view((*data).*Member, ((*data).*Member).size() / 2, 2, data);
}
/// Offsets; [0] if there are no lists.
template <std::vector<SignedIndex> IntersectionData::*Member>
py::array offsets_of(const HeldIntersection& held) {
  const auto data = held.data();
  if (((*data).*Member).empty()) return list_view(std::vector<SignedIndex>{0});
  return list_view((*data).*Member, data);
}

py::array interior_point(const HeldIntersection& held) {
  const auto data = held.data();
  return list_view(data->interior_point, data);
}

py::array kinds(const HeldIntersection& held) {
  const auto data = held.data();
  return view<std::uint8_t>({reinterpret_cast<const std::uint8_t*>(data->kinds.data()), data->kinds.size()},
                            {static_cast<py::ssize_t>(data->kinds.size())}, data);
}

std::string repr(const HeldIntersection& held) {
  return held.ask([](const HalfspaceIntersectionBase& h) {
    std::string text = "<delone.HalfspaceIntersection: " + std::to_string(h.num_halfspaces()) +
                       " halfspaces in dimension " + std::to_string(h.dimension());
    if (h.state() != IntersectionState::full) return text + ", " + name_of(h.state()) + ">";
    return text + ", " + std::to_string(h.num_vertices()) + " vertices, " + std::to_string(h.num_facets()) +
           " facets" + (h.is_bounded() ? ">" : ", unbounded>");
  });
}

/// What pictures are drawn from, float64: the ends of up to `limit` edges, evenly chosen, (s, 2, d), and how
/// many edges there are.
py::tuple sample_intersection(const HeldIntersection& held, std::size_t limit) {
  std::vector<double> ends;
  const auto d = static_cast<std::size_t>(held.dimension());
  const std::size_t num_edges = held.ask([&](const HalfspaceIntersectionBase& intersection) {
    const IntersectionData& data = intersection.data();
    const std::size_t count = data.edges.size() / 2, step = count / std::max<std::size_t>(limit, 1) + 1;
    for (std::size_t i = 0; i < 2 * count; i += (i % 2 == 0 ? 1 : 2 * step - 1)) {
      const double* const x = data.vertices.data() + static_cast<std::size_t>(data.edges[i]) * d;
      ends.insert(ends.end(), x, x + d);
    }
    return count;
  });
  const std::size_t count = ends.size() / (2 * d);
  return py::make_tuple(rows_view(std::move(ends), 2 * count, d).attr("reshape")(count, 2, d), num_edges);
}

py::tuple state_of_intersection(const HeldIntersection& held) {
  const BuildArguments& a = held.arguments();
  return py::make_tuple(held.halfspaces(),
                        held.has_interior_point() ? py::object(interior_point(held)) : py::none(), a.seed,
                        a.order, a.threads, held.columns());
}

std::unique_ptr<HeldIntersection> restored_intersection(const py::tuple& given) {
  return from_state(given, 6, "an intersection", [](const py::tuple& state) {
    auto held = std::make_unique<HeldIntersection>(
        state[0], state[1],
        BuildArguments{state[2].cast<std::uint64_t>(), state[3].cast<std::string>(), state[4].cast<int>()},
        py::none());
    held->set_columns(as_columns(state[5], held->dimension() + 1));
    return held;
  });
}

template <class Question>
auto answer(Question question) {
  return [question](const HeldIntersection& held) { return held.ask(question); };
}

}  // namespace

void bind_halfspaces(py::module_& module) {
  using Data = IntersectionData;
  py::class_<HeldIntersection> type(module, "HalfspaceIntersection", text(docs::halfspaces::intersection));
  type.def(py::init([](const py::object& halfspaces, const py::object& interior_point, std::uint64_t seed,
                       std::string order, int threads, const py::object& progress,
                       const py::object& memory_limit, const py::object& time_limit) {
             return std::make_unique<HeldIntersection>(
                 halfspaces, interior_point,
                 BuildArguments{seed, std::move(order), threads, as_memory_limit(memory_limit),
                                as_time_limit(time_limit)},
                 progress);
           }),
           "halfspaces"_a, "interior_point"_a = py::none(), py::kw_only(), "seed"_a = 0,
           "order"_a = "automatic", "threads"_a = 0, "progress"_a = py::none(), "memory_limit"_a = py::none(),
           "time_limit"_a = py::none());
  type.def("insert_range", &HeldIntersection::add, "halfspaces"_a, py::kw_only(), "progress"_a = py::none(),
           text(docs::halfspaces::insert_range));
  type.def_property_readonly("dimension", &HeldIntersection::dimension,
                             "The number d >= 1 of coordinates of a point.")
      .def_property_readonly("rank", answer([](const HalfspaceIntersectionBase& h) { return h.rank(); }),
                             text(docs::halfspaces::rank))
      .def_property_readonly("state",
                             answer([](const HalfspaceIntersectionBase& h) { return name_of(h.state()); }),
                             "'full', 'flat' (some points, but none strictly inside) or 'empty'.")
      .def_property_readonly(
          "is_bounded", [](const HeldIntersection& h) { return h.vertices()->bounded; },
          "Whether the intersection is a polytope: full, without directions and lines.")
      .def_property_readonly("num_halfspaces",
                             answer([](const HalfspaceIntersectionBase& h) { return h.num_halfspaces(); }),
                             "The number m of input rows.")
      .def_property_readonly(
          "num_vertices", [](const HeldIntersection& h) { return h.vertices()->num_vertices(); },
          "The number v of vertices, all of which are finite.")
      .def_property_readonly("num_facets",
                             answer([](const HalfspaceIntersectionBase& h) { return h.num_facets(); }),
                             "The number f of facets; also len().")
      .def("__len__", answer([](const HalfspaceIntersectionBase& h) { return h.num_facets(); }))
      .def("_sample", &sample_intersection, "limit"_a)
      .def_property_readonly("columns", &HeldIntersection::columns,
                             "The labels of the columns of the DataFrame it was made of, d+1 in a tuple, or "
                             "None; see `Delaunay.columns`.")
      .def_property_readonly("halfspaces", &HeldIntersection::halfspaces,
                             "All input rows in their order, (m, d+1) float64.")
      .def_property_readonly(
          "interior_point", &interior_point,
          "The interior point, given or found (rounded), (d,) float64; empty if the state is not 'full'.")
      .def_property_readonly("witness", &list_of<&Data::witness>,
                             "At most d+1 rows without a common interior point, increasing: the proof that "
                             "the state is not 'full'.")
      .def_property_readonly(
          "axes", [](const HeldIntersection& h) { return py::tuple(py::cast(h.data()->axes)); },
          "The k coordinates onto which the normals project one-to-one, increasing, a tuple.")
      .def_property_readonly(
          "vertices",
          [](const HeldIntersection& h) {
            const auto all = h.vertices();
            const auto d = static_cast<std::size_t>(h.dimension());
            return rows_view(all->vertices, all->vertices.size() / d, d, all);
          },
          "The vertices, (v, d) float64, each coordinate the double nearest to the exact one.")
      .def_property_readonly("vertex_offsets", &offsets_of<&Data::vertex_offsets>,
                             "The offsets of `vertex_halfspaces`, (v+1,).")
      .def_property_readonly("vertex_halfspaces", &list_of<&Data::vertex_halfspaces>,
                             text(docs::halfspaces::vertex_halfspaces))
      .def_property_readonly(
          "directions", &rows_of<&Data::directions>,
          "The extreme directions to infinity, (r, d) float64 unit vectors; none if bounded.")
      .def_property_readonly("direction_offsets", &offsets_of<&Data::direction_offsets>,
                             "The offsets of `direction_halfspaces`, (r+1,).")
      .def_property_readonly("direction_halfspaces", &list_of<&Data::direction_halfspaces>,
                             text(docs::halfspaces::direction_halfspaces))
      .def_property_readonly("edges", &pairs_of<&Data::edges>,
                             "The vertices of each bounded edge, (e, 2), the smaller number first.")
      .def_property_readonly("rays", &pairs_of<&Data::rays>,
                             "The vertex and the direction of each unbounded edge, (u, 2).")
      .def_property_readonly("facet_halfspaces", &list_of<&Data::facet_halfspaces>,
                             "The row of each facet, (f,), increasing.")
      .def_property_readonly("facet_offsets", &offsets_of<&Data::facet_offsets>,
                             "The offsets of `facet_vertices`, (f+1,).")
      .def_property_readonly("facet_vertices", &list_of<&Data::facet_vertices>,
                             text(docs::halfspaces::facet_vertices))
      .def_property_readonly(
          "lineality", &rows_of<&Data::lineality>,
          "Unit vectors that span the lines in the intersection, (d-k, d) float64, rounded.")
      .def_property_readonly("first_of_halfspace", &list_of<&Data::first_of_halfspace>,
                             "The first row that is the same halfspace, a positive multiple, (m,).")
      .def_property_readonly("kinds", &kinds, text(docs::halfspaces::kinds))
      .def_property_readonly("dual_points", &rows_of<&Data::dual_points>,
                             "The dual points -A / (A p + b) of the rows, p the interior point, (m, d) "
                             "float64, rounded; 0 without a normal.")
      .def_property_readonly("dual_equations", &rows_of<&Data::dual_equations, 1>,
                             "The unit normal and offset of the facet of the dual points' hull for each "
                             "vertex, (v, d+1) float64, rounded.")
      .def_property_readonly("volume",
                             answer([](const HalfspaceIntersectionBase& h) { return h.volume().value; }),
                             text(docs::halfspaces::volume))
      .def_property_readonly(
          "dual_volume", answer([](const HalfspaceIntersectionBase& h) { return h.dual_volume().value; }),
          "The volume of the hull of the dual points (and of the origin, if unbounded); NaN for k < d.")
      .def_property_readonly(
          "dual_area", answer([](const HalfspaceIntersectionBase& h) { return h.dual_area().value; }),
          "The surface area of the hull of the dual points (and of the origin, if unbounded); NaN for k < d.")
      .def_property_readonly(
          "statistics",
          [](const HeldIntersection& h) {
            return as_dict(h.ask([](const HalfspaceIntersectionBase& i) { return i.statistics(); }));
          },
          text(docs::halfspaces::statistics))
      .def("_data", [](const HeldIntersection& h) { return to_python(h.to_data()); })
      .def("__repr__", &repr)
      .def(py::pickle(&state_of_intersection, &restored_intersection));
  define_save(type, [](const HeldIntersection& held, const SaveArguments& to) {
    held.ask([&](const HalfspaceIntersectionBase& p) { to.save(p, [&] { return p.to_data(); }); });
  });
  define_to_polyhedron(type, text(docs::polyhedra::of_intersection), [](const HeldIntersection& h) {
    return std::make_shared<const IntersectionData>(h.to_data());
  });
  define_to_html(type, [](const HeldIntersection& h, const HtmlOptions& options) {
    return html_of(std::make_shared<const IntersectionData>(h.to_data()), options);
  });
}

}  // namespace delone::python
