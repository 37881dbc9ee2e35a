// SPDX-License-Identifier: BSD-3-Clause
// Is a cell in conflict with a query point? All stages, from the filter to the perturbation.
#pragma once

#include "engine/cell_store.hpp"
#include "engine/geometry_concept.hpp"

#include <cmath>

namespace delone::engine {

/// The exact conflict test. Cells: a CellStore, or what has vertices and neighbors like one. A query exactly on the hyperplane
/// of an infinite cell conflicts with it iff it conflicts with the finite cell on the other side of the hull facet: the
/// perturbation moves points along that hyperplane. `functional`: the geometry's evaluator for q. REQUIRES that q is none of
/// the vertices of the cell, nor of the finite neighbor of an infinite cell.
template <class Cells, QueryGeometry G, class Evaluator>
[[gnu::noinline]] bool in_conflict_exactly(const Cells& cells, const G& geometry, Index cell, const typename G::Query& q,
                                           const Evaluator& functional, StageCounts& counts) {
  for (;;) {
    const double value = functional.value(cell);
    if (std::fabs(value) > functional.threshold(cell)) {
      ++counts.filter;
      return std::signbit(value);
    }
    const Index* vertices = cells.vertices(cell);
    const bool infinite = geometry.is_infinite(cell);
    const int infinite_slot = infinite ? cells.infinite_slot(cell) : -1;
    if (geometry.proves_tie(cell, value, q)) {
      ++counts.filter;
    } else if (std::fabs(value) > geometry.threshold_at(cell, q)) {
      ++counts.filter;
      return std::signbit(value);
    } else if (const Sign side = geometry.exact_side(vertices, infinite_slot, q, counts); side != Sign::zero) {
      return side == Sign::negative;
    }
    if (!infinite) return geometry.perturbed_side(vertices, q, counts) == Sign::negative;
    cell = cells.neighbors(cell)[infinite_slot];
  }
}

/// The vertex of the cell at q, or invalid_index.
template <class Cells, QueryGeometry G>
Index vertex_at(const Cells& cells, const G& geometry, Index cell, const typename G::Query& q) {
  const Index* v = cells.vertices(cell);
  for (int i = 0; i <= cells.dimension(); ++i)
    if (v[i] != index(infinite_vertex) && geometry.is_at(v[i], q)) return v[i];
  return invalid_index;
}

}  // namespace delone::engine
