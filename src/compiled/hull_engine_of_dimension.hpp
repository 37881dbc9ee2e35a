// SPDX-License-Identifier: BSD-3-Clause
// The implementation of HullEngine for one dimension: joins engine/ and geometry/.
#pragma once

#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "compiled/boundary_cells.hpp"
#include "compiled/hull_engine.hpp"
#include "engine/build.hpp"
#include "geometry/hull_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace delone::internal {

template <int K>
class HullEngineOfDimension final : public HullEngine {
  using Geometry = geometry::HullGeometry<K>;
  using Query = typename Geometry::Query;

 public:
  HullEngineOfDimension(const HullSites& sites, const HullView& view, std::vector<Index> simplex)
      : HullEngineOfDimension(sites, view, std::move(simplex), nullptr) {
    std::vector<Index> vertices = vertices_of(simplex_);
    const Index last = vertices.back();
    vertices.pop_back();
    StageCounts uncounted;
    if (geometry().side(vertices.data(), geometry().point(last), uncounted) == Sign::negative)
      std::swap(vertices[0], vertices[1]);
    build_.seed(vertices, last);
  }

  Insertion insert(Index site) override {
    const Index v = site + 1;
    if (build_.insert(v) == v) return Insertion::vertex;
    return build_.workspace().is_strictly_hidden ? Insertion::interior : Insertion::hidden;
  }
  bool is_surely_interior(Index site) override { return build_.is_surely_hidden(site + 1); }
  void find_surely_interior(std::span<const Index> sites, std::span<char> is_interior,
                            unsigned threads) const override {
    constexpr std::size_t part = 1024;
    work_in_parts(threads, sites.size(), part, [&] {
      return
          [&, from = build_.last_cell()](std::size_t first, std::size_t last, const StopPoint& stop) mutable {
            for (std::size_t i = first; i < last; ++i) {
              stop();
              is_interior[i] = build_.is_surely_hidden(sites[i] + 1, from) ? 1 : 0;
            }
          };
    });
  }

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
    geometry().set_box(view_.low.data(), view_.high.data());
    build_.create_functionals();
  }
  std::unique_ptr<HullEngine> copy(const HullSites& sites, const HullView& view) const override {
    return std::unique_ptr<HullEngine>(new HullEngineOfDimension(sites, view, simplex_, this));
  }

  SimplicialHull to_simplicial_hull() const override { return simplicial_hull_of(cells()); }

  std::vector<std::pair<Index, Index>> coplanar_neighbors(const SimplicialHull& hull) const override {
    std::vector<std::pair<Index, Index>> pairs;
    StageCounts uncounted;
    const auto is_certainly_inside = [&](Index cell, Index vertex) {
      const auto q = geometry().make_query(geometry().point(vertex));
      const auto h = geometry().evaluator(q);
      return h.value(cell) > h.threshold(cell);
    };
    constexpr std::size_t ahead = 4;  // cells whose neighbors are on the way from memory
    for (Index c = 0; c < hull.num_cells(); ++c) {
      cancellation_point();
      const Index cell = hull.slots[c];
      if (c + ahead < hull.num_cells()) cells().prefetch_neighbors(hull.slots[c + ahead]);
      for (int i = 0; i <= cells().dimension(); ++i) {
        const Index across = cells().neighbors(cell)[i];
        if (across < cell) continue;
        const Index opposite = cells().vertex(across, cells().slot_of_neighbor(across, cell));
        // One cell is convex at the ridge iff the other is.
        if (is_certainly_inside(cell, opposite) || is_certainly_inside(across, cells().vertex(cell, i)))
          continue;
        const auto vertices = cells().vertices(cell);
        if (geometry().side(vertices, geometry().point(opposite), uncounted) == Sign::zero)
          pairs.emplace_back(c, hull.neighbors_of(c)[static_cast<std::size_t>(i)]);
      }
    }
    return pairs;
  }

  Sign certain_side(Index slot, const double* point) const override {
    const auto q = geometry().make_query(point);
    const auto h = geometry().evaluator(q);
    const double value = h.value(slot), threshold = h.threshold(slot) * reach(q);
    return value > threshold ? Sign::positive : value < -threshold ? Sign::negative : Sign::zero;
  }

  double hyperplane(Index slot, double* normal) const override { return geometry().hyperplane(slot, normal); }

  std::pair<Index, Sign> descend(const double* point, const std::vector<Index>& starts) const override {
    const auto q = geometry().make_query(point);
    const auto h = geometry().evaluator(q);
    const Index start = *std::min_element(starts.begin(), starts.end(),
                                          [&](Index a, Index b) { return h.value(a) < h.value(b); });
    const bool is_in_box = reach(q) <= 1;
    const auto [outcome, walk] = is_in_box ? engine::approach(cells(), geometry(), q, start)
                                           : engine::descend(cells(), geometry(), q, start);
    if (!is_in_box)
      return {walk.cell, certain_side(walk.cell, point) == Sign::negative ? Sign::negative : Sign::zero};
    return {walk.cell, outcome == engine::Descent::conflict ? Sign::negative
                       : outcome == engine::Descent::hidden ? Sign::positive
                                                            : Sign::zero};
  }

  const engine::Effort& effort() const override { return build_.effort(); }
  std::size_t bytes() const override { return cells().bytes(); }

 private:
  /// No cells, or those of another engine.
  HullEngineOfDimension(const HullSites& sites, const HullView& view, std::vector<Index> simplex,
                        const HullEngineOfDimension* other)
      : sites_(sites),
        view_(view),
        simplex_(std::move(simplex)),
        build_(static_cast<int>(sites.axes.size()) - 1, ids_for(sites.size()), sites.axes, sites.ambient,
               sites.coordinates, view.grid, view.center, view.is_inside, vertices_of(simplex_)) {
    geometry().set_box(view.low.data(), view.high.data());
    if (other != nullptr) build_.copy_cells(other->build_);
  }

  /// Whether several threads may insert at once.
  static constexpr bool is_shared = K >= 2 && K <= 6;

  const Geometry& geometry() const { return build_.geometry(); }
  Geometry& geometry() { return build_.geometry(); }
  const engine::CellStore<K>& cells() const { return build_.cells(); }

  /// Thresholds are for rows in [−1, 1]. Functionals are off by a linear function of the row, and evaluations
  /// round in proportion to it, so for a row outside the threshold grows by this factor.
  double reach(const Query& q) const {
    double largest = 1;
    for (std::size_t r = 0; r < sites_.axes.size(); ++r)
      if (const double x = std::fabs(q.row[r]); !(x <= largest)) largest = x;
    return largest > 1 ? largest * (1 + 0x1p-50) : 1;
  }

  const HullSites& sites_;
  const HullView& view_;
  std::vector<Index> simplex_;
  engine::Build<K, Geometry> build_;
};

template <int K>
std::unique_ptr<HullEngine> make_hull_engine(const HullSites& sites, const HullView& view,
                                             std::vector<Index> simplex) {
  return std::make_unique<HullEngineOfDimension<K>>(sites, view, std::move(simplex));
}

}  // namespace delone::internal
