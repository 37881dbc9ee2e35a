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
array([[ 1, -1, -1],
       [ 1,  0, -1],
       [ 0,  0,  0],
       [ 1, -1,  0]], dtype=int32)

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

}  // namespace delone::python::docs::periodic
