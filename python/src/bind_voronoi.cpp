// SPDX-License-Identifier: BSD-3-Clause
// delone.Voronoi, PowerDiagram and FurthestVoronoi.
#include "arrays.hpp"
#include "data_members.hpp"
#include "docs_voronoi.hpp"
#include "docstring.hpp"
#include "html.hpp"
#include "messages/in_quotes.hpp"
#include "module.hpp"
#include "saving.hpp"
#include "triangulation.hpp"

#include <delone/furthest_site.hpp>
#include <delone/voronoi.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace delone::python {
namespace {

using namespace py::literals;

/// A diagram and the points that it belongs to.
class HeldDiagram {
 public:
  HeldDiagram(const py::object& triangulation, const py::object& tolerance)
      : source_type_(py::type::of(triangulation)) {
    const auto& source = triangulation.cast<const HeldTriangulation&>();
    threads_ = source.threads();
    columns_ = source.columns();
    index_ = source.row_index();
    const Tolerances wanted = as_tolerances(tolerance, source.dimension());
    const DiagramOptions options{.tolerance = wanted.tolerance, .axis_tolerances = wanted.of_axes};
    const Execution how{.threads = threads_};
    Supervisor supervisor;
    for (std::uint64_t version = source.version() + 1;
         version != source.version();) {  // until no other thread adds points
      version = source.version();
      source_state_ = triangulation.attr("__getstate__")();
      supervisor.run([&] {
        source.with_engine([&](const Triangulation& engine) {
          if (source.form() == Form::regular)
            diagram_ = std::make_shared<PowerDiagram<>>(static_cast<const Regular<>&>(engine), options, how);
          else if (source.form() == Form::furthest_site)
            diagram_ =
                std::make_shared<FurthestVoronoi<>>(static_cast<const FurthestSite<>&>(engine), options, how);
          else
            diagram_ = std::make_shared<Voronoi<>>(static_cast<const Delaunay<>&>(engine), options, how);
        });
        points_ = source.points();
        weights_ = source.weights();
      });
    }
  }

  /// For pickle: the triangulation, from which unpickling rebuilds the diagram.
  py::tuple recipe(const py::object& self) const {
    return py::make_tuple(py::module_::import("delone._pickling").attr("diagram"),
                          py::make_tuple(py::type::of(self), source_type_, source_state_,
                                         as_argument(diagram_->tolerance(), diagram_->axis_tolerances())));
  }

  const Diagram& diagram() const { return *diagram_; }
  std::size_t dimension() const { return static_cast<std::size_t>(diagram_->dimension()); }
  unsigned threads() const { return threads_; }
  bool is_furthest() const { return diagram_->kind() == DataKind::furthest_voronoi; }
  const py::object& columns() const { return columns_; }
  const py::object& row_index() const { return index_; }
  py::array points() const {
    return rows_view(*points_, points_->size() / dimension(), dimension(), points_);
  }
  py::array weights() const { return list_view(*weights_, weights_); }

  template <class T>
  py::array list(std::span<const T> items) const {
    return view<T>(items, {static_cast<py::ssize_t>(items.size())}, diagram_);
  }
  template <class T>
  py::array rows(std::span<const T> items, std::size_t count, std::size_t width) const {
    return view<T>(items, {static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(width)}, diagram_);
  }

