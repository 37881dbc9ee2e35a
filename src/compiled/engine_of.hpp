// SPDX-License-Identifier: BSD-3-Clause
// The implementation of Engine for one geometry and one dimension: joins engine/ and geometry/. What is asked
// of it are function templates, which visit() calls for an engine behind its interface.
#pragma once

#include "base/compiled_dimension.hpp"
#include "compiled/engine.hpp"
#include "engine/build.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace delone::compiled {

/// `Interface`: a TriangulationEngine or a BoundaryEngine.
template <class Interface, class G, int K>
class EngineOf : public Interface {
 public:
  using Sphere = engine::Sphere<K, G>;

  const Sphere& sphere() const { return build_; }
  const engine::CellStore<K>& cells() const { return build_.cells(); }
  const G& geometry() const { return build_.geometry(); }

  engine::Change insert(Index v, Index start) override {
    const Index at = build_.insert(v, start);
    engine::Workspace& work = build_.workspace();
    if (at == invalid_index)
      return {work.is_strictly_hidden ? engine::Outcome::interior : engine::Outcome::hidden};
    if (at != v) return {engine::Outcome::duplicate, at};
    Index* const made = work.zone.made.data();
    std::transform(work.star().begin(), work.star().end(), made,
                   [](const cells::HorizonFacet& facet) { return facet.created; });
    return {engine::Outcome::done, v, gone(), {made, work.star().size()}, work.swallowed};
  }
  void insert_all(const engine::Batch& batch) override { build_.insert_all(batch); }
  void sort_cells([[maybe_unused]] const engine::VertexOrder& order,
                  [[maybe_unused]] unsigned threads) override {
    if constexpr (engine::is_shareable(K)) build_.sort_cells(order, threads);
  }
  void begin_batch(bool is_small) override { build_.begin_batch(is_small); }
  void keep_batch() noexcept override { build_.keep_batch(); }
  void undo_batch(const std::function<void(Index)>& put_back) noexcept override {
    build_.undo_batch(put_back);
  }

 protected:
  /// No cells yet. `of_geometry`: what a geometry is made from, beside the memory of the cells.
  template <class... OfGeometry>
  EngineOf(int dimension, cells::VertexIds ids, OfGeometry&&... of_geometry)
      : Interface(K), build_(dimension, ids, std::forward<OfGeometry>(of_geometry)...) {}

  G& geometry() { return build_.geometry(); }
  /// The cells that the last insertion or removal replaced.
  std::span<const Index> gone() const {
    const engine::ConflictZone& zone = build_.workspace().zone;
    return {zone.cells.data(), zone.num_cells};
  }

  mutable engine::Build<K, G> build_;  // mutable for functionals that are created when they are needed
};

/// Whether several threads can insert a batch of so many vertices.
template <class Interface, class G, int K>
bool shares_batches_of(const EngineOf<Interface, G, K>& engine, std::size_t num_vertices) {
  return engine::is_shareable(K) && engine.geometry().can_walk() && num_vertices > engine::few_vertices<K>;
}

/// Calls ask(engine) for the implementation Of<K>, which is compiled for K = 1 … last and 0.
template <template <int> class Of, int last, class Ask>
decltype(auto) visit(const Engine& engine, Ask&& ask) {
  return internal::with_compiled_dimension<1, last>(
      static_cast<std::size_t>(engine.compiled_dimension()),
      [&](auto k) -> decltype(auto) { return ask(static_cast<const Of<k()>&>(engine)); });
}

}  // namespace delone::compiled
