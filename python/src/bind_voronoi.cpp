// SPDX-License-Identifier: BSD-3-Clause
// delone.Voronoi and PowerDiagram.
#include "arrays.hpp"
#include "module.hpp"
#include "triangulation.hpp"

#include <delone/voronoi.hpp>

#include <concepts>
#include <memory>
#include <optional>
#include <string>

namespace delone::python {
namespace {

using namespace py::literals;

/// Of nearest or of furthest sites: these have the same vertices, ridges and regions, and rays in the other
/// direction.
class UnweightedDiagram : public VoronoiDiagram {
 public:
  explicit UnweightedDiagram(const Triangulation& triangulation)
      : VoronoiDiagram(triangulation, nullptr, VoronoiParts::all) {}
};

/// A diagram and the points that it belongs to.
class HeldDiagram {
 public:
  explicit HeldDiagram(const py::object& triangulation) : source_type_(py::type::of(triangulation)) {
    const auto& source = triangulation.cast<const HeldTriangulation&>();
    is_furthest_ = source.form() == Form::furthest_site;
    Supervisor supervisor;
    for (std::uint64_t version = source.version() + 1;
         version != source.version();) {  // until no other thread adds points
      version = source.version();
      source_state_ = triangulation.attr("__getstate__")();
      supervisor.run([&] {
        source.with_product(supervisor, [&]<class Product>(const Product& product) {
          if constexpr (std::same_as<Product, Regular<>>)
            diagram_ = std::make_shared<PowerDiagram>(product);
          else
            diagram_ = std::make_shared<UnweightedDiagram>(product);
        });
        points_ = source.points(supervisor);
        weights_ = source.weights(supervisor);
      });
    }
  }

  /// For pickle: the triangulation, from which unpickling rebuilds the diagram.
  py::tuple recipe(const py::object& self) const {
    return py::make_tuple(py::module_::import("delone._pickling").attr("diagram"),
                          py::make_tuple(py::type::of(self), source_type_, source_state_));
  }

