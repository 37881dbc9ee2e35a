// SPDX-License-Identifier: BSD-3-Clause
// Many convex hulls as one object, and the volumes of their intersections.
#include "object.hpp"
#include "options.hpp"

#include <delone/convex_hulls.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace delone::c {
namespace {

class HullsObject final : public delone_object {
 public:
  HullsObject(PointsView points, ConvexHulls hulls)
      : points_(points.coordinates().begin(), points.coordinates().end()),
        hulls_(std::move(hulls)),
        vertex_offsets_(hulls_.vertex_offsets.begin(), hulls_.vertex_offsets.end()),
        cell_offsets_(hulls_.cell_offsets.begin(), hulls_.cell_offsets.end()) {}
  const char* kind() const override { return "convex_hulls"; }
  const Members& members() const override;

  PointsView points() const { return {points_, hulls_.dimension}; }
  const ConvexHulls& hulls() const { return hulls_; }

 private:
  std::vector<double> points_;
  ConvexHulls hulls_;
  std::vector<std::int64_t> vertex_offsets_, cell_offsets_;
};

const Members& HullsObject::members() const {
  using Object = HullsObject;
  static const Members all = {
      member<Object>("dimension", [](const Object& o) { return o.hulls_.dimension; }),
      member<Object>("num_hulls", [](const Object& o) { return o.hulls_.size(); }),
      member<Object>("points", [](const Object& o) { return table(o.points_, o.hulls_.dimension); }),
      member<Object>("affine_dimensions", [](const Object& o) { return list(o.hulls_.affine_dimensions); }),
      member<Object>("vertex_offsets", [](const Object& o) { return list(o.vertex_offsets_); }),
      member<Object>("cell_offsets", [](const Object& o) { return list(o.cell_offsets_); }),
      member<Object>("vertices", [](const Object& o) { return list(o.hulls_.vertices); }),
      member<Object>("cells", [](const Object& o) { return table(o.hulls_.cells, o.hulls_.dimension); }),
      member<Object>("neighbors",
                     [](const Object& o) { return table(o.hulls_.neighbors, o.hulls_.dimension); }),
      member<Object>("equations",
                     [](const Object& o) { return table(o.hulls_.equations, o.hulls_.dimension + 1); }),
      member<Object>("volumes", [](const Object& o) { return list(o.hulls_.volumes); }),
      member<Object>("areas", [](const Object& o) { return list(o.hulls_.areas); }),
  };
  return all;
}

}  // namespace
}  // namespace delone::c

using namespace delone;
using namespace delone::c;

int delone_convex_hulls(const double* points, std::size_t num_points, int dimension,
                        const std::size_t* offsets, std::size_t num_sets, const delone_options* options,
                        delone_object** object) {
  return make(object, [&] {
    const PointsView view = view_of(points, num_points, dimension, "points");
    required(offsets, "offsets");
    if (num_sets == SIZE_MAX) throw Error(Errc::too_many, "there is no memory for that many sets");
    return std::make_unique<HullsObject>(
        view, convex_hulls(view, dimension, matrix(offsets, num_sets + 1, 1, "offsets"),
                           without_tolerance(options)));
  });
}

int delone_intersection_volumes(const delone_object* hulls, const std::int64_t* pairs, std::size_t num_pairs,
                                const delone_options* options, double* volumes) {
  return run([&] {
    const HullsObject& of = as<const HullsObject>(hulls, "convex hulls");
    std::vector<std::size_t> numbers;
    for (const std::int64_t hull : matrix(pairs, num_pairs, 2, "pairs")) {
      if (hull < 0) throw Error(Errc::invalid_argument, "pairs: there is no hull " + std::to_string(hull));
      numbers.push_back(static_cast<std::size_t>(hull));
    }
    const std::vector<double> found =
        intersection_volumes(of.points(), of.hulls(), numbers, execution(options));
    if (!found.empty()) std::ranges::copy(found, &required(volumes, "volumes"));
  });
}
