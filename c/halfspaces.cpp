// SPDX-License-Identifier: BSD-3-Clause
#include "halfspaces.hpp"

#include "options.hpp"

#include <delone/io.hpp>

#include <memory>

namespace delone::c {
namespace {

using Object = IntersectionObject;
using Made = MadeIntersection;

const char* name_of(IntersectionState state) {
  switch (state) {
    case IntersectionState::full:
      return "full";
    case IntersectionState::flat:
      return "flat";
    case IntersectionState::empty:
      break;
  }
  return "empty";
}

/// Where entry i of the array of coordinates is a row of d.
template <auto Array>
Member rows_of_coordinates(const char* name) {
  return member<Object>(name, [](const Object& o) { return table(o.data().*Array, o.data().dimension); });
}
template <auto Array>
Member list_of(const char* name) {
  return member<Object>(name, [](const Object& o) { return list(o.data().*Array); });
}

}  // namespace

void IntersectionObject::write(const std::string& path, const std::string& format) const {
  delone::write(path, data(), format);
}

Members IntersectionObject::members_of_data() {
  using Data = IntersectionData;
  return {
      member<Object>("dimension", [](const Object& o) { return o.data().dimension; }),
      member<Object>("rank", [](const Object& o) { return o.data().rank; }),
      member<Object>("state", [](const Object& o) { return name_of(o.data().state); }),
      member<Object>("kind", [](const Object&) { return delone::name_of(Data::kind).data(); }),
      member<Object>("num_halfspaces", [](const Object& o) { return o.data().num_halfspaces(); }),
      member<Object>("num_vertices", [](const Object& o) { return o.data().num_vertices(); }),
      member<Object>("num_directions", [](const Object& o) { return o.data().num_directions(); }),
      member<Object>("num_edges", [](const Object& o) { return o.data().num_edges(); }),
      member<Object>("num_rays", [](const Object& o) { return o.data().num_rays(); }),
      member<Object>("num_facets", [](const Object& o) { return o.data().num_facets(); }),
      member<Object>("bounded", [](const Object& o) { return o.data().bounded; }),
      member<Object>("interior_point_is_exact",
                     [](const Object& o) { return o.data().interior_point_is_exact; }),
      member<Object>("halfspaces",
                     [](const Object& o) { return table(o.data().halfspaces, o.data().dimension + 1); }),
      list_of<&Data::first_of_halfspace>("first_of_halfspace"),
      list_of<&Data::kinds>("kinds"),
      list_of<&Data::witness>("witness"),
      list_of<&Data::interior_point>("interior_point"),
      list_of<&Data::axes>("axes"),
      rows_of_coordinates<&Data::vertices>("vertices"),
      list_of<&Data::vertex_offsets>("vertex_offsets"),
      list_of<&Data::vertex_halfspaces>("vertex_halfspaces"),
      rows_of_coordinates<&Data::directions>("directions"),
      list_of<&Data::direction_offsets>("direction_offsets"),
      list_of<&Data::direction_halfspaces>("direction_halfspaces"),
      member<Object>("edges", [](const Object& o) { return table(o.data().edges, 2); }),
      member<Object>("rays", [](const Object& o) { return table(o.data().rays, 2); }),
      list_of<&Data::facet_halfspaces>("facet_halfspaces"),
      list_of<&Data::facet_offsets>("facet_offsets"),
      list_of<&Data::facet_vertices>("facet_vertices"),
      list_of<&Data::facet_direction_offsets>("facet_direction_offsets"),
      list_of<&Data::facet_directions>("facet_directions"),
      rows_of_coordinates<&Data::lineality>("lineality"),
      rows_of_coordinates<&Data::dual_points>("dual_points"),
      member<Object>("dual_equations",
                     [](const Object& o) { return table(o.data().dual_equations, o.data().dimension + 1); }),
  };
}

const Members& GivenIntersection::members() const {
  static const Members all = members_of_data();
  return all;
}

const Members& MadeIntersection::members() const {
  static const Members all =
      members_of_data() +
      Members{
          member<Made>("volume", [](const Made& o) { return o.polyhedron_.volume().value; }),
          member<Made>("dual_volume", [](const Made& o) { return o.polyhedron_.dual_volume().value; }),
          member<Made>("dual_area", [](const Made& o) { return o.polyhedron_.dual_area().value; }),
      };
  return all;
}

std::unique_ptr<delone_object> MadeIntersection::clone() const {
  return std::make_unique<MadeIntersection>(polyhedron_.clone());
}

void MadeIntersection::insert(const double* rows, std::size_t num_rows, const double* weights) {
  if (weights != nullptr) throw Error(Errc::invalid_argument, "halfspaces have no weights");
  const PointsView halfspaces = view_of(rows, num_rows, polyhedron_.dimension() + 1, "rows");
  const AtEnd changed([&] { data_.reset(); });  // the rows may be an array of this object
  polyhedron_.insert_range(halfspaces);
}

}  // namespace delone::c

using namespace delone;
using namespace delone::c;

int delone_halfspace_intersection(const double* halfspaces, std::size_t num_halfspaces, int dimension,
                                  const double* interior_point, const delone_options* options,
                                  delone_object** object) {
  return make(object, [&] {
    view_of(nullptr, 0, dimension, "halfspaces");
    if (dimension == std::numeric_limits<int>::max())
      throw Error(Errc::bad_dimension, "halfspaces: there is no memory for rows of that size");
    const PointsView rows = view_of(halfspaces, num_halfspaces, dimension + 1, "halfspaces");
    const Options how = without_tolerance(options);
    if (interior_point == nullptr)
      return std::make_unique<MadeIntersection>(HalfspaceIntersection<>(rows, dimension, how));
    const std::span<const double> inside(interior_point, static_cast<std::size_t>(dimension));
    return std::make_unique<MadeIntersection>(HalfspaceIntersection<>(rows, dimension, inside, how));
  });
}
