// SPDX-License-Identifier: BSD-3-Clause
// What a Polyhedron shares with its copies.
#pragma once

#include "base/build_limits.hpp"
#include "base/guarded.hpp"
#include "base/progress_meter.hpp"
#include "polyhedra/description.hpp"

#include <delone/polyhedron.hpp>

#include <utility>
#include <vector>

struct delone::Polyhedron::Impl {
  Impl(polyhedra::Description given, std::vector<RowKind> roles)
      : description(std::move(given)),
        generators_of_facets(description.incidence.transposed(description.facets.size())),
        kinds(std::move(roles)) {}

  polyhedra::Description description;
  polyhedra::BitRows generators_of_facets;
  std::vector<RowKind> kinds;
};

namespace delone::polyhedra {

/// Runs what makes a polyhedron, within the limits of the options; `items`: what is counted.
template <class Work>
decltype(auto) within_limits(const Options& options, Work&& work, const char* items = "rows") {
  return internal::guarded("the polyhedron", [&]() -> decltype(auto) {
    internal::BuildLimits limits(options.memory_limit, options.time_limit, items);
    const internal::ProgressMeter meter(options.progress);
    return limits.guard(std::forward<Work>(work));
  });
}

}  // namespace delone::polyhedra
