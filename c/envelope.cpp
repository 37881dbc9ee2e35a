// SPDX-License-Identifier: BSD-3-Clause
#include "envelope.hpp"

#include "options.hpp"

#include <delone/io.hpp>

#include <algorithm>
#include <memory>
#include <vector>

namespace delone::c {

const Members& EnvelopeObject::members() const {
  using Object = EnvelopeObject;
  static const Members all = {
      member<Object>("dimension", [](const Object& o) { return o.hull_.dimension(); }),
      member<Object>("composition_dimension",
                     [](const Object& o) { return o.hull_.composition_dimension(); }),
      member<Object>("num_points", [](const Object& o) { return o.hull_.num_points(); }),
      member<Object>("num_cells", [](const Object& o) { return o.hull_.num_cells(); }),
      member<Object>("num_facets", [](const Object& o) { return o.hull_.num_facets(); }),
      member<Object>("tolerance", [](const Object& o) { return o.hull_.tolerance(); }),
      member<Object>("max_distance", [](const Object& o) { return o.hull_.max_distance(); }),
      member<Object>(
          "cells",
          [](const Object& o) { return table(o.hull_.cells(), o.hull_.composition_dimension() + 1); }),
      member<Object>(
          "neighbors",
          [](const Object& o) { return table(o.hull_.neighbors(), o.hull_.composition_dimension() + 1); }),
      member<Object>("facet_of_cell", [](const Object& o) { return list(o.hull_.facet_of_cell()); }),
      member<Object>("vertices", [](const Object& o) { return list(o.hull_.vertices()); }),
      member<Object>(
          "composition_axes",
          [](const Object& o) { return list(o.axes_.get([&] { return o.hull_.composition_axes(); })); }),
  };
  return all;
}

std::unique_ptr<delone_object> EnvelopeObject::clone() const {
  return std::make_unique<EnvelopeObject>(hull_.clone());
}

CheckReport EnvelopeObject::check(const CheckOptions& options, const Execution& how) const {
  return delone::check(hull_.to_data(), of_any_data(options), how);
}

void EnvelopeObject::write(const std::string& path, const std::string& format) const {
  delone::write(path, hull_.to_data(), format);
}

}  // namespace delone::c

using namespace delone;
using namespace delone::c;

namespace {

int make_envelope(const double* points, std::size_t num_points, int dimension, HullSide side,
                  const delone_options* options, delone_object** object) {
  return make(object, [&] {
    return std::make_unique<EnvelopeObject>(LowerHull<>(view_of(points, num_points, dimension, "points"),
                                                        dimension, side, with_tolerance(options)));
  });
}

const LowerHull<>& hull_of(const delone_object* object) {
  return as<const EnvelopeObject>(object, "a lower or upper hull").hull();
}

void give(const std::vector<double>& heights, double* to) {
  if (!heights.empty()) std::ranges::copy(heights, &required(to, "heights"));
}

}  // namespace

int delone_lower_hull(const double* points, std::size_t num_points, int dimension,
                      const delone_options* options, delone_object** object) {
  return make_envelope(points, num_points, dimension, HullSide::lower, options, object);
}

int delone_upper_hull(const double* points, std::size_t num_points, int dimension,
                      const delone_options* options, delone_object** object) {
  return make_envelope(points, num_points, dimension, HullSide::upper, options, object);
}

int delone_heights(const delone_object* hull, const double* compositions, std::size_t num_queries,
                   double* heights) {
  return run([&] {
    const LowerHull<>& of = hull_of(hull);
    give(of.heights(view_of(compositions, num_queries, of.dimension() - 1, "compositions")), heights);
  });
}

int delone_height_above(const delone_object* hull, const double* points, std::size_t num_queries,
                        const delone_options* options, double* heights) {
  return run([&] {
    const LowerHull<>& of = hull_of(hull);
    give(of.height_above(view_of(points, num_queries, of.dimension(), "points"), given(options).tolerance),
         heights);
  });
}
