// SPDX-License-Identifier: BSD-3-Clause
// Docstrings: periodic triangulations. In the form of numpydoc; text() removes the line break in front.
#pragma once

#include "docstring.hpp"

namespace delone::python::docs::periodic {

inline constexpr const char* base = R"(
Common base of `PeriodicDelaunay` and `PeriodicRegular`: the triangulation of points and all their translates by a lattice.

Make one of these. All arrays are read-only. r is the number of lattice vectors, m the number of cells: one of each class of
translates.

Examples
--------
>>> import delone
>>> t = delone.PeriodicDelaunay([[0.25, 0.25, 0.25]], 1.0)
>>> t.num_cells
6)";

inline constexpr const char* delaunay = R"(
Delaunay triangulation of a periodic set: points and all their translates by a lattice.

Parameters
----------
points : (n, d) array_like
    The points, finite numbers, anywhere: they are moved into the box.
lattice : float, (d,) or (r, d) array_like, or ase.cell.Cell
    The length of a cubic box, the lengths of a box along the axes, or r <= d linearly independent vectors, row by row. An
    ase.Atoms is taken with its cell and its pbc.
axes : sequence of int or of bool, optional
    The lattice vectors in whose directions the set is periodic: their numbers, or a flag for each. By default all.
exact : bool, default False
    Refuse points and lattices that are not on the grid, instead of reporting the displacement.
wrap : bool, default True
    Accept points outside of the box.
unit : float, optional
    Coordinates are multiples of this number, as 0.001 for data with three decimals: then ties of the decimal numbers are ties.
)" DELONE_DOC_OF_BUILD_ARGUMENTS R"(
Raises
------
InputError
    If a number is not finite, the lattice is singular, or an option refuses the input.
ValueError
    If an array has another shape.
OutOfMemoryError
    If there is not enough memory.

See Also
--------
PeriodicRegular : The same with weights.
Delaunay : Without a lattice.

Notes
-----
Points and lattice are rounded to a grid of about 50 bits of the box, so that translates are exact; `displacement` tells how far
that has moved them, and is 0.0 for data in single precision. The result is exact for the points on the grid. It depends on the
periodic set only: not on which translates are given, nor on the basis of the lattice. Few points are no special case; but then
cells may have the same rows, and a cell may have a row twice, with other offsets: `is_simplicial`. Cost: for many uniform points in
space about twice that of `Delaunay`.

Examples
--------
A simple cubic lattice with one point per box has six cells, all at translates of that point:

>>> import delone
>>> t = delone.PeriodicDelaunay([[0.0, 0.0, 0.0]], 1.0)
>>> t.num_cells, t.is_simplicial
(6, False)
>>> t.cell_offsets[0]
array([[0, 0, 0],
       [0, 0, 1],
       [1, 0, 0],
       [0, 1, 0]], dtype=int32)

A slab is periodic along two axes:

>>> slab = delone.PeriodicDelaunay([[0, 0, 0], [0.5, 0.5, 1]], [1, 1, 9], axes=[0, 1])
>>> slab.lattice
array([[1., 0., 0.],
       [0., 1., 0.]]))";

inline constexpr const char* regular = R"(
Regular triangulation of a periodic set of weighted points: the dual of its power diagram.

Parameters
----------
points : (n, d) array_like
    The points, finite numbers, anywhere: they are moved into the box.
weights : (n,) array_like
    The weights, in the unit of squared lengths: squares of radii of balls. A translate has the weight of its point.
lattice : float, (d,) or (r, d) array_like, or ase.cell.Cell
    As for `PeriodicDelaunay`.
axes : sequence of int or of bool, optional
    As for `PeriodicDelaunay`.
exact, wrap : bool
    As for `PeriodicDelaunay`.
