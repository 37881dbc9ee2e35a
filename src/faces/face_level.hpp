// SPDX-License-Identifier: BSD-3-Clause
// The faces of a triangulation, one dimension after the other: each with its vertices, a cell, and the faces
// of one dimension less.
#pragma once

#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <vector>

namespace delone::internal {

/// All finite faces of one dimension. Their order depends on the ids of cells and vertices, and on nothing
/// else.
struct FaceLevel {
  int dimension = -1;                  ///< j
  std::vector<SignedIndex> vertices;   ///< n×(j+1) ids, increasing in each face
  std::vector<SignedIndex> cells;      ///< n: the number of a finite cell that contains it; empty: its own
  std::vector<unsigned char> on_hull;  ///< n: 1 if it lies in the boundary of the hull; empty: none does
  /// n×(j+1), for cells only: the cell across the facet opposite each vertex, invalid_index beyond the hull.
  std::vector<Index> neighbors;
  /// n×(j+1): the number of the facet opposite each vertex, in the level of dimension j−1. Empty until that
  /// has been made.
  std::vector<Index> facets;

  std::size_t corners() const { return static_cast<std::size_t>(dimension) + 1; }
  std::size_t size() const { return vertices.size() / corners(); }
};

/// The finite cells, in the order of finite_cells().
FaceLevel level_of_cells(const Triangulation& triangulation);

/// The facets of all faces of a level, which learns their numbers. At most so many threads
/// (Options::threads); the result does not depend on them. `expected`: how many there will be, 0 if that is
/// not known. REQUIRES dimension ≥ 1.
FaceLevel facets_of(FaceLevel& level, Index num_vertex_slots, unsigned threads, std::size_t expected = 0);

}  // namespace delone::internal
