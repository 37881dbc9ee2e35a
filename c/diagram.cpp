// SPDX-License-Identifier: BSD-3-Clause
#include "diagram.hpp"

#include "options.hpp"
#include "triangulation.hpp"

#include <delone/io.hpp>

#include <algorithm>
#include <memory>

namespace delone::c {
namespace {

using Object = DiagramObject;
using Made = MadeDiagram;

template <auto Array>
Member list_of(const char* name) {
  return member<Object>(name, [](const Object& o) { return list(o.data().*Array); });
}

}  // namespace

void DiagramObject::write(const std::string& path, const std::string& format) const {
  delone::write(path, data(), format);
}

Members DiagramObject::members_of_data() {
  using Data = VoronoiData;
  return {
      member<Object>("dimension", [](const Object& o) { return o.data().dimension; }),
      member<Object>("affine_dimension", [](const Object& o) { return o.data().affine_dimension; }),
      member<Object>("kind", [](const Object& o) { return name_of(o.data().kind).data(); }),
      member<Object>("num_points", [](const Object& o) { return o.data().num_points(); }),
      member<Object>("num_vertices", [](const Object& o) { return o.data().num_vertices(); }),
      member<Object>("num_regions", [](const Object& o) { return o.data().num_regions(); }),
      member<Object>("num_ridges", [](const Object& o) { return o.data().num_ridges(); }),
      member<Object>("num_rays", [](const Object& o) { return o.data().num_rays(); }),
      member<Object>("tolerance", [](const Object& o) { return o.data().tolerance; }),
      member<Object>("points", [](const Object& o) { return table(o.data().points, o.data().dimension); }),
      list_of<&Data::axis_tolerances>("axis_tolerances"),
      list_of<&Data::weights>("weights"),
      member<Object>("vertices",
                     [](const Object& o) { return table(o.data().vertices, o.data().dimension); }),
      member<Object>("ridge_points", [](const Object& o) { return table(o.data().ridge_points, 2); }),
      list_of<&Data::ridge_offsets>("ridge_offsets"),
      list_of<&Data::ridge_vertices>("ridge_vertices"),
      list_of<&Data::region_offsets>("region_offsets"),
      list_of<&Data::region_vertices>("region_vertices"),
      list_of<&Data::point_region>("point_region"),
      list_of<&Data::ray_vertices>("ray_vertices"),
      member<Object>("ray_directions",
                     [](const Object& o) { return table(o.data().ray_directions, o.data().dimension); }),
      member<Object>("ray_points",
                     [](const Object& o) { return table(o.data().ray_points, o.data().affine_dimension); }),
  };
}

const Members& GivenDiagram::members() const {
  static const Members all = members_of_data();
  return all;
}

const Members& MadeDiagram::members() const {
  static const Members all =
      members_of_data() +
      Members{
          member<Made>("num_unbounded_regions",
                       [](const Made& o) { return o.diagram().num_unbounded_regions(); }),
          member<Made>("max_displacement", [](const Made& o) { return o.diagram().max_displacement(); }),
          member<Made>("region_points", [](const Made& o) { return list(o.diagram().region_points()); }),
          member<Made>("region_volumes",
                       [](const Made& o) {
                         return list(o.region_volumes_.get(
                             [&] { return o.diagram().region_volumes({.threads = o.threads_}); }));
                       }),
          member<Made>("ridge_volumes",
                       [](const Made& o) {
                         return list(o.ridge_volumes_.get(
                             [&] { return o.diagram().ridge_volumes({.threads = o.threads_}); }));
                       }),
      };
  return all;
}

std::unique_ptr<delone_object> MadeDiagram::clone() const {
  return std::visit([&](const auto& one) { return std::make_unique<MadeDiagram>(one.clone(), threads_); },
                    any_);
}

void MadeDiagram::write(const std::string& path, const std::string& format) const {
  delone::write(path, diagram(), std::nullopt, format);
}

}  // namespace delone::c

using namespace delone;
using namespace delone::c;

int delone_voronoi(const delone_object* triangulation, const delone_options* options,
                   delone_object** object) {
  return make(object, [&] {
    const MadeTriangulation& of = as_made(triangulation);
    const DiagramOptions wanted{.tolerance = given(options).tolerance,
                                .axis_tolerances = given(options).axis_tolerances};
    const Execution how = execution(options);
    const AnyTriangulation& any = of.product()->any;
    if (const auto* const delaunay = std::get_if<Delaunay<>>(&any))
      return std::make_unique<MadeDiagram>(Voronoi<>(*delaunay, wanted, how), how.threads);
    if (const auto* const regular = std::get_if<Regular<>>(&any))
      return std::make_unique<MadeDiagram>(PowerDiagram<>(*regular, wanted, how), how.threads);
    return std::make_unique<MadeDiagram>(FurthestVoronoi<>(std::get<FurthestSite<>>(any), wanted, how),
                                         how.threads);
  });
}

int delone_region_volumes(const delone_object* diagram, const double* low, const double* high,
                          const delone_options* options, double* volumes) {
  return run([&] {
    const Diagram& of = as<const MadeDiagram>(diagram, "a diagram that was made").diagram();
    const auto d = static_cast<std::size_t>(of.dimension());
    const std::span<const double> from = matrix(low, d, 1, "low"), to = matrix(high, d, 1, "high");
    const std::vector<double> found =
        of.region_volumes({{from.begin(), from.end()}, {to.begin(), to.end()}}, execution(options));
    if (!found.empty()) std::ranges::copy(found, &required(volumes, "volumes"));
  });
}