unit : float, optional
    As for `PeriodicDelaunay`.
)" DELONE_DOC_OF_BUILD_ARGUMENTS R"(
Raises
------
InputError
    If a number is not finite, the lattice is singular, or an option refuses the input.
ValueError
    If an array has another shape.
OutOfMemoryError
    If there is not enough memory.

See Also
--------
PeriodicDelaunay : The same without weights.
Regular : Without a lattice.

Examples
--------
>>> import delone
>>> t = delone.PeriodicRegular([[0.2, 0.2], [0.25, 0.2], [0.7, 0.6]], [0.09, 0.0, 0.01], 1.0)
>>> t.vertex_of_point
array([ 0, -1,  2], dtype=int32))";

inline constexpr const char* cells = R"(
The cells, (m, k+1) int: vertices as rows of `points`, positively oriented when k = d. The points are translated by `cell_offsets`.)";
inline constexpr const char* cell_offsets = R"(
The translations of the vertices of cells, (m, k+1, r) int32.

Vertex i of cell c is ``points[cells[c, i]] + cell_offsets[c, i] @ lattice``. 0 for the lexicographically smallest vertex of a cell.)";
inline constexpr const char* neighbors = R"(
The neighbors of cells, (m, k+1) int: number i is across the facet opposite vertex i; -1 outside, in directions that are not periodic.)";
inline constexpr const char* neighbor_offsets = R"(
The translations of the neighbors, (m, k+1, r) int32: next to a cell is its neighbor translated by ``neighbor_offsets[c, i] @ lattice``.)";
inline constexpr const char* vertex_of_point = R"(
The row of the vertex at each point, (n,) int: of points that are translates of each other the first; -1 for hidden points.)";
inline constexpr const char* point_offsets = R"(
The translations of points from their vertices, (n, r) int32; 0 for vertices and hidden points.)";
inline constexpr const char* statistics = R"(
What the construction has cost, a dict, as `Delaunay.statistics`.)";
inline constexpr const char* hash = R"(
The hash of the periodic set and its cells, 32 hexadecimal digits; the same whichever translates and basis were given.)";

inline constexpr const char* moved = R"(
Make a time step: the triangulation of the points where they have moved to.

All arrays of the result are those of ``PeriodicDelaunay(points, ...)`` with the options of this object. If most points have moved little,
across the border or not, a copy of the triangulation is repaired and certified. Otherwise everything is constructed.

Parameters
----------
points : (n, d) array_like
    Where the point of each row is now, finite numbers, anywhere.
lattice : float, (d,) or (r, d) array_like, or ase.cell.Cell, optional
    Another lattice of the same rank, for boxes that change. None: the same.
progress : callable or bool, optional
    As for the constructor.

Returns
-------
PeriodicDelaunay
    A new object. This one stays as it is, whatever happens: ``t = t.moved(points)`` goes on.

Raises
------
InputError
    If there are more or fewer points, a number is not finite, or the options of the constructor refuse the input.
ValueError
    If an array has another shape.
OutOfMemoryError
    If there is not enough memory.

See Also
--------
changed_neighbors : Which pairs of neighbors a step has changed.

Notes
-----
In space, steps of 100 000 points by a thousandth of the mean distance of neighbors take about half the time of a construction, those of
1000 points three quarters. From about two hundredths of that distance on, everything is constructed. Memory: that of two objects.

Examples
--------
>>> import delone
>>> t = delone.PeriodicDelaunay([[0.2, 0.2], [0.99, 0.5], [0.7, 0.6]], 1.0)
>>> t = t.moved([[0.2, 0.21], [1.01, 0.5], [0.7, 0.6]])
>>> t.num_cells
6)";

inline constexpr const char* moved_with_weights = R"(
Make a time step: the triangulation of the points where they have moved to, with other weights.

All arrays of the result are those of ``PeriodicRegular(points, weights, ...)`` with the options of this object. See
`PeriodicDelaunay.moved`.

Parameters
----------
points : (n, d) array_like
    Where the point of each row is now, finite numbers, anywhere.
weights : (n,) array_like, optional
    The weight of each row now. None: the same.
lattice : float, (d,) or (r, d) array_like, or ase.cell.Cell, optional
    Another lattice of the same rank, for boxes that change. None: the same.
