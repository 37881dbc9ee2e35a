// SPDX-License-Identifier: BSD-3-Clause
// The implementation of TriangulationEngine for one dimension: joins engine/ and geometry/.
#pragma once

#include "compiled/points_to_wrap.hpp"
#include "compiled/queries.hpp"
#include "compiled/triangulation_engine.hpp"
#include "engine/build.hpp"
#include "engine/hole/settling.hpp"
#include "geometry/delaunay_geometry.hpp"

#include <delone/error.hpp>

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <utility>
#include <vector>

namespace delone {

template <int K>
class TriangulationEngineOfDimension final : public TriangulationEngine {
  using Geometry = geometry::DelaunayGeometry<K>;
  using Query = typename Geometry::Query;

 public:
  TriangulationEngineOfDimension(const std::vector<int>& axes, const VertexPoints& points,
                                 const geometry::Frame& frame, const engine::Effort& effort)
      : points_(points),
        build_(static_cast<int>(axes.size()), ids_for(points.last_expected()), axes, points.ambient,
               points.coordinates, points.grid, frame) {
    build_.effort() = effort;
  }

  void seed(std::span<const Index> vertices) override {
    geometry().set_rows(points_.last_vertex());
    std::vector<Index> oriented(vertices.begin(), vertices.end());
    if (geometry().orientation(oriented.data()) == Sign::negative) std::swap(oriented[0], oriented[1]);
    build_.seed(oriented);
  }
  bool is_worth_wrapping(std::size_t num_points) const override {
    return points_.form == kernel::RowForm::point && K == points_.ambient &&
           engine::is_worth_wrapping(K, num_points);
  }
  bool wrap([[maybe_unused]] unsigned threads,
            [[maybe_unused]] const std::function<void(double)>& tick) override {
    if constexpr (K >= 2)
      if (build_.wrap(PointsToWrap<K>(points_, cells(), geometry()), threads, tick))
        lacks_functionals_ = true;
    return lacks_functionals_;
  }
  void jump(const Complex& old, Index q) override {
    geometry().set_rows(points_.last_vertex());
    const CellId finite = *old.finite_cells().begin();
    std::vector<Index> simplex;
    for (int i = 0; i <= old.affine_dimension(); ++i) simplex.push_back(index(old.vertex(finite, i)));
    simplex.push_back(q);
    build_.jump(old, q, geometry().orientation(simplex.data()) == Sign::positive);
  }
  void restore(const Complex& old) override {
    geometry().set_rows(points_.last_vertex());
    build_.restore(old);
  }

  std::unique_ptr<TriangulationEngine> copy(const VertexPoints& points) const override {
    const std::lock_guard lock(creating_functionals_);
    auto result =
        std::make_unique<TriangulationEngineOfDimension>(geometry().axes(), points, frame(), effort());
    result->geometry().set_rows(points.last_vertex());
    result->build_.copy_cells(build_);
    result->lacks_functionals_ = lacks_functionals_.load();
    return result;
  }

  const geometry::Frame& frame() const override { return geometry().frame(); }
  void set_frame(geometry::Frame frame) override {
    geometry().set_frame(std::move(frame), points_.last_vertex());
    if (!lacks_functionals_) build_.create_functionals();
  }

