// SPDX-License-Identifier: BSD-3-Clause
// What is compiled of the engine of boundaries for each dimension of its cells, in files that CMake makes.
#pragma once

#include "compiled/boundary_engine_of.hpp"

namespace delone::compiled {

template <int K>
std::unique_ptr<BoundaryEngine> make_boundary_engine_of(const BoundarySites& sites, const CentralView& view,
                                                        std::vector<Index> simplex) {
  return std::make_unique<BoundaryEngineOf<K>>(sites, view, std::move(simplex));
}

}  // namespace delone::compiled