progress : callable or bool, optional
    As for the constructor.

Returns
-------
PeriodicRegular
    A new object. This one stays as it is, whatever happens.

Raises
------
InputError
    If there are more or fewer points or weights, a number is not finite, or the options of the constructor refuse the input.
ValueError
    If an array has another shape.
OutOfMemoryError
    If there is not enough memory.

See Also
--------
changed_neighbors : Which pairs of neighbors a step has changed.

Examples
--------
>>> import delone
>>> t = delone.PeriodicRegular([[0.2, 0.2], [0.25, 0.2], [0.7, 0.6]], [0.09, 0.0, 0.01], 1.0)
>>> t.moved([[0.2, 0.2], [0.25, 0.2], [0.7, 0.6]], [0.09, 0.085, 0.01]).num_hidden
0)";

inline constexpr const char* find_simplex = R"(
Find the cell that contains each query, and how it is translated.

Parameters
----------
queries : (..., d) array_like
    The queries, finite numbers, anywhere.

Returns
-------
cells : (...) ndarray of int, or int
    The rows of `cells`; -1 outside, which is only where the set is not periodic in all directions.
offsets : (..., r) ndarray of int32
    Query i is in cell ``cells[i]`` translated by ``offsets[i] @ lattice``; 0 outside.

Raises
------
InputError
    If a query is NaN, infinite, or more than 2^29 periods away.
ValueError
    If the queries have another shape.

See Also
--------
barycentric : Also compute the coordinates in the cells.
locate : Also find the faces that contain the queries.

Notes
-----
Queries are put on the grid as the points are; with a unit, on one that is finer. The answer is exact for the query on the grid,
and moves with the query. If the query is on a face of several cells, the first of them counts. The first call makes a table. After
that a query takes about as long as without a lattice, and some microseconds near the border of the box.

Examples
--------
>>> import delone
>>> t = delone.PeriodicDelaunay([[0.25, 0.25], [0.75, 0.5]], 1.0)
>>> cells, offsets = t.find_simplex([[0.9, 0.1], [5.9, 0.1]])
>>> bool(cells[0] == cells[1]), (offsets[1] - offsets[0]).tolist()
(True, [5, 0]))";
inline constexpr const char* locate = R"(
Locate each query exactly.

Parameters
----------
queries : (..., d) array_like
    The queries, finite numbers, anywhere.

Returns
-------
Locations
    The kind, the cell and its translation `offset`, and the rows of the smallest face that contains each query, with their
    translations `face_lattice`.

Raises
------
InputError
    As for `find_simplex`.
ValueError
    If the queries have another shape.

Examples
--------
>>> import delone
>>> t = delone.PeriodicDelaunay([[0.25, 0.25], [0.75, 0.5]], 1.0)
>>> places = t.locate([[1.25, 0.25]])
>>> places[0][0], places.face_rows.tolist(), places.face_lattice.tolist()
('on_vertex', [0], [[1, 0]]))";
inline constexpr const char* barycentric = R"(
Find the cell of each query and its barycentric coordinates.

Parameters
----------
queries : (..., d) array_like
    The queries, finite numbers, anywhere.

Returns
-------
cells : (...) ndarray of int, or int
    As of `find_simplex`.
offsets : (..., r) ndarray of int32
    As of `find_simplex`.
weights : (..., k+1) ndarray of float64
    The barycentric coordinates by vertices of the cells, >= 0 with sum 1; NaN outside. None is off by more than 2^-36.

Raises
------
InputError
    As for `find_simplex`.
ValueError
    If the queries have another shape.

Examples
--------
>>> import delone
>>> t = delone.PeriodicDelaunay([[0.25, 0.25], [0.75, 0.5]], 1.0)
>>> cell, offset, weights = t.barycentric([0.9, 0.1])
>>> corners = t.points[t.cells[cell]] + (t.cell_offsets[cell] + offset) @ t.lattice
>>> (weights @ corners).round(9)
array([0.9, 0.1]))";
inline constexpr const char* nearest = R"(
Find the nearest point of each query among all translates: the minimum image.