  Index insert(Index v, Index start) override {
    need_functionals();
    return build_.insert(v, start);
  }
  void insert_all(engine::Batch& batch) override {
    need_functionals();
    build_.insert_all(batch);
  }
  engine::Removal remove(Index v, Index cell) override {
    need_functionals();
    return build_.remove(v, cell, edits().filler);
  }
  bool settle(Index v, Index cell) override {
    need_functionals();
    geometry().rewrite_row(v);
    return edits().settling.settle(v, cell);
  }
  bool settle_all(std::optional<geometry::Frame> frame, unsigned threads) override {
    need_functionals();
    auto& settling = edits().settling;
    if (frame)
      geometry().set_frame(std::move(*frame), points_.last_vertex());
    else
      geometry().rewrite_rows(points_.last_vertex());
    return settling.settle_all(threads, [this] { return query_inside(); });
  }
  std::span<const Index> made_by_settling() const override { return edits_->settling.created(); }
  std::span<const Index> changed_by_settling() const override { return edits_->settling.changed(); }
  void rewrite_row(Index v) noexcept override { geometry().rewrite_row(v); }
  void renew(Index v, Index cell) noexcept override {
    geometry().rewrite_row(v);
    if (edits_) edits_->settling.renew(v, cell);  // else nothing has been computed
  }
  void renew_all() noexcept override {
    geometry().rewrite_rows(points_.last_vertex());
    build_.create_functionals();
  }
  bool shares_batches_of(std::size_t num_vertices) const override {
    if constexpr (is_shared)
      return points_.form != kernel::RowForm::furthest_point && num_vertices > decltype(build_)::few_vertices;
    return false;
  }
  void insert_all([[maybe_unused]] const engine::ParallelBatch& batch) override {
    if constexpr (is_shared) {
      need_functionals();
      build_.insert_all(batch);
    }
  }
  void renumber_vertices(std::span<const Index> new_ids) override {
    geometry().prepare_rows(points_.last_vertex());
    build_.renumber_vertices(new_ids);
    geometry().set_rows(points_.last_vertex());
  }
  void sort_cells([[maybe_unused]] unsigned threads) override {
    if constexpr (is_shared) build_.sort_cells({points_.last_vertex() + 1, points_.weighted()}, threads);
  }
  void begin_batch(bool is_small) override {
    need_functionals();
    build_.begin_batch(is_small);
  }
  void changed_cells(std::vector<CellId>& gone, std::vector<CellId>& come) const override {
    build_.changed_cells(gone, come);
  }
  void keep_batch() noexcept override { build_.keep_batch(); }
  void undo_batch(const std::function<void(Index)>& put_back) noexcept override {
    build_.undo_batch(put_back);
  }

  std::span<const HorizonFacet> star() const override { return build_.star(); }
  std::span<const Index> replaced() const override {
    const engine::ConflictZone& zone = build_.workspace().zone;
    return {zone.cells.data(), zone.num_cells};
  }
  std::span<const Index> made_by_removal() const override { return edits_->filler.created(); }
  void track_swallowed(bool wanted) override { build_.workspace().tracks_swallowed = wanted; }
  std::span<const Index> swallowed() const override { return build_.workspace().swallowed; }

  QueryLocation locate(const double* query, Index start) const override {
    need_functionals();
    const kernel::Grid grid = points_.grid_with(query);
    Query q = geometry().make_query(query, grid);
    q.compared = points_.ambient;
    return internal::locate(cells(), geometry(), q, start == invalid_index ? build_.last_cell() : start);
  }

  std::vector<CellId> conflict_zone(const double* query, Index start) const override {
    need_functionals();
    const kernel::Grid grid = points_.grid_with(query);
    const Query q = geometry().make_query(query, grid);
    return internal::conflict_zone(cells(), geometry(), q,
                                   start == invalid_index ? build_.last_cell() : start);
  }

  Sign unperturbed_side(Index cell, const double* query) const override {
    const kernel::Grid grid = points_.grid_with(query);
    const auto vertices = cells().vertices(cell);
    return geometry().unperturbed_side(vertices, geometry().make_query(query, grid));
  }

  Complex complex(Index num_vertices, std::span<const CellId> cell_of_vertex) const override {
    return {cells().links_of_complex(), cells().dimension(),
            cells().num_slots(),        cells().num_cells() - build_.num_infinite(),
            build_.num_infinite(),      num_vertices,
            cell_of_vertex.data(),      static_cast<Index>(cell_of_vertex.size())};
  }
  const engine::Effort& effort() const override { return build_.effort(); }
  std::size_t bytes() const override {
    const std::lock_guard lock(creating_functionals_);
    return cells().bytes();
  }

 private:
  const Geometry& geometry() const { return build_.geometry(); }
  Geometry& geometry() { return build_.geometry(); }
  const engine::CellStore<K>& cells() const { return build_.cells(); }

