// SPDX-License-Identifier: BSD-3-Clause
// All that the engine asks of geometry. The engine knows vertices and cells by index; geometry knows
// coordinates.
#pragma once

#include "base/stage_counts.hpp"
#include "cells/horizon_facet.hpp"

#include <delone/types.hpp>

#include <concepts>
#include <cstdint>
#include <span>

namespace delone::engine {

/// Answers about a query point q and a cell, given as a slot (cached functional) or as its k+1 vertices
/// (exact).
template <class G>
concept QueryGeometry = requires(const G& known, Index cell, const Index* vertices, int slot,
                                 const typename G::Query& q, double value, double* numbers,
                                 std::span<const Index> cells, internal::StageCounts& counts) {
  /// A copy of what it takes to evaluate functionals at q. value(cell): approximately h(q); among finite
  /// cells, the smaller the closer to a conflict. threshold(cell): a value beyond it has the sign of h(q).
  /// error(cell, value): |value − h(q)| is below it. A value that is not a number says nothing.
  { known.evaluator(q).value(cell) } -> std::same_as<double>;
  { known.evaluator(q).threshold(cell) } -> std::same_as<double>;
  { known.evaluator(q).error(cell, value) } -> std::same_as<double>;
  /// Other thresholds of several cells, for this query alone and at some cost.
  {known.thresholds_at(cells, q, numbers)};
  /// Whether a value within the threshold proves that h(q) is exactly zero.
  { known.proves_tie(cell, value, q) } -> std::same_as<bool>;
  /// The exact sign of h(q).
  { known.exact_side(vertices, slot, q, counts) } -> std::same_as<Sign>;
  /// The sign of a perturbed h(q) for a finite cell with h(q) = 0: never zero.
  { known.perturbed_side(vertices, q, counts) } -> std::same_as<Sign>;
  /// The exact side of facet `slot` of a finite cell that q lies on: positive is the side of the cell.
  { known.side_of_facet(vertices, slot, q) } -> std::same_as<Sign>;
  { known.is_at(cell, q) } -> std::same_as<bool>;
  { known.is_infinite(cell) } -> std::same_as<bool>;
  /// Whether a walk can be led by values and side_of_facet(); without, all cells are asked.
  { known.can_walk() } -> std::same_as<bool>;
  /// Whether finite cells in one hyperplane have equal functionals, none of which is the least.
  { G::has_plateaus } -> std::convertible_to<bool>;
};

/// The same, and functionals for new cells.
template <class G>
concept Geometry = QueryGeometry<G> &&
    requires(G geometry, Index cell, const Index* vertices, int slot, const typename G::Query& q,
             std::size_t size, bool known, std::span<const cells::HorizonFacet> facets) {
  /// The query at the point of a vertex.
  { geometry.query_at(cell) } -> std::same_as<typename G::Query>;
  /// Computes what is cached for a new cell; the third argument is the slot of the infinite vertex or −1, the
  /// fourth that of a finite vertex.
  {geometry.create(cell, vertices, slot, slot)};
  /// The same, saying nothing of the cell, which is infinite or not.
  {geometry.give_up(cell, known)};
  /// Makes room for the star of a vertex, then computes what is cached for its cells from those on the two
  /// sides of each facet; returns the facets whose cells must be created singly.
  {geometry.reserve_star(cell, size)};
  { geometry.create_star(cell, q, facets) } -> std::same_as<std::span<const std::uint32_t>>;
};

}  // namespace delone::engine
