// SPDX-License-Identifier: BSD-3-Clause
// Exact checks of results of this or any other program: triangulations, convex hulls, intersections of
// halfspaces, Voronoi and power diagrams.
#pragma once

#include <delone/data.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>

#include <cstddef>
#include <iosfwd>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace delone {

/// One of the levels of check(); each presupposes those before it.
struct DELONE_EXPORT_TYPE CheckLevel {
  int number = 0;            ///< from 1 on
  std::string_view name;     ///< "storage", …
  std::string_view meaning;  ///< what it examines, in half a line
};

/// The levels of this kind of data, from 1 on.
template <PlainData Data>
DELONE_EXPORT std::span<const CheckLevel> check_levels();
/// The same; those of ComplexData and VoronoiData depend on what the data are.
DELONE_EXPORT std::span<const CheckLevel> check_levels(DataKind kind);

struct CheckOptions {
  static constexpr int all = std::numeric_limits<int>::max();
  /// The number of the highest level to examine; `all` and every larger number than the last mean the last.
  int up_to = all;

  // The following are for triangulations; for other data they must have their defaults.

  /// Require the one triangulation that the symbolic perturbation selects among those that ties allow.
  bool canonical = false;
  /// Require oriented cells: coherently, and positively when k = d. If false, cells are sets of vertices
  /// (Qhull and SciPy do not orient theirs), and level 4 requires that neighbors lie on different sides of
  /// their common facet.
  bool oriented = true;
  /// For data of unknown kind: require a furthest-site Delaunay triangulation, no point outside the sphere of
  /// a cell; points that are not extreme are not vertices.
  bool furthest_site = false;
};

struct CheckReport {
  bool ok = false;
  CheckLevel reached;     ///< the highest level examined: the failing one, or the last one requested
  std::string violation;  ///< the first violation, naming rows of arrays; empty when ok
  /// The rows of the arrays that the violation concerns, by kind.
  std::vector<std::size_t> cells, points, vertices, halfspaces;
  /// What the data say and no level examines, because they do not hold what would prove it; mostly empty.
  std::string not_examined;
  /// Triangulations: facets whose two cells are exactly cospherical (found at level 5). Hulls: ridges whose
  /// two cells lie in one hyperplane (level 3).
  std::size_t ties = 0;
};
/// Writes one line, without its end: "ok up to level 6, completeness", or "violation at level 4, volume: "
/// and what is violated; then what was not examined.
DELONE_EXPORT std::ostream& operator<<(std::ostream& out, const CheckReport& report);

/// Examines data level after level and stops at the first violation. A violation is a result, not an error.
/// Data of a known kind (DataKind) are examined as what they say they are. Throws Errc::invalid_argument
/// (up_to < 1, or options of triangulations for other data), too_many, out_of_memory, cancelled.
///
/// Triangulations. Unknown neighbors are derived from the cells first. Levels 1–5 together prove the
/// empty-sphere property of every cell against every vertex. Cost O(m·k³), and more if exact arithmetic is
/// needed.
///   1 storage          array sizes; rows and neighbors in range; no repeated vertex in a cell
///   2 incidence        neighbors are mutual and share the facet; each facet in at most two cells; coherent
///                      orientation
///   3 sphere           with the infinite cells: links of all vertices are connected, Euler characteristic of
///                      a k-sphere
///   4 volume           every finite cell has positive volume, exactly (all of one sign when k < d)
///   5 local convexity  no facet has the opposite vertex of its neighbor inside the sphere, hull facets are
///                      convex: exactly
///   6 completeness     every input point is a vertex or a duplicate of one; affine dimension is right
///
/// Lower and upper hulls, of points with a composition and a height. The same levels; cells have volume over
/// the compositions, and level 5 requires that no vertex is below (above) the hyperplane of a cell next to
/// it. Level 6 proves that no point is farther below (above) the cells than the tolerance.
///
/// Alpha complexes and trimmed triangulations. The points are triangulated anew, and that triangulation is
/// examined. Which of its cells belong to the data is not examined: they do not tell the radius or tolerance.
///   1 storage          as above
///   2 incidence        as above
///   3 part             every cell is one of the triangulation of all points, oriented as there
///
/// Periodic triangulations, in integers where doubles are not enough. Levels 1–5 prove that the cells are a
/// triangulation of the torus, or of a slab or prism, with empty spheres. Level 3 compares faces by hashes of
/// 128 bits. Cost O(m·2^k) for it, and some 50 µs per cell in space for all.
///   1 storage          as above; points and lattice on the grid of the box; no image twice in a cell
///   2 incidence        neighbors are mutual with opposite offsets, and share the facet
///   3 torus            each facet in two cells, or outside; Euler characteristic 0
///   4 volume           every cell has positive volume, and neighbors lie on different sides, exactly; the
///                      volumes add up to that of the box if all directions are periodic
///   5 local convexity  as above; outer facets are parallel to the lattice, and convex
///   6 completeness     every point is a vertex, a translate of one, or hidden
///
/// The facets around an alpha complex. Which they are is not examined.
///   1 storage          as above
///   2 closed           each of their facets is in as many of them with one orientation as with the other
///
/// The cells of a convex hull are examined as a hull.
DELONE_EXPORT CheckReport check(const ComplexData& data, const CheckOptions& options = {},
                                const Execution& how = {});

