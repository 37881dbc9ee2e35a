// SPDX-License-Identifier: BSD-3-Clause
// The cells of a periodic triangulation and their neighbors as arrays.
#pragma once

#include "periodic/cell_classes.hpp"

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

Quotient make_quotient(const GhostTriangulation& ghosts, const PeriodicSet& set, const CellClasses& classes);

/// Whether no two edges have the same two ends and none has twice the same: then cells are told by their
/// rows.
bool is_simplicial(const GhostTriangulation& ghosts);

}  // namespace delone::periodic
