// SPDX-License-Identifier: BSD-3-Clause
// Faces, alpha complexes and measures of cells of a Triangulation.
#include "arrays.hpp"
#include "docs_faces.hpp"
#include "docstring.hpp"
#include "html.hpp"
#include "module.hpp"
#include "pickling.hpp"
#include "triangulation.hpp"

#include <delone/alpha.hpp>
#include <delone/alpha_shape.hpp>
#include <delone/faces.hpp>
#include <delone/measures.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;
using Held = HeldTriangulation;

Execution how_of(const Held& held) { return {.threads = held.threads()}; }

py::array as_flags(const std::vector<unsigned char>& marks) {
  py::array_t<bool> flags(static_cast<py::ssize_t>(marks.size()));
  std::transform(marks.begin(), marks.end(), flags.mutable_data(), [](unsigned char m) { return m != 0; });
  flags.attr("setflags")("write"_a = false);
  return flags;
}

/// Faces, shared by the arrays that show them.
class HeldFaces {
 public:
  explicit HeldFaces(Faces faces) : faces_(std::make_shared<const Faces>(std::move(faces))) {}
  const Faces& faces() const { return *faces_; }
  py::tuple state() const {
    return py::make_tuple(faces_->dimension, vertices(), cells(), as_flags(faces_->on_hull));
  }
  static HeldFaces restored(const py::tuple& given) {
    return from_state(given, 4, "faces", [](const py::tuple& state) {
      using Rows = py::array_t<SignedIndex, py::array::c_style | py::array::forcecast>;
      using Flags = py::array_t<bool, py::array::c_style | py::array::forcecast>;
      const auto vertices = state[1].cast<Rows>(), cells = state[2].cast<Rows>();
      const auto on_hull = state[3].cast<Flags>();
      Faces faces;
      faces.dimension = state[0].cast<int>();
      if (faces.dimension < 0 || vertices.ndim() != 2 || vertices.shape(1) - 1 != faces.dimension ||
          cells.ndim() != 1 || cells.shape(0) != vertices.shape(0) || on_hull.ndim() != 1 ||
          on_hull.shape(0) != vertices.shape(0))
        throw py::value_error("not the state of faces");
      faces.vertices.assign(vertices.data(), vertices.data() + vertices.size());
      faces.cells.assign(cells.data(), cells.data() + cells.size());
      faces.on_hull.assign(on_hull.data(), on_hull.data() + on_hull.size());
      return HeldFaces(std::move(faces));
    });
  }
  py::array vertices() const {
    return rows_view(faces_->vertices, faces_->size(), static_cast<std::size_t>(faces_->dimension) + 1,
                     faces_);
  }
  py::array cells() const { return list_view(faces_->cells, faces_); }
  std::string repr() const {
    return "<delone.Faces: " + std::to_string(faces_->size()) + " of dimension " +
           std::to_string(faces_->dimension) + ">";
  }

 private:
  std::shared_ptr<const Faces> faces_;
};

/// An alpha complex, shared by the arrays that show it, and what it is one of.
class HeldAlpha {
 public:
  HeldAlpha(py::object triangulation, double radius, std::optional<double> squared)
      : triangulation_(std::move(triangulation)),
        held_(triangulation_.cast<std::shared_ptr<Held>>()),
        radius_(radius) {
    Supervisor supervisor;
    supervisor.run([&] {
      held_->with_engine([&](const Triangulation& engine) {
        version_ = held_->version();
        complex_ = std::make_shared<const AlphaComplex>(
            squared ? AlphaComplex::of_squared_radius(engine, *squared, how_of(*held_))
                    : AlphaComplex(engine, radius_, how_of(*held_)));
        cells_ = held_->cells_of(engine);
      });
    });
  }