/// Convex hulls. Levels 1–4 prove that the cells are the boundary of the convex hull of all points. Needs
/// points and cells; unknown neighbors, facets and kinds are not examined. Cost O(n·m·k).
///   1 storage          array sizes; rows, neighbors and facets in range; no repeated vertex in a cell
///   2 incidence        every ridge in exactly two cells, neighbors mutual, coherent orientation, connected
///   3 convexity        no cell is flat; the boundary is convex at every ridge between two cells, exactly
///   4 support          every point is inside or on the hyperplane of every cell, exactly; the cells cover
///                      the boundary once
///   5 completeness     facets, extreme rows and kinds of points are those of the polytope; the affine
///                      dimension is right
DELONE_EXPORT CheckReport check(const HullData& data, const CheckOptions& options = {},
                                const Execution& how = {});

/// Intersections of halfspaces, in integers and independently of the construction; `lineality` and the dual
/// arrays, which are rounded, are not examined. The graph of a polyhedron is connected, so level 3 proves
/// that no vertex is missing. Flat and empty intersections are examined by their witness only. Cost: v·m
/// determinants for level 2; for level 3 the number of (k−1)-subsets of the rows of each vertex, times their
/// number: k where k facets meet, many in very degenerate vertices.
///   1 storage          array sizes; rows, vertices and directions in range
///   2 support          the rows of each vertex meet in one point that satisfies all rows, and its coordinates
///                      are that point, rounded; the same for directions; all exactly
///   3 completeness     every edge at every vertex is listed and leads to a listed vertex or direction; facets
///                      and kinds are right: so nothing is missing
DELONE_EXPORT CheckReport check(const IntersectionData& data, const CheckOptions& options = {},
                                const Execution& how = {});

/// Voronoi, power and furthest-site Voronoi diagrams. The numbering of vertices and regions, the order of
/// ridges and rays and the first entry of cyclic lists are free; for k < d so is the direction of cyclic
/// lists. From level 2 on the points are triangulated again, that triangulation is examined, and the arrays
/// are compared with its diagram: vertices by their sets of regions, rays by the sites of their hull facets,
/// exactly. So the sites of a vertex are proved to be all that are nearest to it, or furthest from it. Cost:
/// that of triangulating and of checking the triangulation. Also throws Errc::bad_dimension, not_finite and
/// unsupported.
///   1 storage          array sizes; rows and vertices in range; −1 only first; nothing twice in a list
///   2 regions          each point is in the region of its site, or hidden; the vertices of all regions, in
///                      their order for k = 2
///   3 vertices         each coordinate is the double nearest to that of the exact centre
///   4 ridges           the pairs of regions with a common facet, its vertices, in their order for k = 3
///   5 rays             the unbounded edges and their sites; directions up to 2⁻³⁰
DELONE_EXPORT CheckReport check(const VoronoiData& data, const CheckOptions& options = {},
                                const Execution& how = {});

}  // namespace delone
