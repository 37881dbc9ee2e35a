// SPDX-License-Identifier: BSD-3-Clause
#include "hull.hpp"

#include "options.hpp"

#include <delone/io.hpp>

#include <memory>
#include <utility>

namespace delone::c {
namespace {

using Object = HullObject;
using Made = MadeHull;

}  // namespace

CheckReport HullObject::check(const CheckOptions& options, const Execution& how) const {
  return delone::check(with_points(), of_any_data(options), how);
}

void HullObject::write(const std::string& path, const std::string& format) const {
  delone::write(path, with_points(), format);
}

Members HullObject::members_of_data() {
  return {
      member<Object>("dimension", [](const Object& o) { return o.data().dimension; }),
      member<Object>("affine_dimension", [](const Object& o) { return o.data().affine_dimension; }),
      member<Object>("kind", [](const Object&) { return name_of(HullData::kind).data(); }),
      member<Object>("num_points", [](const Object& o) { return o.data().num_points(); }),
      member<Object>("num_cells", [](const Object& o) { return o.data().num_cells(); }),
      member<Object>("num_vertices", [](const Object& o) { return o.data().vertices.size(); }),
      member<Object>("num_facets", [](const Object& o) { return o.data().num_facets(); }),
      member<Object>("num_ridges", [](const Object& o) { return o.data().num_ridges(); }),
      member<Object>("tolerance", [](const Object& o) { return o.data().tolerance; }),
      member<Object>("max_distance", [](const Object& o) { return o.data().max_distance; }),
      member<Object>("axis_tolerances", [](const Object& o) { return list(o.data().axis_tolerances); }),
      member<Object>("points", [](const Object& o) { return table(o.points(), o.data().dimension); }),
      member<Object>("cells",
                     [](const Object& o) { return table(o.data().cells, o.data().affine_dimension); }),
      member<Object>("neighbors",
                     [](const Object& o) { return table(o.data().neighbors, o.data().affine_dimension); }),
      member<Object>("facet_of_cell", [](const Object& o) { return list(o.data().facet_of_cell); }),
      member<Object>("facet_offsets", [](const Object& o) { return list(o.data().facet_offsets); }),
      member<Object>("facet_vertices", [](const Object& o) { return list(o.data().facet_vertices); }),
      member<Object>("ridge_facets", [](const Object& o) { return table(o.data().ridge_facets, 2); }),
      member<Object>("ridge_offsets", [](const Object& o) { return list(o.data().ridge_offsets); }),
      member<Object>("ridge_vertices", [](const Object& o) { return list(o.data().ridge_vertices); }),
      member<Object>("equations",
                     [](const Object& o) { return table(o.data().equations, o.data().dimension + 1); }),
      member<Object>("equation_errors", [](const Object& o) { return list(o.data().equation_errors); }),
      member<Object>("vertices", [](const Object& o) { return list(o.data().vertices); }),
      member<Object>("vertex_of_point", [](const Object& o) { return list(o.data().vertex_of_point); }),
      member<Object>("point_kinds", [](const Object& o) { return list(o.data().point_kinds); }),
      member<Object>("axes", [](const Object& o) { return list(o.data().axes); }),
  };
}

const Members& GivenHull::members() const {
  static const Members all = members_of_data();
  return all;
}

const Members& MadeHull::members() const {
  static const Members all =
      members_of_data() +
      Members{
          member<Made>("num_duplicates", [](const Made& o) { return o.hull_.num_duplicates(); }),
          member<Made>("volume", [](const Made& o) { return o.hull_.volume().value; }),
          member<Made>("volume_error", [](const Made& o) { return o.hull_.volume().error; }),
          member<Made>("area", [](const Made& o) { return o.hull_.area().value; }),
          member<Made>("area_error", [](const Made& o) { return o.hull_.area().error; }),
          member<Made>("f_vector",
                       [](const Made& o) {
                         return list(o.f_vector_.get([&] {
                           const std::vector<std::size_t> counts = o.hull_.f_vector();
                           return std::vector<std::int64_t>(counts.begin(), counts.end());
                         }));
                       }),
          member<Made>("hash",
                       [](const Made& o) -> const std::string& {
                         return o.hash_.get([&] { return o.hull_.hash().hex(); });
                       }),
      };
  return all;
}

const std::vector<double>& MadeHull::points() const {
  return points_.get([&] {
    std::vector<double> points;
    points.reserve(hull_.num_points() * static_cast<std::size_t>(hull_.dimension()));
    for (std::size_t row = 0; row < hull_.num_points(); ++row) {
      const std::span<const double> point = hull_.point(row);
      points.insert(points.end(), point.begin(), point.end());
    }
    return points;
  });
}

std::unique_ptr<delone_object> MadeHull::clone() const { return std::make_unique<MadeHull>(hull_.clone()); }

void MadeHull::insert(const double* rows, std::size_t num_rows, const double* weights) {
  if (weights != nullptr) throw Error(Errc::invalid_argument, "points of a convex hull have no weights");
  const PointsView points = view_of(rows, num_rows, hull_.dimension(), "rows");
  const AtEnd changed([&] {  // the rows may be an array of this object
    f_vector_.reset();
    hash_.reset();
    points_.reset();
  });
  hull_.insert_range(points);
}

}  // namespace delone::c

using namespace delone;
using namespace delone::c;

int delone_convex_hull(const double* points, std::size_t num_points, int dimension,
                       const delone_options* options, delone_object** object) {
  return make(object, [&] {
    Options how = with_tolerance(options);
    how.axis_tolerances = given(options).axis_tolerances;
    return std::make_unique<MadeHull>(
        ConvexHull<>(view_of(points, num_points, dimension, "points"), dimension, how));
  });
}

int delone_visible_facets(const delone_object* hull, const double* queries, std::size_t num_queries,
                          delone_object** lists) {
  return make(lists, [&] {
    const ConvexHull<>& of = as<const MadeHull>(hull, "a convex hull that was made").hull();
    const PointsView points = view_of(queries, num_queries, of.dimension(), "queries");
    std::vector<std::vector<std::int64_t>> found(num_queries);
    for (std::size_t i = 0; i < num_queries; ++i) {
      cancellation_point();
      const std::vector<SignedIndex> facets = of.visible_facets(points[i]);
      found[i].assign(facets.begin(), facets.end());
    }
    auto [offsets, facets] = joined(found);
    auto results = std::make_unique<Results>("lists");
    results->add("offsets", std::move(offsets));
    results->add("facets", std::move(facets));
    return results;
  });
}
