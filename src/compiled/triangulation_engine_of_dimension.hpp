// SPDX-License-Identifier: BSD-3-Clause
// The implementation of Hull for one dimension: joins engine/ and geometry/.
#pragma once

#include "compiled/point_in_one_cell.hpp"
#include "compiled/queries.hpp"
#include "compiled/triangulation_engine.hpp"
#include "engine/build.hpp"
#include "engine/dimension_jump.hpp"
#include "engine/seed.hpp"
#include "engine/wrap/proof.hpp"
#include "engine/wrap/wrapping.hpp"
#include "geometry/delaunay_geometry.hpp"
#include "geometry/facet_search/facet_search.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

namespace delone {

template <int K>
class HullOfDimension final : public Hull {
  using Geometry = geometry::DelaunayGeometry<K>;
  using Query = typename Geometry::Query;

 public:
  HullOfDimension(const std::vector<int>& axes, const VertexPoints& points, const geometry::Frame& frame,
                  const engine::Effort& effort)
      : points_(points),
        memory_(static_cast<int>(axes.size()), ids_for(points.last_expected())),
        cells_(memory_),
        geometry_(memory_, axes, points.ambient, points.coordinates, points.grid, frame),
        effort_(effort) {}

  void seed(std::span<const Index> vertices) override {
    geometry_.set_rows(points_.last_vertex());
    std::vector<Index> oriented(vertices.begin(), vertices.end());
    if (geometry_.orientation(oriented.data()) == Sign::negative) std::swap(oriented[0], oriented[1]);
    engine::seed(cells_, geometry_, oriented);
    recount();
    effort_.created_cells += cells_.num_cells();
  }

  bool wrap([[maybe_unused]] const std::function<void()>& tick) override {
    if constexpr (K >= 2) {
      try {
        if (wrap_all(tick)) {
          last_ = 0;
          lacks_functionals_ = true;
          effort_.created_cells += cells_.num_cells();
          return true;
        }
      } catch (const std::bad_alloc&) {  // insertion will say so, or do with less
      } catch (...) {
        cells_.clear();
        throw;
      }
      cells_.clear();
    }
    return false;
  }

  void jump(const Complex& old, Index q) override {
    geometry_.set_rows(points_.last_vertex());
    const CellId finite = *old.finite_cells().begin();
    std::vector<Index> simplex;
    for (int i = 0; i <= old.affine_dimension(); ++i) simplex.push_back(index(old.vertex(finite, i)));
    simplex.push_back(q);
    engine::jump(old, cells_, geometry_, q, geometry_.orientation(simplex.data()) == Sign::positive);
    recount();
    effort_.created_cells += cells_.num_cells();
  }

  void restore(const Complex& old) override {
    geometry_.set_rows(points_.last_vertex());
    cells_.reserve(old.num_all_cells());
    cells_.admit_vertices(points_.last_vertex());
    std::vector<Index> id(old.num_cell_slots(), invalid_index);
    for (const CellId c : old.all_cells()) id[index(c)] = cells_.allocate();
    for (const CellId c : old.all_cells())
      for (int i = 0; i <= old.affine_dimension(); ++i) {
        cells_.set_vertex(id[index(c)], i, index(old.vertex(c, i)));
        cells_.neighbors(id[index(c)])[i] = id[index(old.neighbor(c, i))];
      }
    create_functionals();
    recount();
  }

  const geometry::Frame& frame() const override { return geometry_.frame(); }
  void set_frame(geometry::Frame frame) override {
    geometry_.set_frame(std::move(frame), points_.last_vertex());
    if (!lacks_functionals_) create_functionals();
  }

  Index insert(Index v, Index start) override {
    need_functionals();
    const Query q = geometry_.make_query(points_.point(v));
    if (start == invalid_index)
      start = work_.star().empty() ? last_ : engine::start_in_star(geometry_, q, work_.star());
    const Index at = engine::insert(cells_, geometry_, v, q, start, work_, effort_);
    if (at == v) {
      count_infinite();
      last_ = work_.star().back().created;
    } else {
      last_ = work_.last_cell;
    }
    return at;
  }
  std::span<const HorizonFacet> star() const override { return work_.star(); }
  void track_swallowed(bool wanted) override { work_.tracks_swallowed = wanted; }
  std::span<const Index> swallowed() const override { return work_.swallowed; }

  HullLocation locate(const double* query, Index start) const override {
    need_functionals();
    const kernel::Grid grid = points_.grid_with(query);
    Query q = geometry_.make_query(query, grid);
    q.compared = points_.ambient;
    return internal::locate(cells_, geometry_, q, start == invalid_index ? last_ : start);
  }

  std::vector<CellId> conflict_zone(const double* query, Index start) const override {
    need_functionals();
    const kernel::Grid grid = points_.grid_with(query);
    const Query q = geometry_.make_query(query, grid);
    return internal::conflict_zone(cells_, geometry_, q, start == invalid_index ? last_ : start);
  }