 private:
  py::object source_type_, source_state_, columns_, index_;
  unsigned threads_ = 1;  // those of the triangulation
  std::shared_ptr<const Diagram> diagram_;
  std::shared_ptr<const std::vector<double>> points_, weights_;
};

class HeldVoronoi : public HeldDiagram {
  using HeldDiagram::HeldDiagram;
};
class HeldPower : public HeldDiagram {
  using HeldDiagram::HeldDiagram;
};
class HeldFurthest : public HeldDiagram {
  using HeldDiagram::HeldDiagram;
};

/// That of the region of each row: 0 if it is hidden, NaN if it was removed.
std::vector<double> at_points(const HeldDiagram& held, const std::vector<double>& of_regions) {
  const std::span<const SignedIndex> regions = held.diagram().point_region();
  const py::array points = held.points();
  const auto* const coordinates = static_cast<const double*>(points.data());
  std::vector<double> found(regions.size());
  for (std::size_t row = 0; row < found.size(); ++row) {
    const bool is_there = !std::isnan(coordinates[row * held.dimension()]);
    found[row] = regions[row] >= 0 ? of_regions[static_cast<std::size_t>(regions[row])]
                 : is_there        ? 0
                                   : std::numeric_limits<double>::quiet_NaN();
  }
  return found;
}

py::array region_volumes(const HeldDiagram& held, const py::object& object, const std::string& at) {
  if (at != "regions" && at != "points")
    throw py::value_error("at: 'regions' or 'points', not " + messages::in_quotes(at));
  const std::optional<Box> box = as_box(object);
  Supervisor supervisor;
  std::vector<double> volumes = supervisor.run([&] {
    return box ? held.diagram().region_volumes(*box, {.threads = held.threads()})
               : held.diagram().region_volumes({.threads = held.threads()});
  });
  return list_view(at == "points" ? at_points(held, volumes) : std::move(volumes));
}

/// The arrays of a delone.ClippedRegions.
py::tuple clipped_regions(const HeldDiagram& held, const py::object& object,
                          const py::array_t<double, py::array::c_style | py::array::forcecast>& halfspaces) {
  const std::optional<Box> box = as_box(object);
  if (!box) throw py::value_error("box: (low, high), each of d numbers");
  Supervisor supervisor;
  ClippedRegions made = supervisor.run(
      [&] { return held.diagram().clipped_regions(*box, numbers(halfspaces), {.threads = held.threads()}); });
  const std::size_t count = made.num_vertices();
  return py::make_tuple(rows_view(std::move(made.vertices), count, held.dimension()),
                        list_view(std::move(made.face_vertices)), list_view(std::move(made.face_offsets)),
                        list_view(std::move(made.region_offsets)), list_view(std::move(made.neighbors)));
}

std::string html_of_diagram(const HeldDiagram& held, const std::string& title,
                            std::vector<std::string> columns, const py::object& values, const std::string& at,
                            const std::string& name, const py::object& object) {
  const std::optional<Box> box = as_box(object);
  const HtmlOptions options = html_options(title, std::move(columns), values, at, name);
  Supervisor supervisor;
  return supervisor.run([&] { return to_html(held.diagram(), options, box); });
}

void save(const HeldDiagram& held, const std::string& path, const std::string& format,
          std::optional<std::string> qhull, std::vector<std::string> columns, const py::object& object) {
  const SaveArguments to{path, format, std::move(qhull), std::move(columns)};
  const std::optional<Box> box = as_box(object);
  Supervisor supervisor;
  supervisor.run([&] {
    if (to.qhull)
      write_qhull(to.path, held.diagram(), *to.qhull);
    else
      write(to.path, held.diagram(), box, to.format, to.column_names);
  });
}

std::size_t checked(const char* what, py::ssize_t i, std::size_t count) {
  if (i < 0 || static_cast<std::size_t>(i) >= count)
    throw py::index_error(std::string(what) + " " + std::to_string(i) + ": there are " +
                          std::to_string(count));
  return static_cast<std::size_t>(i);
}

std::string repr(const HeldDiagram& held, const char* name) {
  const Diagram& v = held.diagram();
  return std::string("<delone.") + name + ": " + std::to_string(v.num_points()) + " points in dimension " +
         std::to_string(v.dimension()) + ", " + std::to_string(v.num_regions()) + " regions, " +
         std::to_string(v.num_vertices()) + " vertices>";
}

}  // namespace

