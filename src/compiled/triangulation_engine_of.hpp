// SPDX-License-Identifier: BSD-3-Clause
// The implementation of TriangulationEngine for one dimension: joins engine/ and geometry/.
#pragma once

#include "compiled/engine_of.hpp"
#include "compiled/points_to_wrap.hpp"
#include "compiled/triangulation_engine.hpp"
#include "engine/hole/moved_cells.hpp"
#include "engine/hole/polygon_filler.hpp"
#include "engine/hole/relocation.hpp"
#include "engine/wrap/is_worth_wrapping.hpp"
#include "engine/wrap/wrap.hpp"
#include "geometry/delaunay_geometry.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace delone::compiled {

template <int K>
class TriangulationEngineOf final : public EngineOf<TriangulationEngine, geometry::DelaunayGeometry<K>, K> {
  using Geometry = geometry::DelaunayGeometry<K>;
  using Query = typename Geometry::Query;
  using Base = EngineOf<TriangulationEngine, Geometry, K>;
  using Base::build_, Base::gone;

 public:
  using Base::cells, Base::geometry;

  TriangulationEngineOf(const std::vector<int>& axes, VertexPoints& points, const geometry::Frame& frame,
                        const engine::Effort& effort)
      : Base(static_cast<int>(axes.size()), cells::ids_for(points.last_expected()), axes, points.ambient,
             points.coordinates, points.grid, frame),
        points_(points) {
    build_.effort() = effort;
  }

  const VertexPoints& points() const { return points_; }
  Index num_infinite() const { return build_.num_infinite(); }
  Index first_cell() const { return build_.last_cell(); }
  std::size_t bytes() const {
    const std::lock_guard lock(creating_functionals_);
    return cells().bytes();
  }
  bool is_worth_wrapping(std::size_t num_points) const {
    return engine::can_wrap(K) && K == points_.ambient && points_.form == kernel::RowForm::point &&
           engine::is_worth_wrapping(K, num_points);
  }
  /// Makes functionals when they are first needed: of wrapped cells, and after many vertices have moved back.
  /// Throws Errc::out_of_memory, and then changes nothing.
  void need_functionals() const {
    if (functionals_.load(std::memory_order_acquire) == Functionals::ready) [[likely]]
      return;
    const std::lock_guard lock(creating_functionals_);
    const Functionals now = functionals_.load(std::memory_order_relaxed);
    if (now == Functionals::ready) return;
    if (now == Functionals::outdated) {
      build_.geometry().rewrite_rows(points_.last_vertex());
      engine::renew_all_functionals(build_.cells(), build_.geometry());
    } else if constexpr (engine::can_wrap(K)) {
      try {
        create_functionals_of_wrapped();
      } catch (const std::bad_alloc&) {
        throw Error(Errc::out_of_memory, "not enough memory for what queries and insertions need");
      }
    }
    functionals_.store(Functionals::ready, std::memory_order_release);
  }

  void seed(std::span<const Index> vertices) override {
    geometry().set_rows(*std::max_element(vertices.begin(), vertices.end()));
    std::vector<Index> oriented(vertices.begin(), vertices.end());
    if (geometry().orientation(oriented.data()) == Sign::negative) std::swap(oriented[0], oriented[1]);
    build_.seed(oriented);
  }
  void jump(const Complex& old, Index apex) override {
    geometry().set_rows(std::min(std::max(old.num_vertex_slots() - 1, apex), points_.last_vertex()));
    const CellId finite = *old.finite_cells().begin();
    std::vector<Index> simplex;
    for (int i = 0; i <= old.affine_dimension(); ++i) simplex.push_back(index(old.vertex(finite, i)));
    simplex.push_back(apex);
    build_.jump(old, apex, geometry().orientation(simplex.data()) == Sign::positive);
  }
  void restore(const Complex& old) override {
    geometry().set_rows(points_.last_vertex());
    build_.restore(old);
  }
  bool wrap([[maybe_unused]] unsigned threads,
            [[maybe_unused]] const std::function<void(double)>& tick) override {
    if constexpr (engine::can_wrap(K)) {
      const bool is_wrapped =
          engine::wrap(build_, PointsToWrap<K>(points_, cells(), geometry()), threads, tick);
      if (is_wrapped) functionals_ = Functionals::lacking;
      return is_wrapped;
    }
    return false;
  }

  std::unique_ptr<TriangulationEngine> copy(VertexPoints& points) const override {
    const std::lock_guard lock(creating_functionals_);
    auto result = std::make_unique<TriangulationEngineOf>(geometry().axes(), points, geometry().frame(),
                                                          build_.effort());
    result->geometry().set_rows(points.last_vertex());
    result->build_.copy_cells(build_);
    result->functionals_ = functionals_.load();
    return result;
  }

  void set_frame(geometry::Frame frame) override {
    geometry().set_frame(std::move(frame), points_.last_vertex());
    if (functionals_ == Functionals::lacking) return;
    engine::renew_all_functionals(build_.cells(), build_.geometry());
    functionals_ = Functionals::ready;
  }

