// SPDX-License-Identifier: BSD-3-Clause
// The implementation of HalfspaceBoundary for one dimension: joins engine/ and geometry/.
#pragma once

#include "compiled/boundary_cells.hpp"
#include "compiled/halfspace_engine.hpp"
#include "engine/build.hpp"
#include "engine/seed.hpp"

#include <utility>

namespace delone::internal {

template <int K>
class HalfspaceBoundaryOfDimension final : public HalfspaceBoundary {
  using Query = typename geometry::HalfspaceGeometry<K>::Query;

 public:
  HalfspaceBoundaryOfDimension(const DualSites& sites, const DualView& view, std::vector<Index> simplex)
      : HalfspaceBoundaryOfDimension(sites, view, std::move(simplex), nullptr) {
    std::vector<Index> vertices = vertices_of(simplex_);
    const Index last = vertices.back();
    vertices.pop_back();
    StageCounts uncounted;
    if (geometry_.side(vertices.data(), geometry_.row(last), uncounted) == Sign::negative)
      std::swap(vertices[0], vertices[1]);
    engine::seed(cells_, geometry_, vertices, last);
    effort_.created_cells = cells_.num_cells();
  }

  bool insert(Index site) override {
    const Index v = site + 1;
    const Query q = geometry_.make_query(v);
    if (view_.is_inside) {
      if (engine::insert(cells_, geometry_, v, q, work_.last_cell, work_, effort_) == invalid_index)
        return false;
    } else {
      const Index cell = find_conflict(cells_, geometry_, q, effort_.stages);
      if (cell == invalid_index) return false;
      engine::insert_in_conflict(cells_, geometry_, v, q, cell, work_, effort_);
    }
    work_.last_cell = work_.star().back().created;
    return true;
  }

  void update_box() override {
    geometry_.update_box();
    create_functionals(cells_, geometry_);
  }

  std::unique_ptr<HalfspaceBoundary> copy(const DualSites& sites, const DualView& view) const override {
    return std::unique_ptr<HalfspaceBoundary>(new HalfspaceBoundaryOfDimension(sites, view, simplex_, this));
  }

  SimplicialHull to_simplicial_hull() const override { return simplicial_hull_of(cells_); }

  std::vector<std::pair<Index, Index>> coplanar_neighbors(const SimplicialHull& hull) const override {
    std::vector<std::pair<Index, Index>> pairs;
    for (Index c = 0; c < hull.num_cells(); ++c) {
      const Index cell = hull.slots[c];
      for (int i = 0; i <= cells_.dimension(); ++i) {
        const Index across = cells_.neighbors(cell)[i];
        if (across < cell) continue;
        const Index opposite = cells_.vertex(across, cells_.slot_of_neighbor(across, cell));
        if (side(cell, opposite - 1) == Sign::zero)
          pairs.emplace_back(c, hull.neighbors_of(c)[static_cast<std::size_t>(i)]);
      }
    }
    return pairs;
  }

  Sign side(Index slot, Index site) const override {
    const Query q = geometry_.make_query(site + 1);
    const auto h = geometry_.evaluator(q);
    const double value = h.value(slot), threshold = h.threshold(slot);
    if (value > threshold) return Sign::positive;
    if (value < -threshold) return Sign::negative;
    return sign_at(slot, q);
  }

  std::optional<Index> cell_through(Index site) const override {
    StageCounts uncounted;
    const Query q = geometry_.make_query(site + 1);
    if (view_.is_inside) {
      const auto [outcome, near] = engine::descend(cells_, geometry_, q, work_.last_cell);
      if (outcome == engine::Descent::hidden) return std::nullopt;
      const Index cell = engine::walk_exactly(cells_, geometry_, q, near.cell, false, uncounted).cell;
      if (sign_at(cell, q) != Sign::zero) return std::nullopt;
      return cell;
    }
    for (Index cell = 0; cell < cells_.num_slots(); ++cell)
      if (!cells_.is_vacant(cell) && sign_at(cell, q) == Sign::zero) return cell;
    return std::nullopt;
  }

  const engine::Effort& effort() const override { return effort_; }
  std::size_t bytes() const override { return cells_.bytes(); }

 private:
  /// An empty boundary, or a copy.
  HalfspaceBoundaryOfDimension(const DualSites& sites, const DualView& view, std::vector<Index> simplex,
                               const HalfspaceBoundaryOfDimension* other)
      : view_(view),
        simplex_(std::move(simplex)),
        memory_(sites.dimension() - 1, ids_for(sites.size())),
        cells_(memory_),
        geometry_(memory_, sites, view, vertices_of(simplex_)) {
    geometry_.update_box();
    if (other == nullptr) return;
    memory_.copy(other->memory_, other->cells_.num_slots());
    cells_.copy_slots(other->cells_);
    work_.last_cell = other->work_.last_cell;
    effort_ = other->effort_;
  }

  /// By exact stages alone.
  Sign sign_at(Index cell, const Query& q) const {
    StageCounts uncounted;
    const auto vertices = cells_.vertices(cell);
    return geometry_.side(vertices, q.point, uncounted);
  }

  const DualView& view_;
  std::vector<Index> simplex_;
  CellMemory<K> memory_;
  engine::CellStore<K> cells_;
  geometry::HalfspaceGeometry<K> geometry_;
  engine::Workspace work_;
  engine::Effort effort_;
};

template <int K>
std::unique_ptr<HalfspaceBoundary> make_halfspace_boundary(const DualSites& sites, const DualView& view,
                                                           std::vector<Index> simplex) {
  return std::make_unique<HalfspaceBoundaryOfDimension<K>>(sites, view, std::move(simplex));
}

}  // namespace delone::internal