void bind_voronoi(py::module_& module) {
  py::class_<HeldDiagram> base(module, "Diagram", text(docs::voronoi::diagram));
  base.def_property_readonly(
          "dimension", [](const HeldDiagram& h) { return h.diagram().dimension(); },
          "The number d >= 1 of coordinates of a point.")
      .def_property_readonly(
          "affine_dimension", [](const HeldDiagram& h) { return h.diagram().affine_dimension(); },
          "The dimension k <= d of the smallest flat that contains all points; -1 for none.")
      .def_property_readonly(
          "tolerance", [](const HeldDiagram& h) { return h.diagram().tolerance(); },
          "The tolerance of the constructor, the largest one of those of the axes.")
      .def_property_readonly(
          "axis_tolerances",
          [](const HeldDiagram& h) {
            const auto own = h.diagram().axis_tolerances();
            std::vector<double> all(own.begin(), own.end());
            if (all.empty()) all.assign(h.dimension(), h.diagram().tolerance());
            return list_view(std::move(all));
          },
          text(docs::voronoi::axis_tolerances))
      .def_property_readonly(
          "max_displacement", [](const HeldDiagram& h) { return h.diagram().max_displacement(); },
          text(docs::voronoi::displacement))
      .def_property_readonly(
          "num_points", [](const HeldDiagram& h) { return h.diagram().num_points(); },
          "The number n of input rows.")
      .def_property_readonly(
          "num_vertices", [](const HeldDiagram& h) { return h.diagram().num_vertices(); },
          "The number v of distinct vertices, infinity not counted.")
      .def_property_readonly(
          "num_regions", [](const HeldDiagram& h) { return h.diagram().num_regions(); },
          "The number of regions, one for each site.")
      .def_property_readonly(
          "num_ridges", [](const HeldDiagram& h) { return h.diagram().num_ridges(); },
          "The number r of ridges, the facets between two regions.")
      .def_property_readonly(
          "num_rays", [](const HeldDiagram& h) { return h.diagram().num_rays(); },
          "The number of unbounded edges.")
      .def_property_readonly(
          "columns", &HeldDiagram::columns,
          "The labels of the columns of the triangulation, a tuple, or None; see `Delaunay.columns`.")
      .def_property_readonly("_index", &HeldDiagram::row_index)
      .def_property_readonly("points", &HeldDiagram::points, "All input rows in their order, (n, d) float64.")
      .def_property_readonly(
          "vertices",
          [](const HeldDiagram& h) {
            return h.rows(h.diagram().vertices(), h.diagram().num_vertices(), h.dimension());
          },
          text(docs::voronoi::vertices))
      .def_property_readonly(
          "ridge_points",
          [](const HeldDiagram& h) {
            return h.rows(h.diagram().ridge_points(), h.diagram().num_ridges(), 2);
          },
          "The rows of the two sites of each ridge, (r, 2); the ridge lies in their bisector.")
      .def_property_readonly(
          "ridge_vertices", [](const HeldDiagram& h) { return h.list(h.diagram().ridge_vertices()); },
          text(docs::voronoi::ridge_vertices))
      .def_property_readonly(
          "ridge_offsets", [](const HeldDiagram& h) { return h.list(h.diagram().ridge_offsets()); },
          "The offsets of `ridge_vertices`, (r+1,) int64.")
      .def_property_readonly(
          "region_vertices", [](const HeldDiagram& h) { return h.list(h.diagram().region_vertices()); },
          text(docs::voronoi::region_vertices))
      .def_property_readonly(
          "region_offsets", [](const HeldDiagram& h) { return h.list(h.diagram().region_offsets()); },
          "The offsets of `region_vertices`, (regions+1,) int64.")
      .def_property_readonly(
          "region_points", [](const HeldDiagram& h) { return h.list(h.diagram().region_points()); },
          "The first row at the site of each region, (regions,), increasing.")
      .def_property_readonly(
          "point_region", [](const HeldDiagram& h) { return h.list(h.diagram().point_region()); },
          "The region of each row, (n,); -1 for a hidden point.")
      .def_property_readonly(
          "is_bounded",
          [](const HeldDiagram& h) {
            py::array_t<bool> bounded(static_cast<py::ssize_t>(h.diagram().num_regions()));
            for (std::size_t i = 0; i < h.diagram().num_regions(); ++i)
              bounded.mutable_data()[i] = h.diagram().is_bounded(i);
            return bounded;
          },
          "Whether each region is bounded, (regions,) bool.")
      .def_property_readonly(
          "ray_vertices", [](const HeldDiagram& h) { return h.list(h.diagram().ray_vertices()); },
          "The vertex from which each unbounded edge starts, (rays,).")
      .def_property_readonly(
          "ray_directions",
          [](const HeldDiagram& h) {
            return h.rows(h.diagram().ray_directions(), h.diagram().num_rays(), h.dimension());
          },
          "The direction of each unbounded edge, (rays, d) unit vectors: outward, for furthest sites inward.")
      .def_property_readonly(
          "ray_points",
          [](const HeldDiagram& h) {
            const std::size_t rays = h.diagram().num_rays();
            return h.rows(h.diagram().ray_points(), rays,
                          rays == 0 ? 0 : h.diagram().ray_points().size() / rays);
          },
          "The rows of the hull facet to which each unbounded edge is dual, (rays, k).")
      .def(
          "ridge",
          [](const HeldDiagram& h, py::ssize_t i) {
            return h.list(h.diagram().ridge(checked("ridge", i, h.diagram().num_ridges())));
          },
          "i"_a, text(docs::voronoi::ridge))
      .def(
          "region",
          [](const HeldDiagram& h, py::ssize_t i) {
            return h.list(h.diagram().region(checked("region", i, h.diagram().num_regions())));
          },
          "i"_a, text(docs::voronoi::region))
      .def("_to_html", &html_of_diagram, "title"_a, "columns"_a, "values"_a, "values_at"_a, "value_name"_a,
           "box"_a)
      .def_property_readonly("_is_furthest", &HeldDiagram::is_furthest)
      .def("_data",
           [](const HeldDiagram& h) {
             Supervisor supervisor;
             return to_python(supervisor.run([&] { return h.diagram().to_data(); }));
           })
      .def("_save", &save, "path"_a, "format"_a, "qhull"_a, "columns"_a, "box"_a)
      .def("_clipped_regions", &clipped_regions, "box"_a, "halfspaces"_a)
      .def("region_volumes", &region_volumes, "box"_a = py::none(), py::kw_only(), "at"_a = "regions",
           text(docs::voronoi::region_volumes))
      .def(
          "ridge_volumes",
          [](const HeldDiagram& h) {
            Supervisor supervisor;
            return list_view(
                supervisor.run([&] { return h.diagram().ridge_volumes({.threads = h.threads()}); }));
          },
          text(docs::voronoi::ridge_volumes))
      .def(
          "bounding_box",
          [](const HeldDiagram& h, double margin) {
            Box box = h.diagram().bounding_box(margin);
            return py::make_tuple(list_view(std::move(box.low)), list_view(std::move(box.high)));
          },
          "margin"_a = 0.1, text(docs::voronoi::bounding_box));

  py::class_<HeldVoronoi, HeldDiagram>(module, "Voronoi", text(docs::voronoi::voronoi))
      .def(py::init([](const py::object& points, const py::object& tolerance) {
             const py::object source = py::isinstance<HeldTriangulation>(points)
                                           ? points
                                           : py::module_::import("delone").attr("Delaunay")(points);
             const auto& held = source.cast<const HeldTriangulation&>();
             if (held.form() == Form::regular)
               throw py::type_error("the diagram of a Regular triangulation is a PowerDiagram");
             if (held.form() == Form::furthest_site)
               throw py::type_error("the diagram of a FurthestSite triangulation is a FurthestVoronoi");
             return std::make_unique<HeldVoronoi>(source, tolerance);
           }),
           "points"_a, "tolerance"_a = 0.0)
      .def("__repr__", [](const HeldVoronoi& h) { return repr(h, "Voronoi"); })
      .def("__reduce__", [](const py::object& self) { return self.cast<const HeldVoronoi&>().recipe(self); });

  py::class_<HeldPower, HeldDiagram>(module, "PowerDiagram", text(docs::voronoi::power))
      .def(py::init([](const py::object& points, const py::object& weights, const py::object& tolerance) {
             if (weights.is_none() && !py::isinstance<HeldTriangulation>(points))
               throw py::type_error(
                   "PowerDiagram() of points needs 'weights'; without weights it is a Voronoi()");
             const py::object source = py::isinstance<HeldTriangulation>(points)
                                           ? points
                                           : py::module_::import("delone").attr("Regular")(points, weights);
             const auto& held = source.cast<const HeldTriangulation&>();
             if (held.form() != Form::regular)
               throw py::type_error("a power diagram is made from a Regular triangulation");
             return std::make_unique<HeldPower>(source, tolerance);
           }),
           "points"_a, "weights"_a = py::none(), "tolerance"_a = 0.0)
      .def_property_readonly("weights", &HeldDiagram::weights, "The weight of each row, (n,) float64.")
      .def("__repr__", [](const HeldPower& h) { return repr(h, "PowerDiagram"); })
      .def("__reduce__", [](const py::object& self) { return self.cast<const HeldPower&>().recipe(self); });

  py::class_<HeldFurthest, HeldDiagram>(module, "FurthestVoronoi", text(docs::voronoi::furthest))
      .def(py::init([](const py::object& points, const py::object& tolerance) {
             const py::object source = py::isinstance<HeldTriangulation>(points)
                                           ? points
                                           : py::module_::import("delone").attr("FurthestSite")(points);
             if (source.cast<const HeldTriangulation&>().form() != Form::furthest_site)
               throw py::type_error("a diagram of furthest sites is made from a FurthestSite triangulation");
             return std::make_unique<HeldFurthest>(source, tolerance);
           }),
           "points"_a, "tolerance"_a = 0.0)
      .def("__repr__", [](const HeldFurthest& h) { return repr(h, "FurthestVoronoi"); })
      .def("__reduce__",
           [](const py::object& self) { return self.cast<const HeldFurthest&>().recipe(self); });
}

}  // namespace delone::python
