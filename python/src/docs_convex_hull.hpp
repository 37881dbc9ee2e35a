// SPDX-License-Identifier: BSD-3-Clause
// Docstrings: delone.ConvexHull. In the form of numpydoc; text() removes the line break in front.
#pragma once

#include "docstring.hpp"

namespace delone::python::docs::convex_hull {

inline constexpr const char* hull = R"(
Convex hull of points in any dimension.

Exact: a function of the set of points. A cell is a simplex of the boundary with k vertices; a facet is a facet of the polytope and
consists of one cell, or of several in one hyperplane. f is the number of facets, r that of ridges. Index arrays are int32; all
arrays are read-only.

Parameters
----------
points : (n, d) array_like or pandas.DataFrame
    The points, finite numbers that are exact in float64, d >= 1. Duplicates are merged; flat points have their hull in their flat.
tolerance : float or (d,) array_like, default 0.0
    The largest distance, >= 0 in the unit of the coordinates, of a point from the hull; 0 is exact. Or one for each axis, in the
    unit of its column, all 0 or none. See Notes.
)" DELONE_DOC_OF_BUILD_ARGUMENTS R"(
Raises
------
InputError
    If a number is NaN or infinite. The message names the row, and the column of a DataFrame.
ValueError
    If an argument has another shape or is out of range.
CancelledError
    If the progress function cancels the call. Ctrl-C raises KeyboardInterrupt.
OutOfMemoryError, TimeLimitError
    If a limit is reached. The message says how far the call got and about what the whole would need.

See Also
--------
convex_hulls : Many small hulls at once.
LowerHull : The lower part of a hull.

Notes
-----
With a tolerance the hull is the exact hull of some of the points, such that no point is farther than this outside; no vertex can be
omitted. `max_distance` bounds the distances. The hull is convex and closed, its vertices are input rows, and distances are decided
exactly. The farthest points are chosen first. A facet then consists of cells whose vertices are within the tolerance of the plane
of its largest cell, the plane in `equations`. Points near a flat of fewer dimensions have the hull of their projections on `axes`
in it. ValueError if the tolerance is negative, not finite, or larger than the set along every axis.

With a tolerance for each axis no point is farther outside along an axis than that. Axes are multiplied by powers of two for which
the tolerances agree but for a factor below 2, and are lowered to the least of them; distances are those after that. So columns of
different units do not swallow each other, and one that is multiplied by a power of two, with its tolerance, has the same hull.

Method: incremental insertion with symbolic perturbation of ties, Devillers and Teillaud, doi:10.1016/j.comgeo.2010.09.010. Cost:
O(n) cells for evenly spread points, at worst O(n^floor(d/2)). Methods release the GIL.

Examples
--------
>>> import delone
>>> hull = delone.ConvexHull([[0, 0], [2, 0], [2, 2], [0, 2], [1, 1]])
>>> hull.vertices
array([0, 1, 2, 3], dtype=int32)
>>> hull.volume, hull.area
(4.0, 8.0))";

inline constexpr const char* axis_tolerances = R"(
How far points may be outside along each axis, (d,) float64.

`tolerance` for all axes, or, if axes have tolerances of their own, those that are used: what was given, lowered by less than half
of it.)";

inline constexpr const char* of_extreme_points = R"(
Compute the hull of the extreme points among points.

The hull may have other rows, too, but all vertices of its cells are extreme: if many points lie in the hyperplanes of facets, there
are far fewer cells than in the hull of all points.

Parameters
----------
points : (n, d) array_like or pandas.DataFrame
    The points, finite numbers that are exact in float64, d >= 1. Duplicates are merged; flat points have their hull in their flat.
tolerance : float or (d,) array_like, default 0.0
    As for the constructor.
)" DELONE_DOC_OF_BUILD_ARGUMENTS R"(
Returns
-------
hull : ConvexHull
    The hull.
rows : ndarray of int
    Row i of the hull is ``points[rows[i]]``, in no particular order.

Raises
------
InputError, ValueError, CancelledError, OutOfMemoryError, TimeLimitError
    As for the constructor.

Notes
-----
Cost: that of the hull of the extreme points, and one or two passes over all points. A copy by pickling may number cells otherwise.)";

inline constexpr const char* insert_range = R"(
Insert points as the next rows: all of them, or none if it raises.

Arrays that were taken before do not change.

Parameters
----------
points : (n, d) or (d,) array_like or pandas.DataFrame
    The points, or one.
progress : bool or callable, optional
    As for the constructor.

Raises
------
InputError
    If a number is NaN or infinite.
ValueError
    If there is another number of columns, or the tolerance is larger than the set.
CancelledError, OutOfMemoryError, TimeLimitError
    If the progress function cancels the call, or a limit is reached.

Notes
-----
Cost: that of the new points. A point that raises the affine dimension makes it rebuild everything.)";

