// SPDX-License-Identifier: BSD-3-Clause
// The implementation of HullBoundary for one dimension: joins engine/ and geometry/.
#pragma once

#include "engine/build.hpp"
#include "engine/seed.hpp"
#include "front_ends/hull_boundary.hpp"
#include "geometry/hull_geometry.hpp"

#include <utility>

namespace delone::front_ends {

template <int K>
class HullBoundaryOfDimension final : public HullBoundary {
 public:
  HullBoundaryOfDimension(const HullSites& sites, const HullView& view, std::vector<Index> simplex)
      : HullBoundaryOfDimension(sites, view, std::move(simplex), nullptr) {
    std::vector<Index> vertices = this->vertices();
    const Index last = vertices.back();
    vertices.pop_back();
    StageCounts uncounted;
    if (geometry_.side(vertices.data(), geometry_.point(last), uncounted) == Sign::negative)
      std::swap(vertices[0], vertices[1]);
    engine::seed(cells_, geometry_, vertices, last);
    effort_.created_cells = cells_.num_cells();
  }

  bool insert(Index site) override {
    const Index v = site + 1;
    const auto q = geometry_.make_query(sites_.point(site));
    if (view_.is_inside) {
      if (engine::insert(cells_, geometry_, v, q, work_.last_cell, work_, effort_) == invalid_index) return false;
    } else {
      const Index cell = find_conflict(q);
      if (cell == invalid_index) return false;
      engine::insert_in_conflict(cells_, geometry_, v, q, cell, work_, effort_);
    }
    work_.last_cell = work_.star().back().created;
    return true;
  }

  void update_box() override {
    geometry_.set_box(view_.low.data(), view_.high.data());
    for (Index cell = 0; cell < cells_.num_slots(); ++cell)
      if (!cells_.is_vacant(cell)) geometry_.create(cell, cells_.vertices(cell), -1, 0);
  }

  std::unique_ptr<HullBoundary> copy(const HullSites& sites, const HullView& view) const override {
    return std::unique_ptr<HullBoundary>(new HullBoundaryOfDimension(sites, view, simplex_, this));
  }

  SimplicialHull to_simplicial_hull() const override {
    SimplicialHull hull;
    const std::size_t k = static_cast<std::size_t>(cells_.dimension()) + 1;
    hull.dimension = static_cast<int>(k);
    std::vector<Index> compact(cells_.num_slots(), invalid_index);
    Index next = 0;
    for (Index cell = 0; cell < cells_.num_slots(); ++cell)
      if (!cells_.is_vacant(cell)) compact[cell] = next++;
    hull.cells.reserve(next * k);
    hull.neighbors.reserve(next * k);
    for (Index cell = 0; cell < cells_.num_slots(); ++cell) {
      if (cells_.is_vacant(cell)) continue;
      for (std::size_t i = 0; i < k; ++i) {
        hull.cells.push_back(cells_.vertices(cell)[i] - 1);
        hull.neighbors.push_back(compact[cells_.neighbors(cell)[i]]);
      }
    }
    return hull;
  }
  const engine::Effort& effort() const override { return effort_; }
  std::size_t bytes() const override { return cells_.bytes(); }

 private:
  /// An empty boundary, or a copy.
  HullBoundaryOfDimension(const HullSites& sites, const HullView& view, std::vector<Index> simplex,
                          const HullBoundaryOfDimension* other)
      : sites_(sites),
        view_(view),
        simplex_(std::move(simplex)),
        memory_(static_cast<int>(sites.axes.size()) - 1),
        cells_(memory_),
        geometry_(memory_, sites.axes, sites.ambient, sites.coordinates, view.grid, view.center, view.is_inside, vertices()) {
    geometry_.set_box(view.low.data(), view.high.data());
    if (other == nullptr) return;
    memory_.copy(other->memory_, other->cells_.num_slots());
    cells_.copy_slots(other->cells_);
    work_.last_cell = other->work_.last_cell;
    effort_ = other->effort_;
  }

  /// Those of the first simplex.
  std::vector<Index> vertices() const {
    std::vector<Index> vertices = simplex_;
    for (Index& v : vertices) ++v;
    return vertices;
  }

  /// A cell in conflict with q, or invalid_index: all cells are asked.
  Index find_conflict(const typename geometry::HullGeometry<K>::Query& q) {
    for (Index cell = 0; cell < cells_.num_slots(); ++cell)
      if (!cells_.is_vacant(cell) && engine::in_conflict_exactly(cells_, geometry_, cell, q, effort_.stages)) return cell;
    return invalid_index;
  }

  const HullSites& sites_;
  const HullView& view_;
  std::vector<Index> simplex_;
  CellMemory<K> memory_;
  engine::CellStore<K> cells_;
  geometry::HullGeometry<K> geometry_;
  engine::Workspace work_;
  engine::Effort effort_;
};

template <int K>
std::unique_ptr<HullBoundary> make_hull_boundary(const HullSites& sites, const HullView& view, std::vector<Index> simplex) {
  return std::make_unique<HullBoundaryOfDimension<K>>(sites, view, std::move(simplex));
}

}  // namespace delone::front_ends
