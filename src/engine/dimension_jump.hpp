// SPDX-License-Identifier: BSD-3-Clause
// A vertex outside the affine hull of all others raises the dimension by one (§2.4 of the report): every cell
// of the old sphere S^k is joined to the new vertex, and every finite cell also to the infinite vertex.
#pragma once

#include "engine/cell_store.hpp"
#include "engine/create_functionals.hpp"
#include "engine/geometry_concept.hpp"

#include <delone/complex.hpp>

#include <algorithm>
#include <vector>

namespace delone::engine {

/// Fills an empty store of dimension k+1 from a complex of dimension k and the new vertex q.
/// `q_is_positive`: a positively oriented old cell followed by q is positively oriented.
///
/// Orientation: old cells are coherent, so all (σ, q) are coherent with each other, and positive or negative
/// as one. The cells (σ, ∞) lie across the facet σ of (σ, q) and need one exchange more.
template <int K, Geometry G>
void jump(const Complex& old, CellStore<K>& cells, G& geometry, Index q, bool q_is_positive) {
  const int k = old.affine_dimension();                              // the new cells have slots 0 … k+1
  std::vector<Index> joined(old.num_cell_slots(), invalid_index);    // (σ, q) for every old cell σ
  std::vector<Index> extended(old.num_cell_slots(), invalid_index);  // (σ, ∞) for every finite σ
  cells.reserve(static_cast<std::size_t>(old.num_all_cells()) + old.num_finite_cells());
  cells.admit_vertices(std::max(q, old.num_vertex_slots() - 1));
  for (const CellId c : old.all_cells()) joined[index(c)] = cells.allocate();
  for (const CellId c : old.finite_cells()) extended[index(c)] = cells.allocate();

  const auto link = [&](CellId c, Index cell, Index apex, Index across_base, bool exchange, auto&& across) {
    for (int i = 0; i <= k + 1; ++i) {
      const int slot = exchange && i < 2 ? 1 - i : i;
      cells.set_vertex(cell, slot, i <= k ? index(old.vertex(c, i)) : apex);
      cells.neighbors(cell)[slot] = i <= k ? across(i) : across_base;
    }
  };
  for (const CellId c : old.all_cells()) {
    const int infinite_slot = old.infinite_index(c);
    // (σ, q) with σ infinite has as base the facet σ, whose other side is (τ, ∞) with τ the finite neighbor
    // of σ.
    const Index base =
        infinite_slot < 0 ? extended[index(c)] : extended[index(old.neighbor(c, infinite_slot))];
    link(c, joined[index(c)], q, base, !q_is_positive,
         [&](int i) { return joined[index(old.neighbor(c, i))]; });
  }
  for (const CellId c : old.finite_cells())
    link(c, extended[index(c)], index(infinite_vertex), joined[index(c)], q_is_positive, [&](int i) {
      const CellId neighbor = old.neighbor(c, i);
      return old.is_infinite(neighbor) ? joined[index(neighbor)] : extended[index(neighbor)];
    });
  create_functionals(cells, geometry);
}

}  // namespace delone::engine
