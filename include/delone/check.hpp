// SPDX-License-Identifier: BSD-3-Clause
// The six levels of exact checks of a Delaunay, regular or furthest-site triangulation, our own or anybody's.
#pragma once

#include <delone/complex.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace delone {

enum class CheckLevel : int {
  storage = 1,  ///< array sizes; rows and neighbors in range; no repeated vertex in a cell
  incidence =
      2,  ///< neighbors are mutual and share the facet; each facet in at most two cells; coherent orientation
  sphere = 3,  ///< with the infinite cells: links of all vertices are connected, Euler characteristic of a
               ///< k-sphere
  volume = 4,  ///< every finite cell has positive volume, exactly (all of one sign when k < d)
  local_convexity = 5,  ///< no facet has the opposite vertex of its neighbor inside the sphere, hull facets
                        ///< are convex: exactly
  completeness = 6,     ///< every input point is a vertex or a duplicate of one; affine dimension is right
};

struct CheckOptions {
  CheckLevel up_to = CheckLevel::completeness;
  /// Ask for the one triangulation that the symbolic perturbation selects among those that ties allow.
  bool canonical = false;
  /// Ask that cells are oriented: coherently, and positively when k = d. Without, cells are sets of vertices
  /// (Qhull and SciPy do not orient theirs), and level 4 asks that neighbors lie on different sides of their
  /// common facet.
  bool oriented = true;
  /// Ask for a furthest-site Delaunay triangulation: no point outside the sphere of a cell; points that are
  /// not extreme are no vertices.
  bool furthest_site = false;
};

struct CheckReport {
  bool ok = false;
  CheckLevel reached =
      CheckLevel::storage;  ///< the highest level examined: the failing one, or the last one asked for
  std::string violation;    ///< the first violation, naming cells (rows of `cells`) and points; empty when ok
  std::vector<std::size_t> cells;   ///< the cells concerned
  std::vector<std::size_t> points;  ///< the points concerned
  std::size_t ties = 0;             ///< facets whose two cells are exactly cospherical (level 5)
};

/// Examines level after level, stopping at the first violation. Unknown neighbors are derived from the cells
/// first. Levels 1–5 together prove the empty-sphere property of every cell against every vertex. Cost
/// O(m·k³) and more where exact arithmetic is needed.
CheckReport check(const ComplexData& data, const CheckOptions& options = {});

}  // namespace delone
