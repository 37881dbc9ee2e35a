// SPDX-License-Identifier: BSD-3-Clause
// The implementation of BoundaryEngine for one dimension: joins engine/ and geometry/.
#pragma once

#include "compiled/boundary_sphere.hpp"
#include "engine/build.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace delone::compiled {

template <int K>
class BoundaryEngineOfDimension final : public BoundaryOfCells<K> {
  using typename BoundaryOfCells<K>::Sphere;
  using Geometry = geometry::CentralGeometry<K>;

 public:
  BoundaryEngineOfDimension(const BoundarySites& sites, const CentralView& view, std::vector<Index> simplex)
      : BoundaryEngineOfDimension(sites, view, std::move(simplex), nullptr) {
    std::vector<Index> vertices = vertices_of(simplex_);
    const Index last = vertices.back();
    vertices.pop_back();
    internal::StageCounts uncounted;
    if (geometry().side(vertices.data(), geometry().point(last), uncounted) == Sign::negative)
      std::swap(vertices[0], vertices[1]);
    build_.seed(vertices, last);
  }

  Insertion insert(Index site) override {
    const Index v = site + 1;
    if (build_.insert(v) == v) return Insertion::vertex;
    return build_.workspace().is_strictly_hidden ? Insertion::interior : Insertion::hidden;
  }
  void insert_all(const engine::Batch& batch) override { build_.insert_all(batch); }
  bool shares_batches_of(std::size_t num_vertices) const override {
    return is_shared && geometry().can_walk() && num_vertices > engine::few_vertices<K>;
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
  bool is_surely_interior(Index site) override { return build_.is_surely_hidden(site + 1); }

  void update_box() override {
    geometry().update_box();
    build_.create_functionals();
  }
  std::unique_ptr<BoundaryEngine> copy(const BoundarySites& sites, const CentralView& view) const override {
    return std::unique_ptr<BoundaryEngine>(new BoundaryEngineOfDimension(sites, view, simplex_, this));
  }

  const Sphere& sphere() const override { return build_; }

 private:
  /// No cells, or those of another engine.
  BoundaryEngineOfDimension(const BoundarySites& sites, const CentralView& view, std::vector<Index> simplex,
                            const BoundaryEngineOfDimension* other)
      : BoundaryOfCells<K>(sites.dimension()),
        simplex_(std::move(simplex)),
        build_(sites.dimension() - 1, cells::ids_for(sites.size()), sites, view, vertices_of(simplex_)) {
    geometry().update_box();
    if (other != nullptr) build_.copy_cells(other->build_);
  }

  /// Whether several threads may insert at once.
  static constexpr bool is_shared = engine::is_shareable(K);

  static std::vector<Index> vertices_of(std::vector<Index> sites) {
    for (Index& site : sites) ++site;
    return sites;
  }
  const Geometry& geometry() const { return build_.geometry(); }
  Geometry& geometry() { return build_.geometry(); }

  std::vector<Index> simplex_;
  engine::Build<K, Geometry> build_;
};

template <int K>
std::unique_ptr<BoundaryEngine> make_boundary_of_cells(const BoundarySites& sites, const CentralView& view,
                                                       std::vector<Index> simplex) {
  return std::make_unique<BoundaryEngineOfDimension<K>>(sites, view, std::move(simplex));
}

}  // namespace delone::compiled