  double radius() const { return radius_; }
  /// The triangulation, as long as it has the cells that the complex is made of.
  const py::object& triangulation() const {
    if (held_->version() != version_) throw has_changed();
    return triangulation_;
  }
  std::size_t size() const { return complex_->cell_numbers().size(); }
  py::array numbers() const { return list(complex_->cell_numbers()); }
  py::array cells() const {
    const std::size_t width = corners();
    std::vector<SignedIndex> rows;
    rows.reserve(size() * width);
    for (const SignedIndex number : complex_->cell_numbers()) {
      const auto first =
          cells_->data.cells.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(number) * width);
      rows.insert(rows.end(), first, first + static_cast<std::ptrdiff_t>(width));
    }
    return rows_view(std::move(rows), size(), width);
  }
  py::array boundary() const { return facets(complex_->boundary()); }
  py::array boundary_cells() const { return list(complex_->boundary_cells()); }
  py::array singular() const { return facets(complex_->singular_facets()); }

  HeldFaces faces(int dimension) const {
    return HeldFaces(ask_complex([&] { return complex_->faces(dimension, how_of(*held_)); }));
  }
  py::tuple boundary_components() const {
    BoundaryComponents made = ask_complex([&] { return delone::boundary_components(*complex_); });
    const std::size_t count = made.components.size();
    return py::make_tuple(list_view(std::move(made.components)), list_view(std::move(made.bodies)),
                          rows_view(std::move(made.neighbors), count, corners() < 2 ? 0 : corners() - 1));
  }
  /// For each polygon its rings, as lists of rows.
  py::list polygons() const {
    const auto made =
        std::make_shared<const Polygons>(ask_complex([&] { return delone::polygons(*complex_); }));
    py::list result;
    for (std::size_t i = 0; i < made->size(); ++i) {
      py::list rings;
      for (auto r = made->polygon_offsets[i]; r < made->polygon_offsets[i + 1]; ++r) {
        const std::span<const SignedIndex> ring = made->ring(static_cast<std::size_t>(r));
        rings.append(view(ring, {static_cast<py::ssize_t>(ring.size())}, made));
      }
      result.append(rings);
    }
    return result;
  }
  std::string html(const HtmlOptions& options) const {
    return ask_complex([&] { return to_html(complex_->to_data(), options); });
  }
  std::string repr() const {
    return "<delone.AlphaComplex: " + std::to_string(size()) + " cells, " +
           std::to_string(complex_->boundary_cells().size()) + " boundary facets>";
  }

 private:
  static std::runtime_error has_changed() {
    return std::runtime_error("points have been added to the triangulation of this alpha complex");
  }
  /// Calls work() while the triangulation cannot change.
  template <class Work>
  std::invoke_result_t<Work> ask_complex(Work work) const {
    Supervisor supervisor;
    return supervisor.run([&] {
      return held_->with_engine([&](const Triangulation&) {
        if (held_->version() != version_) throw has_changed();
        return work();
      });
    });
  }
  std::size_t corners() const { return static_cast<std::size_t>(complex_->affine_dimension() + 1); }
  py::array list(std::span<const SignedIndex> items) const {
    return view(items, {static_cast<py::ssize_t>(items.size())}, complex_);
  }
  py::array facets(std::span<const SignedIndex> rows) const {
    const std::size_t width = corners() < 2 ? 0 : corners() - 1;
    return view(
        rows,
        {static_cast<py::ssize_t>(width == 0 ? 0 : rows.size() / width), static_cast<py::ssize_t>(width)},
        complex_);
  }

  py::object triangulation_;
  std::shared_ptr<const Held> held_;  // the same
  double radius_;
  std::uint64_t version_ = 0;
  std::shared_ptr<const AlphaComplex> complex_;  // asks the engine, while it has this version
  std::shared_ptr<const Cells> cells_;
};

QualityMeasure measure_of(const std::string& name) {
  if (name == "radius_ratio") return QualityMeasure::radius_ratio;
  if (name == "mean_ratio") return QualityMeasure::mean_ratio;
  if (name == "radius_edge_ratio") return QualityMeasure::radius_edge_ratio;
  throw py::value_error("measure: 'radius_ratio', 'mean_ratio' or 'radius_edge_ratio', not " +
                        shown(py::str(name)));
}

}  // namespace

