// SPDX-License-Identifier: BSD-3-Clause
// Is a cell in conflict with a query point? All stages, from the filter to the perturbation.
#pragma once

#include "engine/cell_store.hpp"
#include "engine/geometry_concept.hpp"

#include <cmath>
#include <optional>
#include <span>

namespace delone::engine {

using internal::StageCounts;

/// The answer of the stages before the perturbation for a cell and a query.
struct Unperturbed {
  Sign side;            ///< the sign of h(q)
  bool is_proved_zero;  ///< by the value of the cell's functional
  Index deciding;       ///< on a tie, the finite cell whose perturbed side decides
};

/// Settles a sign if the value is beyond the threshold. Returns whether it is.
inline bool settle(double value, double threshold, StageCounts& counts, Sign& side) {
  if (!(std::fabs(value) > threshold)) return false;
  ++counts.filter;
  side = std::signbit(value) ? Sign::negative : Sign::positive;
  return true;
}

template <QueryGeometry G>
double threshold_at(const G& geometry, Index cell, const typename G::Query& q) {
  double threshold;
  geometry.thresholds_at(std::span(&cell, 1), q, &threshold);
  return threshold;
}

/// The part of find_unperturbed_side() for when no threshold settles the sign and the value proves no tie
/// with a finite cell.
template <class Cells, QueryGeometry G, class Evaluator>
[[gnu::noinline]] void ask_further_stages(const Cells& cells, const G& geometry, const typename G::Query& q,
                                          const Evaluator& functional, StageCounts& counts,
                                          Unperturbed& known) {
  for (bool is_tie = known.is_proved_zero;;) {
    const bool infinite = geometry.is_infinite(known.deciding);
    const int infinite_slot = infinite ? cells.infinite_slot(known.deciding) : -1;
    if (is_tie) {
      ++counts.filter;
    } else {
      const auto vertices = cells.vertices(known.deciding);
      known.side = geometry.exact_side(vertices, infinite_slot, q, counts);
    }
    if (known.side != Sign::zero || !infinite) return;
    known.deciding = cells.neighbors(known.deciding)[infinite_slot];
    const double value = functional.value(known.deciding);
    if (settle(value, functional.threshold(known.deciding), counts, known.side)) return;
    is_tie = geometry.proves_tie(known.deciding, value, q);
    if (!is_tie && settle(value, threshold_at(geometry, known.deciding, q), counts, known.side)) return;
  }
}

/// For a `value` of the cell's functional that is within the threshold. Cells: a CellStore, or what has
/// vertices and neighbors like one. A query exactly on the hyperplane of an infinite cell conflicts with it
/// iff it conflicts with the finite cell on the other side of the hull facet: the perturbation moves points
/// along that hyperplane. `functional`: the geometry's evaluator for q. `threshold`: for q alone, unless the
/// value proves a tie; known: {zero, whether it does, the cell} at first. `known` is written in place:
/// returning it in registers would read together parts that were just written apart, a store-forwarding
/// stall. REQUIRES that q is none of the vertices of the cell, nor of the finite neighbor of an infinite
/// cell.
template <class Cells, QueryGeometry G, class Evaluator>
[[gnu::always_inline]] inline void find_unperturbed_side(const Cells& cells, const G& geometry, double value,
                                                         double threshold, const typename G::Query& q,
                                                         const Evaluator& functional, StageCounts& counts,
                                                         Unperturbed& known) {
  if (known.is_proved_zero && !geometry.is_infinite(known.deciding))
    ++counts.filter;
  else if (known.is_proved_zero || !settle(value, threshold, counts, known.side))
    ask_further_stages(cells, geometry, q, functional, counts, known);
}

/// The exact conflict test.
template <class Cells, QueryGeometry G, class Evaluator>
bool in_conflict_exactly(const Cells& cells, const G& geometry, Index cell, const typename G::Query& q,
                         const Evaluator& functional, StageCounts& counts) {
  const double value = functional.value(cell);
  Unperturbed known{Sign::zero, false, cell};
  if (!settle(value, functional.threshold(cell), counts, known.side)) {
    known.is_proved_zero = geometry.proves_tie(cell, value, q);
    const double threshold = known.is_proved_zero ? 0 : threshold_at(geometry, cell, q);
    find_unperturbed_side(cells, geometry, value, threshold, q, functional, counts, known);
  }
  if (known.side != Sign::zero) return known.side == Sign::negative;
  const auto vertices = cells.vertices(known.deciding);
  return geometry.perturbed_side(vertices, q, counts) == Sign::negative;
}

/// The perturbed sides of several finite cells that q is exactly on the spheres of.
template <QueryGeometry G>
void perturbed_sides(const G& geometry, std::span<const Index* const> cells, const typename G::Query& q,
                     Sign* sides, StageCounts& counts) {
  if constexpr (requires { geometry.perturbed_sides(cells, q, sides, counts); })
    geometry.perturbed_sides(cells, q, sides, counts);
  else
    for (const Index* vertices : cells) *sides++ = geometry.perturbed_side(vertices, q, counts);
}

/// The vertex of the cell at q, or invalid_index.
template <class Cells, QueryGeometry G>
Index vertex_at(const Cells& cells, const G& geometry, Index cell, const typename G::Query& q) {
  const auto vertices = cells.vertices(cell);
  const Index* const v = vertices;
  for (int i = 0; i <= cells.dimension(); ++i)
    if (v[i] != index(infinite_vertex) && geometry.is_at(v[i], q)) return v[i];
  return invalid_index;
}

/// Whether a vertex is outside of a cell: the test of local Delaunayhood for vertex `apex`, opposite the
/// common facet in the neighbor, after the filter. On the hull, it may lie in the plane of an infinite cell.
/// Vertices that have met are not outside of each other's cells. REQUIRES that apex is finite, and the cell
/// positively oriented or infinite.
template <class Cells, Geometry G>
bool is_outside_exactly(const Cells& cells, const G& geometry, Index cell, Index apex, StageCounts& counts) {
  if (!geometry.is_infinite(cell)) {
    const auto vertices = cells.vertices(cell);
    if (const std::optional<Sign> side = geometry.quick_side(vertices, apex)) {
      ++counts.direct;
      return *side == Sign::positive;
    }
  }
  const typename G::Query q = geometry.query_at(apex);
  if (vertex_at(cells, geometry, cell, q) != invalid_index) return false;
  if (const int slot = cells.infinite_slot(cell); slot >= 0) {
    const auto vertices = cells.vertices(cell);
    return geometry.exact_side(vertices, slot, q, counts) != Sign::negative;
  }
  return !in_conflict_exactly(cells, geometry, cell, q, geometry.evaluator(q), counts);
}

}  // namespace delone::engine
