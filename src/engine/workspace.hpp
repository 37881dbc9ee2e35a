// SPDX-License-Identifier: BSD-3-Clause
// What one insertion leaves to the next: memory that it reuses, the star it made, and counts. Nothing of it
// is part of the triangulation, so that a thread can have one of its own.
#pragma once

#include "base/stage_counts.hpp"
#include "engine/conflict_zone.hpp"
#include "engine/ridge_table.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace delone::engine {

/// What insertions have cost.
struct Effort {
  std::uint64_t created_cells = 0;
  std::uint64_t visited_cells = 0;
  StageCounts stages;
};

struct Workspace {
  ConflictZone zone;
  RidgeTable ridges;
  Index last_cell = 0;              ///< one of the last insertion, or where the last walk ended
  bool is_strictly_hidden = false;  ///< what was inserted last; see WalkResult::strictly
  bool cells_have_marks = true;     ///< whether marks are in the cells, and have to be taken back
  bool shares_survivors = false;    ///< whether other threads may link survivors with cells of their own
  bool tracks_swallowed = false;    ///< whether insertions fill `swallowed`: it costs
  std::vector<Index> swallowed;     ///< the vertices that lost all their cells by the last insertion

  /// The facets that the cells of the last insertion were made from; none if there was no star.
  std::span<const HorizonFacet> star() const { return {zone.horizon.data(), zone.num_facets}; }
  /// Forgets the last insertion.
  void clear() {
    zone.num_cells = zone.num_facets = 0;
    swallowed.clear();
  }
};

}  // namespace delone::engine