void bind_faces(py::module_& module) {
  py::class_<HeldFaces>(module, "Faces", text(docs::faces::result))
      .def_property_readonly(
          "dimension", [](const HeldFaces& f) { return f.faces().dimension; },
          "The dimension j of the faces.")
      .def_property_readonly("vertices", &HeldFaces::vertices,
                             "The vertices of each face, (n, j+1) input rows, increasing; those of cells as "
                             "in `Delaunay.cells`.")
      .def_property_readonly("cells", &HeldFaces::cells, "A cell that contains each face, (n,).")
      .def_property_readonly(
          "on_hull", [](const HeldFaces& f) { return as_flags(f.faces().on_hull); },
          "Whether each face lies in the boundary of the convex hull, (n,) bool.")
      .def("__len__", [](const HeldFaces& f) { return f.faces().size(); })
      .def("__repr__", &HeldFaces::repr)
      .def(py::pickle([](const HeldFaces& f) { return f.state(); },
                      [](const py::tuple& state) { return HeldFaces::restored(state); }));

  py::class_<HeldAlpha> alpha(module, "AlphaComplex", text(docs::faces::alpha_class));
  alpha
      .def_property_readonly("radius", &HeldAlpha::radius,
                             "The radius; NaN if the complex was made with `squared_radius`.")
      .def_property_readonly("triangulation", &HeldAlpha::triangulation,
                             "The triangulation; RuntimeError if points have been added to it since.")
      .def_property_readonly("cells", &HeldAlpha::cells,
                             "The cells of the complex, (m', k+1) input rows, in their order.")
      .def_property_readonly("cell_numbers", &HeldAlpha::numbers,
                             "The cells of the complex, (m',) numbers of cells of the triangulation.")
      .def_property_readonly("boundary", &HeldAlpha::boundary, text(docs::faces::boundary))
      .def_property_readonly("boundary_cells", &HeldAlpha::boundary_cells,
                             "The cell of each boundary facet, (b,) numbers of cells of the triangulation.")
      .def_property_readonly(
          "singular_facets", &HeldAlpha::singular,
          "The singular facets, (s, k) input rows: none of the cells that contain them is in the complex.")
      .def("faces", &HeldAlpha::faces, "dimension"_a, text(docs::faces::alpha_faces))
      .def("polygons", &HeldAlpha::polygons, text(docs::faces::polygons))
      .def("boundary_components", &HeldAlpha::boundary_components, text(docs::faces::boundary_components))
      .def("__len__", &HeldAlpha::size)
      .def("__repr__", &HeldAlpha::repr);
  define_to_html(alpha, [](const HeldAlpha& held, const HtmlOptions& options) { return held.html(options); });

  py::type triangulation = py::type::of<Held>();
  const auto method = [&](const char* name, const char* doc, auto function, auto... arguments) {
    triangulation.attr(name) = py::cpp_function(std::move(function), py::name(name),
                                                py::is_method(triangulation), doc, arguments...);
  };
  const auto property = [&](const char* name, const char* doc, auto function) {
    const py::object of_python = py::module_::import("builtins").attr("property");
    triangulation.attr(name) =
        of_python(py::cpp_function(std::move(function), py::name(name), py::is_method(triangulation), doc),
                  py::none(), py::none(), doc);
  };
  method(
      "faces", text(docs::faces::faces),
      [](const Held& held, int dimension) {
        return ask(held,
                   [&](const Triangulation& t) { return HeldFaces(faces(t, dimension, how_of(held))); });
      },
      "dimension"_a);
  property("circumradii", text(docs::faces::circumradii), [](const Held& held) {
    return list_view(ask(held, [&](const Triangulation& t) { return circumradii(t, how_of(held)); }));
  });
  property("circumcenters", text(docs::faces::circumcenters), [](const Held& held) {
    const auto d = static_cast<std::size_t>(held.dimension());
    std::vector<double> centers =
        ask(held, [&](const Triangulation& t) { return circumcenters(t, how_of(held)); });
    const std::size_t count = centers.size() / d;
    return rows_view(std::move(centers), count, d);
  });
  method(
      "qualities", text(docs::faces::qualities),
      [](const Held& held, const std::string& measure) {
        const QualityMeasure chosen = measure_of(measure);
        return list_view(
            ask(held, [&](const Triangulation& t) { return qualities(t, chosen, how_of(held)); }));
      },
      "measure"_a = "radius_ratio");
  method(
      "alpha_complex", text(docs::faces::alpha_complex),
      [](const py::object& self, std::optional<double> radius, std::optional<double> squared_radius) {
        if (!py::isinstance<Held>(self))
          throw py::type_error("alpha_complex: of a triangulation, not of " + type_name(self));
        static_cast<void>(
            self.cast<const Held&>());  // refuses what is not initialized; casts to holders do not
        if (radius.has_value() == squared_radius.has_value())
          throw py::value_error("alpha_complex: either radius or squared_radius");
        return HeldAlpha(self, radius.value_or(std::numeric_limits<double>::quiet_NaN()), squared_radius);
      },
      "radius"_a = py::none(), py::kw_only(), "squared_radius"_a = py::none());
  method(
      "alpha_values", text(docs::faces::alpha_values),
      [](const Held& held, int dimension) {
        return list_view(ask(held, [&](const Triangulation& t) {
          return std::move(alpha_values(t, dimension, how_of(held)).values);
        }));
      },
      "dimension"_a);
  method(
      "optimal_alpha_value", text(docs::faces::optimal_alpha_value),
      [](const Held& held, std::optional<py::ssize_t> components) {
        if (components && *components < 1) throw py::value_error("num_components: at least 1, or None");
        std::optional<std::size_t> most;
        if (components) most = static_cast<std::size_t>(*components);
        return ask(held, [&](const Triangulation& t) { return optimal_alpha_value(t, most, how_of(held)); });
      },
      "num_components"_a = 1);
  method("alpha_filtration", text(docs::faces::alpha_filtration), [](const Held& held) {
    std::vector<FaceValues> levels =
        ask(held, [&](const Triangulation& t) { return alpha_filtration(t, how_of(held)); });
    py::list result;
    for (FaceValues& level : levels)
      result.append(py::make_tuple(HeldFaces(std::move(level.faces)), list_view(std::move(level.values))));
    return result;
  });
}

}  // namespace delone::python
