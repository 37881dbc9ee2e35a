// SPDX-License-Identifier: BSD-3-Clause
// The edges that one of two complexes has, and the other one has not, from the cells that differ.
//
// Let U be the cells that both have, and e an edge of a cell that `before` alone has. If e is also in a cell
// of U, some facet at e is between such a cell u and one that `before` alone has, as the cells around an edge
// are connected by facets. In `after`, what is across that facet from u is no cell of U: it would have been
// there before. So a cell that `after` alone has contains e. Hence edges that are gone are those of cells
// that `before` alone has, less those of cells that `after` alone has, and the other way round.
#pragma once

#include <delone/complex.hpp>

#include <array>
#include <vector>

namespace delone::triangulation {

using Edge = std::array<VertexId, 2>;  ///< increasing ids

struct ChangedEdges {
  std::vector<Edge> ended, began;  ///< sorted
};

/// Of vertices with the same ids; cells are compared slot by slot.
ChangedEdges find_changed_edges(const Complex& before, const Complex& after);

}  // namespace delone::triangulation
