// SPDX-License-Identifier: BSD-3-Clause
// Which points have become neighbors, and which are neighbors no more, since an earlier state: what updates
// the lists of neighbors of a simulation after a time step.
#pragma once

#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/periodic.hpp>
#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone {

/// Pairs of points that an edge joins in one of two triangulations only, each pair once, sorted.
struct NeighborChanges {
  int rank = 0;  ///< r, the number of lattice vectors; 0 of triangulations that are not periodic
  std::vector<SignedIndex> began, ended;  ///< pairs of rows, one after the other; the first is not larger
  /// r numbers for each pair: by how many of each lattice vector the second point is translated, from where
  /// it is given in the triangulation that has the edge.
  std::vector<std::int32_t> began_offsets, ended_offsets;

  std::size_t num_began() const { return began.size() / 2; }
  std::size_t num_ended() const { return ended.size() / 2; }
};

/// What has changed between two states of a triangulation, such as its clone() from before an edit and
/// itself. Of points in one place the first row stands for all. Works for any two triangulations whose rows
/// mean the same. Where cells have kept their slots, as in edits that do not rebuild everything, the cost is
/// a glance at each slot and O(c·k²·log c) for the c cells that differ; otherwise all cells differ. Throws
/// Errc::out_of_memory.
DELONE_EXPORT NeighborChanges changed_neighbors(const Triangulation& before, const Triangulation& after,
                                                const Execution& how = {});

/// The same of a periodic set of as many points, after moved(). A point goes on as the translate of its new
/// point whose difference from the old one has coefficients of at most 1/2 in short lattice vectors. After
/// small steps that is the nearest translate. Giving a point in another period changes no neighbors. Fast if
/// `after` is one step from `before`, and the step was a repair. Throws Errc::bad_dimension for other numbers
/// of points or lattice vectors, unsupported if offsets do not fit into 32 bits, out_of_memory.
DELONE_EXPORT NeighborChanges changed_neighbors(const PeriodicTriangulation& before,
                                                const PeriodicTriangulation& after,
                                                const Execution& how = {});

}  // namespace delone