  Sign unperturbed_side(Index cell, const double* query) const override {
    const kernel::Grid grid = points_.grid_with(query);
    const auto vertices = cells_.vertices(cell);
    return geometry_.unperturbed_side(vertices, geometry_.make_query(query, grid));
  }

  Complex complex(Index num_vertices, std::span<const CellId> cell_of_vertex) const override {
    return {cells_.links_of_complex(),
            cells_.dimension(),
            cells_.num_slots(),
            cells_.num_cells() - num_infinite_,
            num_infinite_,
            num_vertices,
            cell_of_vertex.data(),
            static_cast<Index>(cell_of_vertex.size())};
  }
  const engine::Effort& effort() const override { return effort_; }
  std::size_t bytes() const override {
    const std::lock_guard lock(creating_functionals_);
    return cells_.bytes();
  }

 private:
  /// Cells that are wrapped get their functionals when these are asked for. Throws Errc::out_of_memory, and
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
    geometry_.keep_rows(points_.last_vertex());
    memory_.reserve(cells_.num_slots());
    memory_.prepare(cells_.num_slots());
    std::array<Index, 64> batch;
    std::array<const Index*, batch.size()> vertices;
    std::array<Sign, batch.size()> orientations;
    std::size_t count = 0;
    for (Index cell = 0; cell < cells_.num_slots(); ++cell) {
      const Index* const v = cells_.wide_vertices(cell);
      if (const int infinite_slot = cells_.infinite_slot(cell); infinite_slot >= 0) {
        geometry_.create(cell, v, infinite_slot, infinite_slot == 0 ? 1 : 0);
      } else {
        batch[count] = cell;
        vertices[count++] = v;
      }
      if (count < batch.size() && cell + 1 < cells_.num_slots()) continue;
      geometry_.create({batch.data(), count}, {vertices.data(), count}, orientations.data());
      count = 0;
    }
  }

  void create_functionals() {
    for (Index cell = 0; cell < cells_.num_slots(); ++cell) {
      if (cells_.is_vacant(cell)) continue;
      const int infinite_slot = cells_.infinite_slot(cell);
      const auto vertices = cells_.vertices(cell);
      geometry_.create(cell, vertices, infinite_slot, infinite_slot == 0 ? 1 : 0);
    }
  }

  bool wrap_all(const std::function<void()>& tick) {
    using Proof = engine::Proof<K, Geometry>;
    const Index last = points_.last_vertex();
    geometry_.keep_rows(last);
    cells_.widen_vertices();
    {
      geometry::FacetSearch search(K, geometry_.kept_rows(), last,
                                   [this](const Index* cell, int slot, std::span<const Index> vertices) {
                                     return geometry_.first_beyond(cell, slot, vertices, points_.grid);
                                   });
      if (!engine::Wrapping<K, geometry::FacetSearch>(cells_, search, last).run(tick)) return false;
    }
    const auto point = find_point_in_one_cell(cells_, geometry_, points_);
    if (!point) return false;
    CellMemory<K> some_cells(K);
    some_cells.reserve(Proof::batch_size);
    Geometry geometry_of_some(some_cells, geometry_.axes(), points_.ambient, points_.coordinates,
                              points_.grid, geometry_.frame());
    geometry_of_some.keep_rows(last);
    std::vector<Query> queries;
    queries.reserve(last + 1);
    for (Index v = 0; v <= last; ++v) queries.push_back(geometry_of_some.make_query(points_.point(v)));
    Proof proof(cells_, geometry_of_some, queries, effort_.stages);
    const kernel::Grid grid = points_.grid_with(point->data());
    if (!proof.run(geometry_of_some.make_query(point->data(), grid), tick)) return false;
    num_infinite_ = proof.num_infinite();
    return true;
  }

  /// After an insertion.
  void count_infinite() {
    if (work_.zone.num_infinite == 0) return;  // then the infinite vertex is on no facet of the zone
    num_infinite_ -= static_cast<Index>(work_.zone.num_infinite);
    for (const HorizonFacet& facet : work_.star())
      num_infinite_ += geometry_.is_infinite(facet.created) ? 1 : 0;
  }

  void recount() {
    num_infinite_ = 0;
    for (Index cell = 0; cell < cells_.num_slots(); ++cell)
      if (!cells_.is_vacant(cell) && geometry_.is_infinite(cell)) ++num_infinite_;
    last_ = 0;
  }

  const VertexPoints& points_;
  mutable CellMemory<K> memory_;  // mutable for need_functionals() alone
  engine::CellStore<K> cells_;
  mutable Geometry geometry_;
  engine::Workspace work_;
  engine::Effort effort_;
  Index num_infinite_ = 0;
  Index last_ = 0;  // a cell of the last insertion
  mutable std::atomic<bool> lacks_functionals_ = false;
  mutable std::mutex creating_functionals_;
};

template <int K>
std::unique_ptr<Hull> make_hull(const std::vector<int>& axes, const VertexPoints& points,
                                const geometry::Frame& frame, const engine::Effort& effort) {
  return std::make_unique<HullOfDimension<K>>(axes, points, frame, effort);
}

}  // namespace delone
