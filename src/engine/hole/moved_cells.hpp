// SPDX-License-Identifier: BSD-3-Clause
// Cells whose vertices have moved: what is cached for them is recomputed, many at a time, and those that
// are no longer Delaunay are found. Each thread has an object of its own.
#pragma once

#include "base/stage_counts.hpp"
#include "engine/cell_store.hpp"
#include "engine/conflict.hpp"
#include "engine/create_functionals.hpp"
#include "engine/geometry_concept.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <new>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace delone::engine {

/// A facet, and the cell that is not Delaunay if the vertex opposite in its neighbor is inside of its sphere.
struct FacetToTest {
  Index cell, neighbor, apex;
};

template <int K, Geometry G>
class MovedCells {
 public:
  /// So many cells are renewed at once.
  static constexpr std::size_t batch_size = 64;

  /// Both must outlive this object.
  MovedCells(const CellStore<K>& cells, G& geometry)
      : cells_(cells),
        geometry_(geometry),
        width_(static_cast<std::size_t>(cells.dimension()) + 1),
        rows_(batch_size * width_ * width_),
        numbers_(batch_size * width_),
        facets_(batch_size * width_ + 1) {
    std::iota(numbers_.begin(), numbers_.end(), Index{0});
    for (std::size_t i = 0; i < batch_size; ++i) simplices_[i] = numbers_.data() + i * width_;
  }
  MovedCells(const MovedCells&) = delete;
  MovedCells& operator=(const MovedCells&) = delete;

  /// Computes what is cached for a batch of cells, and calls on_inverted(cell) for each that is not
  /// positively oriented.
  template <class OnInverted>
  void renew(std::span<const Index> batch, OnInverted&& on_inverted) {
    const std::size_t count = compute(batch);
    for (std::size_t i = 0; i < count; ++i) {
      Sign orientation = orientations_[i];
      if (orientation == Sign::zero) {
        const auto vertices = cells_.vertices(finite_[i]);
        orientation = geometry_.orientation(vertices);
      }
      if (orientation != Sign::positive) on_inverted(finite_[i]);
    }
  }

  /// The same for a batch of cells that are known to be positively oriented. Returns how many are finite;
  /// these come first in finite_, and orientations_ has those that are certain.
  std::size_t compute(std::span<const Index> batch) {
    std::size_t count = 0;
    double* row = rows_.data();
    for (const Index cell : batch) {
      const auto vertices = cells_.vertices(cell);
      const Index* const v = vertices;
      if (geometry_.is_infinite(cell)) {
        const int infinite_slot = cells_.infinite_slot(cell);
        geometry_.create(cell, v, infinite_slot, infinite_slot == 0 ? 1 : 0);
        continue;
      }
      for (std::size_t i = 0; i < width_; ++i, row += width_) geometry_.write_row_of(v[i], row);
      finite_[count++] = cell;
    }
    geometry_.create_from_rows({finite_.data(), count}, {simplices_.data(), count}, rows_.data(),
                               orientations_.data());
    for (std::size_t i = 0; i < count; ++i)
      if (orientations_[i] == Sign::zero) {
        const auto vertices = cells_.vertices(finite_[i]);
        orientations_[i] = geometry_.create(finite_[i], vertices, -1, 0);
      }
    return count;
  }

  /// Renews the cells in some slots. Cells that are not positively oriented are added to `inverted`, and the
  /// facets where cells that are turn out not to be locally Delaunay to `bad`. A facet is tested from the
  /// cell in the lower slot alone, and not at all where that one is inverted. `stop` is called now and then.
  template <class Stop>
  void renew_slots(std::size_t first, std::size_t last, std::vector<Index>& inverted,
                   std::vector<FacetToTest>& bad, StageCounts& counts, const Stop& stop) {
    auto slot = static_cast<Index>(first);
    std::array<Index, batch_size> now, next;
    std::size_t num_next = take(slot, last, next);
    while (num_next > 0) {
      stop();
      const std::size_t count = num_next, num_inverted = inverted.size();
      std::swap(now, next);
      num_next = take(slot, last, next);
      renew({now.data(), count}, [&](Index cell) { inverted.push_back(cell); });
      const std::span<const Index> inverted_now = std::span(inverted).subspan(num_inverted);
      std::size_t num_facets = 0;
      for (std::size_t i = 0; i < count; ++i)
        if (std::find(inverted_now.begin(), inverted_now.end(), now[i]) == inverted_now.end())
          num_facets = add_facets(now[i], num_facets);
      for (const FacetToTest& facet : std::span(facets_).first(num_facets))
        if (!is_locally_delaunay(facet, counts)) bad.push_back(facet);
    }
  }