inline constexpr const char* cells = R"(
The vertices of each cell, (m, k) input rows, in no particular order.

With a point of the interior put first each is positively oriented when k = d > 1.)";

inline constexpr const char* facets = R"(
The extreme rows of each facet, (offsets, rows).

Those of facet i are ``rows[offsets[i]:offsets[i+1]]``, increasing; offsets is (f+1,).)";

inline constexpr const char* ridges = R"(
The facets and extreme rows of each ridge, (facets, offsets, rows).

facets is (r, 2): the two facets that meet in each ridge, the smaller number first. The extreme rows of ridge i are
``rows[offsets[i]:offsets[i+1]]``, increasing; offsets is (r+1,).)";

inline constexpr const char* equations = R"(
The unit outward normal and the offset of each facet, (f, d+1) float64.

normal . x + offset <= 0 inside, up to `equation_errors`. For k < d normals are parallel to the flat.)";

inline constexpr const char* equation_errors = R"(
Bounds on the errors of `equations`, (f,) float64.

For a point of the hull the exact signed distance from the facet differs by at most this from that of the rounded equation,
evaluated without error. Infinite when k < d.)";

inline constexpr const char* point_kinds = R"(
The kind of each row, (n,) uint8.

0: extreme; 1: on the boundary otherwise, or outside within the tolerance; 2: interior; 3: equal to an earlier row.)";

inline constexpr const char* volume = R"(
The k-dimensional volume, off by at most `volume_error`.

0 for k < 1. Cost: O(m d^3), once.)";

inline constexpr const char* f_vector = R"(
The number of faces of the polytope of each dimension 0 to k-1, a tuple.

With a tolerance, faces are the sets of vertices that facets have in common. Cost: up to O(faces f k), and memory for all faces of
one dimension.)";

inline constexpr const char* hash = R"(
The canonical hash, 32 hexadecimal digits.

It depends on the coordinates of the cells' vertices and on the set of cells only. The command prints the same. Cost: O(m k).)";

inline constexpr const char* statistics = R"(
The cost of the construction so far, a dict.

Keys: `created_cells`, cells created by insertions, including those destroyed later; `visited_cells`, cells visited by walks;
`insertions`, points inserted; `filter`, `direct`, `exact`, conflict tests decided by the cached functional of a cell, by a
determinant in float64 with a certified bound, and by exact integers; `perturbed`, ties decided by the symbolic perturbation;
`order_seconds` and `build_seconds`, times of ordering and of inserting; `cell_bytes`, memory now reserved for cells;
`threads`, the most threads that inserted one batch.)";

inline constexpr const char* contains = R"(
Return whether each query is inside or on the boundary, exactly.

Parameters
----------
queries : (..., d) array_like or pandas.DataFrame
    The queries, finite numbers.

Returns
-------
(...) ndarray of bool, or bool
    The answers.

Raises
------
InputError
    If a coordinate of a query is NaN or infinite.
ValueError
    If the queries have another shape.

Notes
-----
Cost: a walk over cells for each query.

Examples
--------
>>> import delone
>>> delone.ConvexHull([[0, 0], [2, 0], [0, 2]]).contains([[1, 1], [2, 2]])
array([ True, False]))";

inline constexpr const char* locate = R"(
Locate each query exactly.

Parameters
----------
queries : (..., d) array_like or pandas.DataFrame
    The queries, finite numbers.

Returns
-------
Locations
    The kind (inside, on_boundary, outside or outside_affine_hull); a cell: a visible one for queries outside, one whose hyperplane
    contains the query on the boundary, one through which a ray from an interior point through the query leaves the hull inside,
    otherwise -1; and on the boundary the extreme rows of the smallest face that contains the query.

Raises
------
InputError
    If a coordinate of a query is NaN or infinite.
ValueError
    If the queries have another shape.

Notes
-----
Cost: a walk over cells for each query.)";

inline constexpr const char* plane_distance = R"(
Compute the signed distances of queries from the hyperplanes of the facets.

Parameters
----------
queries : (..., d) array_like or pandas.DataFrame
    The queries, finite numbers.

Returns
-------
(..., f) ndarray of float64
    The distances, positive outside, rounded. `locate` and `visible_facets` decide signs exactly.

Raises
------
InputError
    If a coordinate of a query is NaN or infinite.
ValueError
    If the queries have another shape.

Notes
-----
Cost: O(f d) for each query.)";

inline constexpr const char* visible_facets = R"(
Find the facets that are strictly visible from a point, exactly.

Parameters
----------
point : (d,) array_like
    The point, finite numbers.

Returns
-------
ndarray of int
    The facets, increasing. Empty for a point of the hull or outside its flat.

Raises
------
InputError
    If a coordinate is NaN or infinite.
ValueError
    If the point has another number of coordinates.

Notes
-----
Cost: that of the visible cells, and a walk.)";

}  // namespace delone::python::docs::convex_hull
