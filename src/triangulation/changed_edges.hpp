// SPDX-License-Identifier: BSD-3-Clause
// The edges that one of two complexes has, and the other one has not, from the cells that differ.
//
// Let U be the cells that both have, and e an edge of a cell that `before` alone has. If e is also in a cell
// of U, some facet at e is between such a cell u and one that `before` alone has, as the cells around an edge
// are connected by facets. In `after`, what is across that facet from u is no cell of U: it would have been
// there before. So a cell that `after` alone has contains e. Hence edges that are gone are those of cells
// that `before` alone has, less those of cells that `after` alone has, and the other way round.
#pragma once

#include "base/quick_rounds.hpp"

#include <delone/complex.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

namespace delone::triangulation {

using Edge = std::array<VertexId, 2>;  ///< increasing ids

struct ChangedEdges {
  std::vector<Edge> ended, began;  ///< sorted
};

/// Of vertices with the same ids; cells are compared slot by slot.
ChangedEdges find_changed_edges(const Complex& before, const Complex& after);

/// Calls visit(v, w) for each edge at the vertices v with is_chosen(v), one between two of them once.
template <class IsChosen, class Visit>
void each_edge_at(const Complex& complex, const IsChosen& is_chosen, const Visit& visit) {
  internal::QuickRounds round;
  for (Index id = 1; id < complex.num_vertex_slots(); ++id) {
    const VertexId v{id};
    if (!complex.is_vertex(v) || !is_chosen(v)) continue;
    round();
    for (const VertexId w : complex.adjacent_vertices(v))
      if (v < w || !is_chosen(w)) visit(v, w);
  }
}

template <class Pair>
void sort_unique(std::vector<Pair>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

/// What is in a and not in b, both sorted.
template <class Pair>
std::vector<Pair> difference(const std::vector<Pair>& a, const std::vector<Pair>& b) {
  std::vector<Pair> rest;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
  return rest;
}

}  // namespace delone::triangulation