  /// Whether the vertex opposite is outside of the sphere of a cell. REQUIRES that it is finite, and the cell
  /// positively oriented or infinite.
  bool is_locally_delaunay(const FacetToTest& facet, StageCounts& counts) const {
    const double value = geometry_.value_at(facet.cell, facet.apex);
    if (std::fabs(value) > geometry_.threshold(facet.cell)) [[likely]]
      return value > 0;
    return is_outside_exactly(cells_, geometry_, facet.cell, facet.apex, counts);
  }
  /// The facet between a cell and a neighbor.
  FacetToTest facet_to(Index cell, Index neighbor) const {
    return {cell, neighbor, cells_.vertex(neighbor, cells_.slot_of_neighbor(neighbor, cell))};
  }

 private:
  /// The next cells from a slot on, prefetched.
  std::size_t take(Index& slot, std::size_t last, std::array<Index, batch_size>& cells) const {
    std::size_t count = 0;
    for (; slot < last && count < batch_size; ++slot) {
      if (cells_.is_vacant(slot)) continue;
      const auto vertices = cells_.vertices(slot);
      const Index* const v = vertices;
      const Index* const neighbors = cells_.neighbors(slot);
      for (std::size_t i = 0; i < width_; ++i) {
        geometry_.prefetch_row(v[i]);
        cells_.prefetch_links(neighbors[i]);
      }
      cells[count++] = slot;
    }
    return count;
  }
  /// Adds the facets of a cell to neighbors in higher slots, without unpredictable branches. Returns how many
  /// facets there are then.
  std::size_t add_facets(Index cell, std::size_t count) {
    for (std::size_t i = 0; i < width_; ++i) {
      const FacetToTest facet = facet_to(cell, cells_.neighbors(cell)[i]);
      geometry_.prefetch_row(facet.apex);
      facets_[count] = facet;
      count += static_cast<std::size_t>(facet.neighbor > cell) &
               static_cast<std::size_t>(facet.apex != index(infinite_vertex));
    }
    return count;
  }

  const CellStore<K>& cells_;
  G& geometry_;
  const std::size_t width_;
  std::vector<double> rows_;    // of the vertices of a batch …
  std::vector<Index> numbers_;  // … which have these numbers, one after the other
  std::array<const Index*, batch_size> simplices_{};
  std::array<Index, batch_size> finite_{};
  std::array<Sign, batch_size> orientations_{};
  std::vector<FacetToTest> facets_;
};

/// Recomputes what is cached for all cells, many at a time.
template <int K, Geometry G>
void renew_all_functionals(const CellStore<K>& cells, G& geometry) noexcept {
  constexpr std::size_t batch_size = MovedCells<K, G>::batch_size;
  try {
    MovedCells<K, G> moved(cells, geometry);
    std::array<Index, batch_size> batch;
    std::size_t count = 0;
    for (Index cell = 0; cell < cells.num_slots(); ++cell) {
      if (!cells.is_vacant(cell)) batch[count++] = cell;
      if (count == batch_size || cell + 1 == cells.num_slots())
        moved.compute({batch.data(), std::exchange(count, 0)});
    }
  } catch (const std::bad_alloc&) {
    create_functionals(cells, geometry);
  }
}

/// Cells whose vertices have moved, in another thread than that of the geometry.
template <int K, Geometry G>
struct MovedCellsOfThread {
  MovedCellsOfThread(const CellStore<K>& all, const G& shared)
      : geometry(shared, typename G::ForThread()), cells(all, geometry) {}
  G geometry;
  MovedCells<K, G> cells;
};

}  // namespace delone::engine
