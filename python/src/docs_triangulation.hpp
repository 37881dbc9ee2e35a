// SPDX-License-Identifier: BSD-3-Clause
// Docstrings: delone.Triangulation: its arrays and answers. In the form of numpydoc; text() removes the line
// break in front.
#pragma once

#include "docstring.hpp"

namespace delone::python::docs::triangulation {

inline constexpr const char* base = R"(
Common base of Delaunay, Regular and FurthestSite triangulations.

In this class n is the number of rows, d the number of coordinates, k the affine dimension, and m the number of cells.)";

inline constexpr const char* num_rows = R"(
The number n of all rows ever inserted.

More than `num_points` if rows were removed: a row keeps its number until `compact_ids`.)";

inline constexpr const char* cells = R"(
The vertices of each cell, (m, k+1) input rows, read-only.

Positively oriented when k = d: counterclockwise in the plane.)";

inline constexpr const char* vertex_of_point = R"(
The row that each row was merged into, (n,).

The row itself, or an earlier one that is equal; -1 if it is hidden or was removed.)";

inline constexpr const char* hull_facets = R"(
The facets of cells without a neighbor, (h, k) input rows.

With a point of the interior put first they are positively oriented when k = d > 1: counterclockwise as seen from outside in
space.)";

inline constexpr const char* vertex_neighbors = R"(
The neighbors of each vertex, (indptr, indices).

The rows joined to row i by an edge are ``indices[indptr[i]:indptr[i+1]]``, increasing; indptr is (n+1,) int64. Rows that are
not vertices have none.)";

inline constexpr const char* hash = R"(
The canonical hash, 32 hexadecimal digits.

It depends on the coordinates of the vertices (and weights, if they differ) and on the set of cells only. The command prints
the same. Cost: O(n d + m k).)";

inline constexpr const char* statistics = R"(
The cost of the construction so far, a dict.

Keys: `created_cells`, cells created by insertions, including those destroyed later; `visited_cells`, cells visited by walks;
`insertions`, vertices inserted; `filter`, `direct`, `exact`, conflict tests decided by the cached functional of a cell, by a
determinant in float64 with a certified bound, and by exact integers; `perturbed`, ties decided by the symbolic perturbation;
`order_seconds` and `build_seconds`, times of ordering and of inserting; `cell_bytes`, memory now reserved for cells;
`threads`, the most threads that inserted one batch.)";

inline constexpr const char* find_simplex = R"(
Find the cell that contains each query.

Parameters
----------
queries : (..., d) array_like or pandas.DataFrame
    The queries, finite numbers.
tolerance : float, default 0.0
    A distance >= 0 in the unit of the coordinates; 0 is exact. See Notes.

Returns
-------
(...) ndarray of int, or int
    The cells; -1 outside. A query on a face of several cells gets one of them.

Raises
------
InputError
    If a query is NaN or infinite.
ValueError
    If the queries have another shape, or the tolerance is negative, not finite, or larger than the set of points.

See Also
--------
barycentric : Also compute the coordinates in the cells.
locate : Also find the faces that contain the queries.

Notes
-----
With a tolerance t > 0 the answer for a query x is that of a point x' at most t away. A cell is thick if every vertex is more
than t from the affine hull of the others. x' is x if x is a vertex; otherwise the nearest point of all thick cells, if one is
within t of x; otherwise x, if x is in the hull; otherwise the nearest point of the hull, if it is within t of x. So slivers
that rounding of the points has made answer only if nothing else is near, and points that rounding has moved across the
boundary are found. For flat points, queries within t of their flat count, too.

Cost: queries are visited along a Hilbert curve, with a walk over a few cells for each. A tolerance costs nothing for queries
in thick cells; otherwise it depends on the number of cells within t.

Examples
--------
>>> import delone
>>> t = delone.Delaunay([[0, 0], [2, 0], [0, 2]])
>>> t.find_simplex([[0.5, 0.5], [3, 3]])
array([ 0, -1], dtype=int32))";

inline constexpr const char* locate = R"(
Locate each query exactly.

Parameters
----------
queries : (..., d) array_like or pandas.DataFrame
    The queries, finite numbers.
tolerance : float, default 0.0
    A distance >= 0, see `find_simplex`; 0 is exact.

Returns
-------
Locations
    The kind (in_cell, on_face, on_vertex, outside_hull or outside_affine_hull), the cell, and the rows that span the smallest
    face that contains each query.

Raises
------
InputError
    If a query is NaN or infinite.
ValueError
    If the queries have another shape, or the tolerance is out of range.

Notes
-----
Cost: as for `find_simplex`.

Examples
--------
>>> import delone
>>> delone.Delaunay([[0, 0], [2, 0], [0, 2]]).locate([[1, 0], [0, 2]])[0]
('on_face', 0, (0, 1)))";

inline constexpr const char* barycentric = R"(
Find the cell of each query and its barycentric coordinates.

Parameters
----------
queries : (..., d) array_like or pandas.DataFrame
    The queries, finite numbers.
tolerance : float, default 0.0
    A distance >= 0; 0 is exact. Otherwise the answers are those of the point x' of `find_simplex`.

Returns
-------
cells : (...) ndarray of int, or int
    The cells; -1 outside.
weights : (..., k+1) ndarray of float64
    The barycentric coordinates, >= 0 with sum 1; NaN outside. A weight is 0 exactly if the query is on the facet opposite
    that vertex. None is off by more than 2^-36.

Raises
------
InputError
    If a query is NaN or infinite.
ValueError
    If the queries have another shape, or the tolerance is out of range.

Examples
--------
>>> import delone
>>> cells, weights = delone.Delaunay([[0, 0], [2, 0], [0, 2]]).barycentric([[0.5, 1.0]])
>>> weights
array([[0.25, 0.25, 0.5 ]]))";

inline constexpr const char* columns = R"(
The labels of the columns of the DataFrame it was made of, a tuple, or None.

DataFrames of further points and of queries must have the same columns in the same order; otherwise ValueError.)";

inline constexpr const char* nearest = R"(
Find the nearest points of each query.

Parameters
----------
queries : (..., d) array_like or pandas.DataFrame
    The queries, finite numbers.
k : int, optional
    The number of points for each query, >= 1. By default one, without an axis of its own.

Returns
-------
rows : (...) or (..., k) ndarray of int, or int
    The rows of the nearest points, nearest first; -1 if there are no more points. Of equally near points the smallest row
    comes first; of equal points only the first row counts.
distances : (...) or (..., k) ndarray of float64, or float
    Their distances; NaN if there are no more points.

Raises
------
InputError
    If a query is NaN or infinite.
ValueError
    If the queries have another shape, or k < 1.
Error
    If the triangulation is a `FurthestSite`.

Notes
-----
Exact. For `Regular` the points of least power ``|x - p|^2 - weight``, and the powers. The first call makes a table of all edges;
then a query takes O(k log k) comparisons for evenly spread points.

Examples
--------
>>> import delone
>>> row, distance = delone.Delaunay([[0, 0], [2, 0], [0, 2]]).nearest([1.75, 0])
>>> int(row), float(distance)
(1, 0.25))";

}  // namespace delone::python::docs::triangulation
