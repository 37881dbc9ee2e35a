// SPDX-License-Identifier: BSD-3-Clause
// The implementation of BoundaryEngine for one dimension K of its cells: joins engine/ and geometry/.
#pragma once

#include "compiled/boundary_engine.hpp"
#include "compiled/engine_of.hpp"
#include "engine/replace_cells.hpp"
#include "geometry/central_geometry.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace delone::compiled {

template <int K>
class BoundaryEngineOf final : public EngineOf<BoundaryEngine, geometry::CentralGeometry<K>, K> {
  using Base = EngineOf<BoundaryEngine, geometry::CentralGeometry<K>, K>;
  using Base::build_;

 public:
  using Base::geometry;

  BoundaryEngineOf(const BoundarySites& sites, const CentralView& view, std::vector<Index> simplex)
      : BoundaryEngineOf(sites, view, std::move(simplex), nullptr) {
    std::vector<Index> vertices = vertices_of(simplex_);
    const Index last = vertices.back();
    vertices.pop_back();
    internal::StageCounts uncounted;
    if (geometry().side(vertices.data(), geometry().point(last), uncounted) == Sign::negative)
      std::swap(vertices[0], vertices[1]);
    build_.seed(vertices, last);
  }

  void update_box() override {
    geometry().update_box();
    build_.create_functionals();
  }
  void replace_cells(const SimplicialHull& hull, std::span<const Index> planes) override {
    auto& cells = build_.cells();
    engine::replace_cells(
        cells, geometry(), hull.cells, [](Index site) { return site + 1; }, hull.neighbors, planes);
    build_.starts_with(0, static_cast<Index>(planes.size()));
    Index& last = build_.workspace().last_cell;
    while (cells.is_vacant(last)) ++last;
  }
  std::unique_ptr<BoundaryEngine> copy(const BoundarySites& sites, const CentralView& view) const override {
    return std::unique_ptr<BoundaryEngine>(new BoundaryEngineOf(sites, view, simplex_, this));
  }

 private:
  /// No cells, or those of another engine.
  BoundaryEngineOf(const BoundarySites& sites, const CentralView& view, std::vector<Index> simplex,
                   const BoundaryEngineOf* other)
      : Base(sites.dimension() - 1, cells::ids_for(sites.size()), sites, view, vertices_of(simplex)),
        simplex_(std::move(simplex)) {
    geometry().update_box();
    if (other != nullptr) build_.copy_cells(other->build_);
  }

  static std::vector<Index> vertices_of(std::vector<Index> sites) {
    for (Index& site : sites) ++site;
    return sites;
  }

  std::vector<Index> simplex_;
};

/// For cells of K dimensions, or of any number if K is 0. Defined and compiled in a file for each
/// K (boundary_engine_instance.cpp.in).
template <int K>
std::unique_ptr<BoundaryEngine> make_boundary_engine_of(const BoundarySites& sites, const CentralView& view,
                                                        std::vector<Index> simplex);

}  // namespace delone::compiled