  engine::Change insert(Index v, Index start) override {
    need_functionals();
    engine::Workspace& work = build_.workspace();
    work.tracks_swallowed = points_.form != kernel::RowForm::point;
    const engine::Change change = Base::insert(v, start);
    work.tracks_swallowed = false;
    return change;
  }
  void insert_all(const engine::Batch& batch) override {
    need_functionals();
    build_.workspace().tracks_swallowed = false;  // also after an insertion that has failed
    Base::insert_all(batch);
  }
  engine::Change remove(Index v, Index cell) override {
    need_functionals();
    if constexpr (K == 2)
      if (const std::optional<engine::Outcome> outcome = edits().polygons.remove(build_, v, cell)) {
        if (*outcome != engine::Outcome::done) return {*outcome};
        return {*outcome, invalid_index, gone(), edits().polygons.created()};
      }
    const engine::Outcome outcome = engine::remove(build_, v, cell, edits().filler);
    if (outcome != engine::Outcome::done) return {outcome};
    return {outcome, invalid_index, gone(), edits().filler.created()};
  }
  engine::Change move(Index v, Index cell, const double* to) override {
    need_functionals();
    auto& relocation = edits().relocation;
    const double* const from = points_.point(v);
    before_.assign(from, from + points_.row_size());
    const auto take_back = [&]() noexcept {
      points_.set_point(v, before_.data());
      geometry().rewrite_row(v);
      relocation.take_back();
    };
    points_.set_point(v, to);
    geometry().rewrite_row(v);
    try {
      const engine::Change change = relocation.relocate(v, cell);
      if (change.is_done())
        note_renewed(change.removed_cells);
      else
        take_back();
      return change;
    } catch (...) {
      take_back();
      throw;
    }
  }
  engine::Change move_all(std::optional<geometry::Frame> frame, unsigned threads,
                          const std::function<void(std::span<const Index>)>& put_back) override {
    need_functionals();
    auto& relocation = edits().relocation;
    renews_all_ = true;
    if (frame)
      geometry().set_frame(std::move(*frame), points_.last_vertex());
    else
      geometry().rewrite_rows(points_.last_vertex());
    return relocation.relocate_all(
        threads, [this] { return query_inside(); },
        [&](std::span<const Index> vertices) {
          put_back(vertices);
          move_back(vertices);
        });
  }
  void move_back(std::span<const Index> vertices) noexcept override {
    for (const Index v : vertices) geometry().rewrite_row(v);
  }
  void renumber_vertices(std::span<const Index> new_ids) override {
    geometry().prepare_rows(points_.last_vertex());
    build_.renumber_vertices(new_ids);
    geometry().set_rows(points_.last_vertex());
  }
  void begin_batch(bool is_small) override {
    need_functionals();
    Base::begin_batch(is_small);
    renewed_.clear();
    renews_all_ = false;
  }
  void undo_batch(const std::function<void(Index)>& put_back) noexcept override {
    Base::undo_batch(put_back);
    if (renews_all_) functionals_ = Functionals::outdated;
    if (functionals_ != Functionals::ready) return;
    for (const Index cell : renewed_)
      if (cell < cells().num_slots() && !cells().is_vacant(cell))
        engine::create_functional(build_.cells(), geometry(), cell);
  }

 private:
  /// Of the cells of a vertex that has moved. What undoing has to compute.
  void note_renewed(std::span<const Index> renewed) noexcept {
    if (!build_.log().is_on()) return;
    try {
      renewed_.insert(renewed_.end(), renewed.begin(), renewed.end());
    } catch (const std::bad_alloc&) {
      renews_all_ = true;
    }
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
        : filler(build.cells(), build.geometry()), relocation(build, filler) {}
    engine::HoleFiller<K, Geometry> filler;
    engine::Relocation<K, Geometry> relocation;
    struct None {};
    [[no_unique_address]] std::conditional_t<K == 2, engine::PolygonFiller<Geometry>, None> polygons;
  };
  Edits& edits() {
    if (!edits_) edits_ = std::make_unique<Edits>(build_);
    return *edits_;
  }
  /// A query at a point in the interior of a finite cell, as heavy as the frame allows. Valid until the next.
  std::optional<Query> query_inside() {
    inside_.assign(static_cast<std::size_t>(points_.ambient) + 1, 0.0);
    if (points_.weighted()) inside_.back() = geometry().frame().high().back();
    for (Index cell = 0, tries = 0; cell < cells().num_slots() && tries < 64; ++cell) {
      if (cells().is_vacant(cell) || cells().infinite_slot(cell) >= 0) continue;
      ++tries;
      const int k = cells().dimension();
      for (std::size_t j = 0; j < static_cast<std::size_t>(points_.ambient); ++j) {
        inside_[j] = 0;
        for (int i = 0; i <= k; ++i) inside_[j] += points_.point(cells().vertex(cell, i))[j] / (k + 1);
      }
      if (!geometry().frame().contains(inside_.data())) continue;
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

  VertexPoints& points_;
  std::unique_ptr<Edits> edits_;  // from the first edit on
  std::vector<double> before_;    // the point of a vertex that moves
  std::vector<Index> renewed_;    // cells that a move in place has left, since the beginning of the batch …
  bool renews_all_ = false;       // … or all
  std::vector<double> inside_;    // the point of query_inside()
  kernel::Grid grid_inside_ = points_.grid;
  /// Of cells: computed, not yet computed, or of other points.
  enum class Functionals : std::uint8_t { ready, lacking, outdated };
  mutable std::atomic<Functionals> functionals_ = Functionals::ready;
  mutable std::mutex creating_functionals_;
};

// Defined and compiled in a file for each K (triangulation_engine_instance.cpp.in):

/// For axes.size() = K, or any if K is 0.
template <int K>
std::unique_ptr<TriangulationEngine> make_triangulation_engine_of(const std::vector<int>& axes,
                                                                  VertexPoints& points,
                                                                  const geometry::Frame& frame,
                                                                  const engine::Effort& effort);
template <int K>
QueryLocation locate(const TriangulationEngineOf<K>& engine, const double* query, Index start);
template <int K>
std::vector<CellId> conflict_zone(const TriangulationEngineOf<K>& engine, const double* query, Index start);
template <int K>
Sign unperturbed_side(const TriangulationEngineOf<K>& engine, Index cell, const double* query);

}  // namespace delone::compiled
