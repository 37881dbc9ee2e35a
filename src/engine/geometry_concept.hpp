// SPDX-License-Identifier: BSD-3-Clause
// All that the engine asks of geometry. The engine knows vertices and cells by index; geometry knows coordinates.
#pragma once

#include "facet_side.hpp"
#include "stage_counts.hpp"

#include <delone/types.hpp>

#include <concepts>

namespace delone::engine {

/// Answers about a query point q and a cell, given as a slot (cached functional) or as its k+1 vertices (exact).
template <class G>
concept Geometry = requires(G geometry, const G& known, Index cell, const Index* vertices, int slot, const typename G::Query& q,
                            StageCounts& counts, std::size_t size, double value, FacetSide side) {
  /// Approximately h(q); among finite cells, the smaller the closer to a conflict.
  { known.value(cell, q) } -> std::same_as<double>;
  /// The certified sign of h(q) from that value, or zero: uncertain. Negative: in conflict.
  { known.filter_side(cell, value, q) } -> std::same_as<Sign>;
  /// The exact sign of h(q), ties perturbed; zero only if the cell is infinite and q on its hyperplane.
  { known.exact_side(vertices, slot, q, counts) } -> std::same_as<Sign>;
  /// The exact side of facet `slot` of a finite cell that q lies on: positive is the side of the cell.
  { known.side_of_facet(vertices, slot, q) } -> std::same_as<Sign>;
  { known.is_at(cell, q) } -> std::same_as<bool>;
  { known.is_infinite(cell) } -> std::same_as<bool>;
  {geometry.reserve_cells(size)};
  /// Computes what is cached for a new cell; the third argument is the slot of the infinite vertex or −1, the fourth that of a
  /// finite vertex.
  {geometry.create(cell, vertices, slot, slot)};
  /// The same for a cell that joins q to the facet between a cell in conflict with it and one that is not.
  {geometry.create_across(cell, vertices, slot, slot, q, side, side)};
};

}  // namespace delone::engine
