// SPDX-License-Identifier: BSD-3-Clause
// Inserts a batch of points as the library does, and tells an observer when an insertion passes from one
// phase to the next; or lets several workers insert it by a given schedule. The engine is unchanged. The
// observer sits in the batch, and in the geometry: the engine gets an evaluator from it when a walk or the
// search of a conflict zone begins, and memory and functionals when a star is made.
#pragma once

#include "compiled/triangulation_engine.hpp"
#include "engine/build.hpp"
#include "geometry/delaunay_geometry.hpp"
#include "kernel/predicates.hpp"
#include "order/insertion_order.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace benchmarks {

using delone::Index;

/// The events of an insertion, in this order; those of creation come once per block. This base class ignores
/// them.
struct Observer {
  /// An insertion: the walk follows, for which so many evaluators are made before that of the search.
  void begins(int /*evaluators*/) {}
  void evaluates() {
  }  ///< an evaluator is made: for the walk, then for the search of the conflict zone, then for tests
  void reserves() {}  ///< the conflict zone is complete; slots, vertices, mirrors and keys of ridges follow
  void creates() {}   ///< functionals follow
  void created() {
  }  ///< the functionals of a block, or one more by elimination; the next block or gluing follows
  void ends(const delone::engine::Workspace& /*work*/) {}
};

template <int K, class Observer>
class ObservedGeometry : public delone::geometry::DelaunayGeometry<K> {
  using Base = delone::geometry::DelaunayGeometry<K>;

 public:
  using Query = typename Base::Query;

  template <class... Arguments>
  ObservedGeometry(delone::cells::CellMemory<K>& memory, Observer& observer, Arguments&&... arguments)
      : Base(memory, std::forward<Arguments>(arguments)...), observer_(observer) {}
  ObservedGeometry(const ObservedGeometry& shared, typename Base::ForThread form)
      : Base(shared, form), observer_(shared.observer_) {}

  auto evaluator(const Query& q) const {
    observer_.evaluates();
    return Base::evaluator(q);
  }
  void create(Index cell, const Index* vertices, int infinite_slot, int apex) {
    Base::create(cell, vertices, infinite_slot, apex);
    observer_.created();
  }
  void reserve_star(Index v, std::size_t facets) {
    observer_.reserves();
    Base::reserve_star(v, facets);
  }
  auto create_star(Index v, const Query& q, std::span<const delone::cells::HorizonFacet> facets) {
    observer_.creates();
    const auto weak = Base::create_star(v, q, facets);
    observer_.created();
    return weak;
  }

 private:
  Observer& observer_;
};

/// The Delaunay triangulation of points that span R^K.
template <int K, class Observer>
class EngineRun {
 public:
  EngineRun(delone::PointsView points, Observer& observer)
      : points_(points),
        observer_(observer),
        vertices_(K, delone::kernel::RowForm::point),
        build_(K, delone::cells::ids_for(points.size()), observer, all_axes(), K, vertices_.coordinates,
               vertices_.grid, frame_of(points)) {}

  /// Inserts all points, in the order that the library would choose.
  void insert_all() {
    const std::vector<Index> order = delone::order::automatic_order(points_, 0);
    vertices_.coordinates.reserve((order.size() + 1) * K);
    used_ = start(order);
    Batch batch{*this, order};
    for (Index v = batch.next(); v != delone::invalid_index; v = batch.next())
      batch.placed(v, build_.insert(v));
  }

  /// The same by several workers (engine/parallel_insertion.hpp).
  template <class Schedule>
  void insert_by(unsigned workers, Schedule schedule) {
    std::vector<std::size_t> rounds;
    const std::vector<Index> order = delone::order::automatic_order(points_, 0, &rounds);
    vertices_.coordinates.reserve((order.size() + 1) * K);
    used_ = start(order);
    const Index first = vertices_.last_vertex() + 1;
    for (const Index row : order)
      if (!used_[row]) append(row);
    for (std::size_t& end : rounds) end -= std::min<std::size_t>(end, K + 1);
    std::vector<Index> at(order.size() - (K + 1));
    const std::size_t few = std::min<std::size_t>(at.size(), delone::engine::few_vertices<K>);
    for (std::size_t i = 0; i < few; ++i) build_.insert(first + static_cast<Index>(i));
    const delone::engine::Batch batch{workers, first, at, rounds, [](std::size_t) {}};
    delone::engine::ParallelInsertion<K, Geometry, Schedule>(build_.insertion_parts(), batch,
                                                             std::move(schedule))
        .insert_from(few);
  }

  const delone::engine::Effort& effort() const { return build_.effort(); }
  const delone::engine::CellStore<K>& cells() const { return build_.cells(); }
  const ObservedGeometry<K, Observer>& geometry() const { return build_.geometry(); }

 private:
  using Geometry = ObservedGeometry<K, Observer>;
  /// The vertices one by one.
  struct Batch {
    EngineRun& run;
    const std::vector<Index>& order;
    std::size_t place = 0;

    Index next() {
      while (place < order.size() && run.used_[order[place]]) ++place;
      if (place == order.size()) return delone::invalid_index;
      const Index v = run.append(order[place++]);
      run.observer_.begins(run.build_.star().empty() ? 1 : 2);
      return v;
    }
    void placed(Index v, Index at) {
      if (at == v)
        run.observer_.ends(run.build_.workspace());
      else  // a duplicate
        run.vertices_.coordinates.resize(run.vertices_.coordinates.size() - K);
    }
  };

  static std::vector<int> all_axes() {
    std::vector<int> axes;
    for (int axis = 0; axis < K; ++axis) axes.push_back(axis);
    return axes;
  }
  static delone::geometry::Frame frame_of(delone::PointsView points) {
    std::vector<double> low(points[0].begin(), points[0].end()), high = low;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = 0; j < K; ++j) {
        low[j] = std::min(low[j], points[i][j]);
        high[j] = std::max(high[j], points[i][j]);
      }
    return {std::move(low), std::move(high)};
  }

  Index append(Index row) {
    const double* point = points_[row].data();
    vertices_.grid.include(point);
    vertices_.coordinates.insert(vertices_.coordinates.end(), point, point + K);
    return vertices_.last_vertex();
  }

  /// The first simplex, of the first points in the order that span space. Returns which rows are its
  /// vertices.
  std::vector<bool> start(const std::vector<Index>& order) {
    std::vector<bool> used(order.size(), false);
    delone::kernel::AffineHull hull(K);
    std::vector<Index> simplex;
    for (const Index row : order) {
      if (hull.dimension() == K) break;
      if (!hull.add(points_[row].data())) continue;
      simplex.push_back(append(row));
      used[row] = true;
    }
    auto& geometry = build_.geometry();
    geometry.set_rows(vertices_.last_vertex());
    if (geometry.orientation(simplex.data()) == delone::Sign::negative) std::swap(simplex[0], simplex[1]);
    build_.seed(simplex);
    return used;
  }

  delone::PointsView points_;
  Observer& observer_;
  delone::sites::VertexPoints vertices_;
  delone::engine::Build<K, Geometry> build_;
  std::vector<bool> used_;  // the rows of the first simplex
};

}  // namespace benchmarks