  /// Makes the functionals of wrapped cells when they are first needed. Throws Errc::out_of_memory, and
  /// then changes nothing.
  void need_functionals() const {
    if (!lacks_functionals_.load(std::memory_order_acquire)) [[likely]]
      return;
    const std::lock_guard lock(creating_functionals_);
    if (!lacks_functionals_.load(std::memory_order_relaxed)) return;
    try {
      create_functionals_of_wrapped();
    } catch (const std::bad_alloc&) {
      throw Error(Errc::out_of_memory, "not enough memory for what queries and insertions need");
    }
    lacks_functionals_.store(false, std::memory_order_release);
  }

  /// Many at a time. REQUIRES that all slots are cells.
  void create_functionals_of_wrapped() const {
    Geometry& geometry = build_.geometry();
    const engine::CellStore<K>& cells = build_.cells();
    geometry.keep_rows(points_.last_vertex());
    build_.prepare_functionals();
    std::array<Index, 64> batch;
    std::array<const Index*, batch.size()> vertices;
    std::array<Sign, batch.size()> orientations;
    std::size_t count = 0;
    for (Index cell = 0; cell < cells.num_slots(); ++cell) {
      const Index* const v = cells.wide_vertices(cell);
      if (const int infinite_slot = cells.infinite_slot(cell); infinite_slot >= 0) {
        geometry.create(cell, v, infinite_slot, infinite_slot == 0 ? 1 : 0);
      } else {
        batch[count] = cell;
        vertices[count++] = v;
      }
      if (count < batch.size() && cell + 1 < cells.num_slots()) continue;
      geometry.create({batch.data(), count}, {vertices.data(), count}, orientations.data());
      count = 0;
    }
  }

  /// What edits keep from one to the next.
  struct Edits {
    explicit Edits(engine::Build<K, Geometry>& build)
        : filler(build.cells(), build.geometry()), settling(build, filler) {}
    engine::HoleFiller<K, Geometry> filler;
    engine::Settling<K, Geometry> settling;
  };
  Edits& edits() {
    if (!edits_) edits_ = std::make_unique<Edits>(build_);
    return *edits_;
  }
  /// A query at a point in the interior of a finite cell, as heavy as the frame allows. Valid until the next.
  std::optional<Query> query_inside() {
    inside_.assign(static_cast<std::size_t>(points_.ambient) + 1, 0.0);
    if (points_.weighted()) inside_.back() = frame().high().back();
    for (Index cell = 0, tries = 0; cell < cells().num_slots() && tries < 64; ++cell) {
      if (cells().is_vacant(cell) || cells().infinite_slot(cell) >= 0) continue;
      ++tries;
      const int k = cells().dimension();
      for (std::size_t j = 0; j < static_cast<std::size_t>(points_.ambient); ++j) {
        inside_[j] = 0;
        for (int i = 0; i <= k; ++i) inside_[j] += points_.point(cells().vertex(cell, i))[j] / (k + 1);
      }
      if (!frame().contains(inside_.data())) continue;
      grid_inside_ = points_.grid_with(inside_.data());
      const Query q = geometry().make_query(inside_.data(), grid_inside_);
      const auto vertices = cells().vertices(cell);
      bool is_inside = true;
      for (int i = 0; i <= k && is_inside; ++i)
        is_inside = geometry().side_of_facet(vertices, i, q) == Sign::positive;
      if (is_inside) return q;
    }
    return std::nullopt;
  }

  /// Whether several threads may insert at once.
  static constexpr bool is_shared = K >= 2 && K <= 6;

  const VertexPoints& points_;
  std::unique_ptr<Edits> edits_;  // from the first edit on
  std::vector<double> inside_;    // the point of query_inside()
  kernel::Grid grid_inside_ = points_.grid;
  mutable engine::Build<K, Geometry> build_;  // mutable for need_functionals() alone
  mutable std::atomic<bool> lacks_functionals_ = false;
  mutable std::mutex creating_functionals_;
};

template <int K>
std::unique_ptr<TriangulationEngine> make_triangulation_engine(const std::vector<int>& axes,
                                                               const VertexPoints& points,
                                                               const geometry::Frame& frame,
                                                               const engine::Effort& effort) {
  return std::make_unique<TriangulationEngineOfDimension<K>>(axes, points, frame, effort);
}

}  // namespace delone