Parameters
----------
queries : (..., d) array_like
    The queries, finite numbers, anywhere.

Returns
-------
rows : (...) ndarray of int, or int
    The rows of the nearest points; -1 without points. Of equally near points the smallest row counts, and of its translates
    the one of the lexicographically smallest offset.
offsets : (..., r) ndarray of int32
    The nearest is ``points[rows[i]] + offsets[i] @ lattice``.
distances : (...) ndarray of float64, or float
    Their distances; NaN without points.

Raises
------
InputError
    As for `find_simplex`.
ValueError
    If the queries have another shape.

Notes
-----
The answer is exact for the query on the grid. `PeriodicRegular` finds the points of least power ``|x - p|^2 - weight``, and
returns the powers. The first call makes a table of all edges.

Examples
--------
>>> import delone
>>> row, offset, distance = delone.PeriodicDelaunay([[0.25, 0.25], [0.75, 0.5]], 1.0).nearest([1.0, 0.25])
>>> int(row), offset.tolist(), float(distance)
(0, [1, 0], 0.25))";
inline constexpr const char* alpha_values = R"(
Compute the alpha values of the faces of one dimension.

The alpha value of a face is the least squared radius of a sphere that passes through its vertices and has no point or translate
strictly inside (with weights: that is orthogonal to them, with no point nearer than that).

Parameters
----------
dimension : int
    The dimension, 0 to d.

Returns
-------
ndarray of float64
    The values, in the order of ``faces(dimension)``: each is the least double that is not below the exact one. With a unit they
    are rounded once more.

Raises
------
ValueError
    If the dimension is out of range.

Notes
-----
Cost: that of the faces of all dimensions from this one on, of the points in the box and their images.

Examples
--------
>>> import delone
>>> t = delone.PeriodicDelaunay([[0.0, 0.0, 0.0]], 1.0)
>>> t.alpha_values(3).tolist()
[0.75, 0.75, 0.75, 0.75, 0.75, 0.75]
>>> sorted(t.alpha_values(1).tolist())
[0.25, 0.25, 0.25, 0.5, 0.5, 0.5, 0.75])";
inline constexpr const char* linear = R"(
The function that is linear in every cell of a periodic triangulation: periodic and continuous.

Parameters
----------
triangulation : PeriodicDelaunay or PeriodicRegular
    The triangulation of the points.
values : (n, ...) array_like
    A value of any shape for each point, real or complex. Of duplicates the first counts; those of hidden points are not used.
outside : {'fill', 'nearest', 'error'}, default 'fill'
    What queries outside get, where the set is not periodic in all directions: a constant, the value of the nearest point, or
    InputError.
fill_value : number, default nan
    The constant.

Raises
------
ValueError
    If the values do not fit the points.

See Also
--------
LinearInterpolator : Without a lattice.
PeriodicNaturalNeighborInterpolator : Smoother.

Notes
-----
Which cell contains a query is decided exactly (`PeriodicDelaunay.find_simplex`).

Examples
--------
>>> import delone
>>> t = delone.PeriodicDelaunay([[0.0], [0.5]], 1.0)
>>> f = delone.PeriodicLinearInterpolator(t, [0.0, 1.0])
>>> f([[0.25], [0.75], [10.75]])
array([0.5, 0.5, 0.5]))";
inline constexpr const char* natural = R"(
Natural neighbor interpolation on a periodic Delaunay triangulation: the sum of values times Sibson coordinates.

Parameters
----------
triangulation : PeriodicDelaunay
    The triangulation of the points.
values : (n, ...) array_like
    A value of any shape for each point, real or complex. Of duplicates the first counts.
outside : {'fill', 'nearest', 'error'}, default 'fill'
    As for `PeriodicLinearInterpolator`.
fill_value : number, default nan
    The constant.

Raises
------
ValueError
    If the values do not fit the points.
