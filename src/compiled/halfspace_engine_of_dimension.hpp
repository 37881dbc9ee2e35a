// SPDX-License-Identifier: BSD-3-Clause
// The implementation of HalfspaceEngine for one dimension: joins engine/ and geometry/.
#pragma once

#include "compiled/boundary_cells.hpp"
#include "compiled/halfspace_engine.hpp"
#include "engine/build.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace delone::internal {

template <int K>
class HalfspaceEngineOfDimension final : public HalfspaceEngine {
  using Geometry = geometry::HalfspaceGeometry<K>;
  using Query = typename Geometry::Query;

 public:
  HalfspaceEngineOfDimension(const DualSites& sites, const DualView& view, std::vector<Index> simplex)
      : HalfspaceEngineOfDimension(sites, view, std::move(simplex), nullptr) {
    std::vector<Index> vertices = vertices_of(simplex_);
    const Index last = vertices.back();
    vertices.pop_back();
    StageCounts uncounted;
    if (geometry().side(vertices.data(), geometry().row(last), uncounted) == Sign::negative)
      std::swap(vertices[0], vertices[1]);
    build_.seed(vertices, last);
  }

  bool insert(Index site) override { return build_.insert(site + 1) != invalid_index; }

  void insert_all(engine::Batch& batch) override { build_.insert_all(batch); }
  bool shares_batches_of(std::size_t num_vertices) const override {
    if constexpr (is_shared) return geometry().can_walk() && num_vertices > decltype(build_)::few_vertices;
    return false;
  }
  void insert_all([[maybe_unused]] const engine::ParallelBatch& batch) override {
    if constexpr (is_shared) build_.insert_all(batch);
  }
  void sort_cells([[maybe_unused]] std::span<const Index> places,
                  [[maybe_unused]] unsigned threads) override {
    if constexpr (is_shared) {
      const Index end = *std::max_element(places.begin(), places.end()) + 1;
      build_.sort_cells({end, true, places}, threads);
    }
  }
  void begin_batch() override { build_.begin_batch(); }
  void keep_batch() noexcept override { build_.keep_batch(); }
  void undo_batch() noexcept override { build_.undo_batch(); }

  void update_box() override {
    geometry().update_box();
    build_.create_functionals();
  }
  std::unique_ptr<HalfspaceEngine> copy(const DualSites& sites, const DualView& view) const override {
    return std::unique_ptr<HalfspaceEngine>(new HalfspaceEngineOfDimension(sites, view, simplex_, this));
  }

  SimplicialHull to_simplicial_hull() const override { return simplicial_hull_of(cells()); }

  std::vector<std::pair<Index, Index>> coplanar_neighbors(const SimplicialHull& hull) const override {
    std::vector<std::pair<Index, Index>> pairs;
    for (Index c = 0; c < hull.num_cells(); ++c) {
      const Index cell = hull.slots[c];
      for (int i = 0; i <= cells().dimension(); ++i) {
        const Index across = cells().neighbors(cell)[i];
        if (across < cell) continue;
        const Index opposite = cells().vertex(across, cells().slot_of_neighbor(across, cell));
        if (side(cell, opposite - 1) == Sign::zero)
          pairs.emplace_back(c, hull.neighbors_of(c)[static_cast<std::size_t>(i)]);
      }
    }
    return pairs;
  }

  Sign side(Index slot, Index site) const override {
    const Query q = geometry().query_at(site + 1);
    const auto h = geometry().evaluator(q);
    const double value = h.value(slot), threshold = h.threshold(slot);
    if (value > threshold) return Sign::positive;
    if (value < -threshold) return Sign::negative;
    return sign_at(slot, q);
  }

  std::optional<Index> cell_through(Index site) const override {
    StageCounts uncounted;
    const Query q = geometry().query_at(site + 1);
    if (view_.is_inside) {
      const auto [outcome, near] = engine::approach(cells(), geometry(), q, build_.last_cell());
      if (outcome == engine::Descent::hidden) return std::nullopt;
      const Index cell = engine::walk_exactly(cells(), geometry(), q, near.cell, false, uncounted).cell;
      if (sign_at(cell, q) != Sign::zero) return std::nullopt;
      return cell;
    }
    for (Index cell = 0; cell < cells().num_slots(); ++cell)
      if (!cells().is_vacant(cell) && sign_at(cell, q) == Sign::zero) return cell;
    return std::nullopt;
  }

  const engine::Effort& effort() const override { return build_.effort(); }
  std::size_t bytes() const override { return cells().bytes(); }

 private:
  /// No cells, or those of another engine.
  HalfspaceEngineOfDimension(const DualSites& sites, const DualView& view, std::vector<Index> simplex,
                             const HalfspaceEngineOfDimension* other)
      : view_(view),
        simplex_(std::move(simplex)),
        build_(sites.dimension() - 1, ids_for(sites.size()), sites, view, vertices_of(simplex_)) {
    geometry().update_box();
    if (other != nullptr) build_.copy_cells(other->build_);
  }

  /// Whether several threads may insert at once.
  static constexpr bool is_shared = K >= 2 && K <= 6;

  const Geometry& geometry() const { return build_.geometry(); }
  Geometry& geometry() { return build_.geometry(); }
  const engine::CellStore<K>& cells() const { return build_.cells(); }

  /// By exact stages alone.
  Sign sign_at(Index cell, const Query& q) const {
    StageCounts uncounted;
    const auto vertices = cells().vertices(cell);
    return geometry().side(vertices, q.point, uncounted);
  }

  const DualView& view_;
  std::vector<Index> simplex_;
  engine::Build<K, Geometry> build_;
};

template <int K>
std::unique_ptr<HalfspaceEngine> make_halfspace_engine(const DualSites& sites, const DualView& view,
                                                       std::vector<Index> simplex) {
  return std::make_unique<HalfspaceEngineOfDimension<K>>(sites, view, std::move(simplex));
}

}  // namespace delone::internal
