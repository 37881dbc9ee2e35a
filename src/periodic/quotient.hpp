// SPDX-License-Identifier: BSD-3-Clause
// The cells of a periodic triangulation, one of each class of translates: the one whose lexicographically
// smallest vertex is a point of the set in the box. A translation keeps the order of points, so there is
// exactly one.
#pragma once

#include "periodic/ghost_triangulation.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::periodic {

/// Offsets are in terms of the caller's points and lattice vectors, 0 for the smallest vertex of a cell.
struct Quotient {
  std::vector<SignedIndex> cells;  ///< m×(k+1) rows
  std::vector<std::int32_t> cell_offsets;
  std::vector<SignedIndex> neighbors;  ///< m×(k+1) cells; −1 outside
  std::vector<std::int32_t> neighbor_offsets;
};

/// The cell of a triangulation with ghosts that stands for each class, by its slot; −1 for others.
struct CanonicalCells {
  std::vector<SignedIndex> number_of_slot;
  std::vector<CellId> cells;
  std::vector<VertexId> smallest;  ///< the vertex of each cell
};
CanonicalCells find_canonical_cells(const GhostTriangulation& ghosts);

Quotient make_quotient(const GhostTriangulation& ghosts, const PeriodicSet& set);

/// Whether no two edges have the same two ends and none has twice the same: then cells are told by their
/// rows.
bool is_simplicial(const GhostTriangulation& ghosts);

}  // namespace delone::periodic