  const VoronoiDiagram& diagram() const { return *diagram_; }
  std::size_t dimension() const { return static_cast<std::size_t>(diagram_->dimension()); }
  bool is_furthest() const { return is_furthest_; }
  py::array ray_directions() const {
    const auto there = diagram_->ray_directions();
    if (!is_furthest_) return rows(there, diagram_->num_rays(), dimension());
    std::vector<double> opposite(there.begin(), there.end());
    for (double& x : opposite) x = 0 - x;
    return rows_view(std::move(opposite), diagram_->num_rays(), dimension());
  }
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
  py::object source_type_, source_state_;
  bool is_furthest_ = false;
  std::shared_ptr<const VoronoiDiagram> diagram_;
  std::shared_ptr<const std::vector<double>> points_, weights_;
};

class HeldVoronoi : public HeldDiagram {
  using HeldDiagram::HeldDiagram;
};
class HeldPower : public HeldDiagram {
  using HeldDiagram::HeldDiagram;
};

std::optional<Box> as_box(const py::object& object) {
  if (object.is_none()) return std::nullopt;
  const auto corners = as_doubles(object, "box");
  if (corners.ndim() != 2 || corners.shape(0) != 2)
    throw py::value_error("box: (low, high), each of d numbers");
  const auto numbers_of_both = numbers(corners);
  const std::size_t d = numbers_of_both.size() / 2;
  return Box{{numbers_of_both.begin(), numbers_of_both.begin() + static_cast<std::ptrdiff_t>(d)},
             {numbers_of_both.begin() + static_cast<std::ptrdiff_t>(d), numbers_of_both.end()}};
}

py::array region_volumes(const HeldDiagram& held, const py::object& object) {
  const std::optional<Box> box = as_box(object);
  if (box && held.is_furthest())
    throw Error(Errc::unsupported, "furthest-site diagrams are not cut off at boxes");
  Supervisor supervisor;
  return list_view(supervisor.run(
      [&] { return box ? held.diagram().region_volumes(*box) : held.diagram().region_volumes(); }));
}

std::size_t checked(std::size_t i, std::size_t count) {
  if (i >= count) throw py::index_error();
  return i;
}

std::string repr(const HeldDiagram& held, const char* name) {
  const VoronoiDiagram& v = held.diagram();
  return std::string("<delone.") + name + ": " + std::to_string(v.num_points()) + " points in dimension " +
         std::to_string(v.dimension()) + ", " + std::to_string(v.num_regions()) + " regions, " +
         std::to_string(v.num_vertices()) + " vertices>";
}

}  // namespace

void bind_voronoi(py::module_& module) {
  py::class_<HeldDiagram> base(module, "Diagram",
                               "What Voronoi and PowerDiagram share. k is the affine dimension.");
  base.def_property_readonly(
          "dimension", [](const HeldDiagram& h) { return h.diagram().dimension(); }, "d.")
      .def_property_readonly(
          "affine_dimension", [](const HeldDiagram& h) { return h.diagram().affine_dimension(); }, "k.")
      .def_property_readonly(
          "num_points", [](const HeldDiagram& h) { return h.diagram().num_points(); },
          "n, rows of the input.")
      .def_property_readonly(
          "num_vertices", [](const HeldDiagram& h) { return h.diagram().num_vertices(); }, "v.")
      .def_property_readonly(
          "num_regions", [](const HeldDiagram& h) { return h.diagram().num_regions(); }, "One for each site.")
      .def_property_readonly(
          "num_ridges", [](const HeldDiagram& h) { return h.diagram().num_ridges(); }, "r.")
      .def_property_readonly(
          "num_rays", [](const HeldDiagram& h) { return h.diagram().num_rays(); }, "Unbounded edges.")
      .def_property_readonly("points", &HeldDiagram::points, "(n, d) float64, read-only.")
      .def_property_readonly(
          "vertices",
          [](const HeldDiagram& h) {
            return h.rows(h.diagram().vertices(), h.diagram().num_vertices(), h.dimension());
          },
          "(v, d): the distinct centres of the cells' spheres, each coordinate the double nearest to the "
          "exact one.")
      .def_property_readonly(
          "ridge_points",
          [](const HeldDiagram& h) {
            return h.rows(h.diagram().ridge_points(), h.diagram().num_ridges(), 2);
          },
          "(r, 2) the rows of the two sites of each ridge.")
      .def_property_readonly(
          "ridge_vertices", [](const HeldDiagram& h) { return h.list(h.diagram().ridge_vertices()); },
          "The vertices of ridge i are ridge_vertices[ridge_offsets[i]:ridge_offsets[i+1]], -1 first if it "
          "is unbounded; in "
          "cyclic order for k = 3, otherwise increasing.")
      .def_property_readonly(
          "ridge_offsets", [](const HeldDiagram& h) { return h.list(h.diagram().ridge_offsets()); },
          "(r+1,) int64")
      .def_property_readonly(
          "region_vertices", [](const HeldDiagram& h) { return h.list(h.diagram().region_vertices()); },
          "The vertices of region i are region_vertices[region_offsets[i]:region_offsets[i+1]], -1 first if "
          "it is unbounded; "
          "in "
          "cyclic order for k = 2, otherwise increasing.")
      .def_property_readonly(
          "region_offsets", [](const HeldDiagram& h) { return h.list(h.diagram().region_offsets()); },
          "(regions+1,) int64")
      .def_property_readonly(
          "region_points", [](const HeldDiagram& h) { return h.list(h.diagram().region_points()); },
          "(regions,) the first row at the site of each region.")
      .def_property_readonly(
          "point_region", [](const HeldDiagram& h) { return h.list(h.diagram().point_region()); },
          "(n,) the region of each row; -1 for a hidden point.")
      .def_property_readonly(
          "is_bounded",
          [](const HeldDiagram& h) {
            py::array_t<bool> bounded(static_cast<py::ssize_t>(h.diagram().num_regions()));
            for (std::size_t i = 0; i < h.diagram().num_regions(); ++i)
              bounded.mutable_data()[i] = h.diagram().is_bounded(i);
            return bounded;
          },
          "(regions,) bool")
      .def_property_readonly(
          "ray_vertices", [](const HeldDiagram& h) { return h.list(h.diagram().ray_vertices()); },
          "The vertex that each unbounded edge starts from.")
      .def_property_readonly(
          "ray_directions", &HeldDiagram::ray_directions,
          "(rays, d) unit vectors away from the vertex: outward, of furthest sites inward.")
      .def_property_readonly(
          "ray_points",
          [](const HeldDiagram& h) {
            const std::size_t rays = h.diagram().num_rays();
            return h.rows(h.diagram().ray_points(), rays,
                          rays == 0 ? 0 : h.diagram().ray_points().size() / rays);
          },
          "(rays, k) the rows of the hull facet that each unbounded edge is dual to.")
      .def(
          "ridge",
          [](const HeldDiagram& h, std::size_t i) {
            return h.list(h.diagram().ridge(checked(i, h.diagram().num_ridges())));
          },
          "i"_a, "The vertices of ridge i.")
      .def(
          "region",
          [](const HeldDiagram& h, std::size_t i) {
            return h.list(h.diagram().region(checked(i, h.diagram().num_regions())));
          },
          "i"_a, "The vertices of region i.")
      .def("region_volumes", &region_volumes, "box"_a = py::none(),
           "(regions,) the k-volume of each region, infinite if unbounded; with box = (low, high) the "
           "d-volume within the box.")
      .def(
          "ridge_volumes",
          [](const HeldDiagram& h) {
            Supervisor supervisor;
            return list_view(supervisor.run([&] { return h.diagram().ridge_volumes(); }));
          },
          "(r,) the (k-1)-volume of each ridge, infinite if unbounded.")
      .def(
          "bounding_box",
          [](const HeldDiagram& h, double margin) {
            Box box = h.diagram().bounding_box(margin);
            return py::make_tuple(list_view(std::move(box.low)), list_view(std::move(box.high)));
          },
          "margin"_a = 0.1,
          "(low, high): the box of the sites, enlarged on each side by margin times its longest side.");

  py::class_<HeldVoronoi, HeldDiagram>(
      module, "Voronoi",
      "Voronoi(points)\n\n"
      "The Voronoi diagram of points, (n, d), or of a Delaunay triangulation: for each distinct point the "
      "region that is not\n"
      "nearer to any other; of a FurthestSite triangulation the regions that are not further from any other. "
      "Regions are "
      "numbered by the first rows of their sites. That cells have a vertex in common is\n"
      "decided exactly. Data of its own, which does not change when points are added to the triangulation.")
      .def(py::init([](const py::object& points) {
             const py::object source = py::isinstance<HeldTriangulation>(points)
                                           ? points
                                           : py::module_::import("delone").attr("Delaunay")(points);
             const auto& held = source.cast<const HeldTriangulation&>();
             if (held.form() == Form::regular)
               throw py::type_error("the diagram of a Regular triangulation is a PowerDiagram");
             return std::make_unique<HeldVoronoi>(source);
           }),
           "points"_a)
      .def("__repr__", [](const HeldVoronoi& h) { return repr(h, "Voronoi"); })
      .def("__reduce__", [](const py::object& self) { return self.cast<const HeldVoronoi&>().recipe(self); });

  py::class_<HeldPower, HeldDiagram>(
      module, "PowerDiagram",
      "PowerDiagram(points, weights=None)\n\n"
      "The power diagram of points, (n, d), with weights, (n,), or of a Regular triangulation: as Voronoi, "
      "with the power\n"
      "|x − p|² − weight in place of the squared distance. Hidden points have no region.")
      .def(py::init([](const py::object& points, const py::object& weights) {
             const py::object source = py::isinstance<HeldTriangulation>(points)
                                           ? points
                                           : py::module_::import("delone").attr("Regular")(points, weights);
             const auto& held = source.cast<const HeldTriangulation&>();
             if (held.form() != Form::regular)
               throw py::type_error("a power diagram is made from a Regular triangulation");
             return std::make_unique<HeldPower>(source);
           }),
           "points"_a, "weights"_a = py::none())
      .def_property_readonly("weights", &HeldDiagram::weights, "(n,) float64, read-only.")
      .def("__repr__", [](const HeldPower& h) { return repr(h, "PowerDiagram"); })
      .def("__reduce__", [](const py::object& self) { return self.cast<const HeldPower&>().recipe(self); });
}

}  // namespace delone::python
