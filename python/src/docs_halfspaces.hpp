// SPDX-License-Identifier: BSD-3-Clause
// Docstrings: delone.HalfspaceIntersection. In the form of numpydoc; text() removes the line break in front.
#pragma once

#include "docstring.hpp"

namespace delone::python::docs::halfspaces {

inline constexpr const char* intersection = R"(
Intersection of halfspaces in any dimension: the points x with A x + b <= 0.

Exact. m is the number of halfspaces, k the rank of the normals, v the number of vertices and f that of facets. Index arrays are
int32; all arrays are read-only.

Parameters
----------
halfspaces : (m, d+1) array_like or pandas.DataFrame
    Rows [A, b], finite numbers, d >= 1.
interior_point : (d,) array_like, optional
    A point strictly inside all halfspaces. By default an exact linear program finds one.
)" DELONE_DOC_OF_BUILD_ARGUMENTS R"(
Raises
------
InputError
    If a number is NaN or infinite, or the interior point is not strictly inside; `rows` of the error names the halfspaces.
ValueError
    If an argument has another shape or is out of range.
CancelledError
    If the progress function cancels the call. Ctrl-C raises KeyboardInterrupt.
OutOfMemoryError, TimeLimitError
    If a limit is reached.

Notes
-----
A flat or empty intersection is a result, see `state`. The vertices and rays of a flat one are those of `to_polyhedron`. If the
intersection contains lines (k < d), vertices and the like are those of its section by the coordinates `axes`, and `lineality` spans the lines.

Method: duality, Preparata and Muller, doi:10.1016/0304-3975(79)90055-0. Cost: that of the convex hull of m+1 points. Methods
release the GIL.

Examples
--------
>>> import delone
>>> square = [[-1, 0, 0], [0, -1, 0], [1, 0, -1], [0, 1, -1], [1, 1, -9]]
>>> p = delone.HalfspaceIntersection(square)
>>> p.num_vertices, p.num_facets, p.volume
(4, 4, 1.0)
>>> p.kinds
array([0, 0, 0, 0, 2], dtype=uint8))";

inline constexpr const char* insert_range = R"(
Insert halfspaces as the next rows: all of them, or none if it raises.

Arrays that were taken before do not change.

Parameters
----------
halfspaces : (n, d+1) or (d+1,) array_like or pandas.DataFrame
    The halfspaces, or one.
progress : bool or callable, optional
    As for the constructor.

Raises
------
InputError
    If a number is NaN or infinite, or the interior point is not strictly inside the new halfspaces.
ValueError
    If there is another number of columns.
CancelledError, OutOfMemoryError, TimeLimitError
    If the progress function cancels the call, or a limit is reached.

Notes
-----
Everything is rebuilt if there was no interior point, or the rank rises.)";

inline constexpr const char* rank = R"(
The rank k <= d of the normals; 0 unless the state is 'full'.

d-k is the dimension of the lines in the intersection.)";

inline constexpr const char* vertex_halfspaces = R"(
The rows of the facets that meet in each vertex.

Those of vertex i are ``vertex_halfspaces[vertex_offsets[i]:vertex_offsets[i+1]]``, k or more, increasing.)";

inline constexpr const char* direction_halfspaces = R"(
The rows of the facets that contain each direction.

Those of direction i are ``direction_halfspaces[direction_offsets[i]:direction_offsets[i+1]]``, increasing.)";

inline constexpr const char* facet_vertices = R"(
The vertices of each facet.

Those of facet i are ``facet_vertices[facet_offsets[i]:facet_offsets[i+1]]``: for k = 3 along its border, counterclockwise as seen
from outside when k = d; otherwise increasing.)";

inline constexpr const char* kinds = R"(
The kind of each row, (m,) uint8.

0: a facet; 1: redundant and touching; 2: redundant; 3: a duplicate of an earlier row; 4: no condition at all.)";

inline constexpr const char* volume = R"(
The d-volume of the convex hull of the rounded vertices; infinite if unbounded, 0 if flat or empty.

Cost: that of this hull, at every call; from d = 5 on it may take far longer than the intersection.)";

inline constexpr const char* statistics = R"(
The cost of the construction so far, a dict.

Keys: `created_cells`, cells created by insertions, including those destroyed later; `visited_cells`, cells visited by walks;
`insertions`, dual points inserted; `filter`, `direct`, `exact`, conflict tests decided by the cached functional of a cell, by a
determinant in float64 with a certified bound, and by exact integers; `perturbed`, ties decided by the symbolic perturbation;
`order_seconds` and `build_seconds`, times of ordering and of inserting; `cell_bytes`, memory now reserved for cells;
`threads`, the most threads that inserted one batch.)";

}  // namespace delone::python::docs::halfspaces