Error
    If the points have weights.

See Also
--------
NaturalNeighborInterpolator : Without a lattice.

Notes
-----
The function is continuous, and continuously differentiable except at the points. Near the border of the box a query takes several
times as long as elsewhere.

Examples
--------
>>> import delone
>>> t = delone.PeriodicDelaunay([[0.0], [0.5]], 1.0)
>>> f = delone.PeriodicNaturalNeighborInterpolator(t, [0.0, 1.0])
>>> f([[0.25], [0.75]])
array([0.5, 0.5]))";
inline constexpr const char* call = R"(
The values at queries.

Parameters
----------
queries : (..., d) array_like
    The queries, finite numbers, anywhere.

Returns
-------
(..., ...) ndarray of float64 or complex128, or number
    The shape of the queries followed by that of one value.

Raises
------
InputError
    If a query is NaN, infinite or more than 2^29 periods away, or outside with ``outside='error'``.
ValueError
    If the queries have another shape.

Examples
--------
>>> import delone
>>> t = delone.PeriodicDelaunay([[0.0], [0.5]], 1.0)
>>> float(delone.PeriodicLinearInterpolator(t, [0.0, 1.0])([0.75]))
0.5)";
inline constexpr const char* gradient = R"(
The gradients at queries.

Parameters
----------
queries : (..., d) array_like
    The queries, finite numbers, anywhere.

Returns
-------
(..., ..., d) ndarray of float64 or complex128
    The shape of the queries followed by that of one value and d. Where cells meet it is the gradient in one of them.

Raises
------
InputError
    As for calls.
ValueError
    If the queries have another shape.

Examples
--------
>>> import delone
>>> t = delone.PeriodicDelaunay([[0.0], [0.5]], 1.0)
>>> delone.PeriodicLinearInterpolator(t, [0.0, 1.0]).gradient([[0.25], [0.75]])
array([[ 2.],
       [-2.]]))";
inline constexpr const char* natural_gradient = R"(
The gradients at queries.

Parameters
----------
queries : (..., d) array_like
    The queries, finite numbers, anywhere.

Returns
-------
(..., ..., d) ndarray of float64 or complex128
    The shape of the queries followed by that of one value and d. At a point, where the function has no gradient, it is one that is
    estimated from the neighbors, as by `NaturalNeighborInterpolator.gradient`.

Raises
------
InputError
    As for calls.
ValueError
    If the queries have another shape.

Examples
--------
>>> import delone
>>> t = delone.PeriodicDelaunay([[0.0], [0.5]], 1.0)
>>> delone.PeriodicNaturalNeighborInterpolator(t, [0.0, 1.0]).gradient([[0.25], [0.75], [0.5]])
array([[ 2.],
       [-2.],
       [ 0.]]))";
inline constexpr const char* natural_neighbors = R"(
The natural neighbors of each query and their Sibson coordinates.

Parameters
----------
queries : (q, d) array_like
    The queries, finite numbers, anywhere.

Returns
-------
indptr : (q+1,) ndarray of int64
    Query i has the entries ``indptr[i]:indptr[i+1]`` of the other arrays.
rows : ndarray of int
    The rows of the neighbors.
offsets : (len(rows), r) ndarray of int32
    Their translations: a neighbor is ``points[rows[j]] + offsets[j] @ lattice``.
weights : ndarray of float64
    The coordinates, > 0 with sum 1 for each query.

Raises
------
InputError
    As for calls.
ValueError
    If the queries have another shape.

Examples
--------
>>> import delone
>>> t = delone.PeriodicDelaunay([[0.0], [0.5]], 1.0)
>>> f = delone.PeriodicNaturalNeighborInterpolator(t, [0.0, 1.0])
>>> indptr, rows, offsets, weights = f.natural_neighbors([[0.75]])
>>> rows.tolist(), offsets.tolist(), weights.tolist()
([0, 1], [[1], [0]], [0.5, 0.5]))";

}  // namespace delone::python::docs::periodic
