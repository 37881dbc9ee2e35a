// SPDX-License-Identifier: BSD-3-Clause
// What is compiled of a boundary for a dimension K of its cells, or for any if K is 0: the engine, in files
// of its own (boundary_engine_of_dimension.hpp), and what looks at its cells (boundary_engine.cpp).
#pragma once

#include "compiled/boundary_engine.hpp"
#include "engine/sphere.hpp"
#include "geometry/central_geometry.hpp"

namespace delone::compiled {

/// The dimension of the cells of a boundary that spans k dimensions.
constexpr int cells_in(int k) { return k > 1 ? k - 1 : 0; }

template <int K>
class BoundaryOfCells : public BoundaryEngine {
 public:
  using Sphere = engine::Sphere<K, geometry::CentralGeometry<K>>;
  virtual const Sphere& sphere() const = 0;

 protected:
  using BoundaryEngine::BoundaryEngine;
};

template <int K>
std::unique_ptr<BoundaryEngine> make_boundary_of_cells(const BoundarySites& sites, const CentralView& view,
                                                       std::vector<Index> simplex);

}  // namespace delone::compiled
