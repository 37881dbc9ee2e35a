// SPDX-License-Identifier: BSD-3-Clause
// Docstrings: faces, alpha complexes and measures of cells. In the form of numpydoc; text() removes the line
// break in front.
#pragma once

#include "docstring.hpp"

namespace delone::python::docs::faces {

inline constexpr const char* faces = R"(
Enumerate the faces of one dimension, each once.

Parameters
----------
dimension : int
    The dimension, 0 to d. 0: vertices; 1: edges; k: cells; none above k.

Returns
-------
Faces
    The faces. Their order is a function of the triangulation, and that of ``alpha_values(dimension)``.

Raises
------
ValueError
    If the dimension is out of range.

Notes
-----
Cost: that of finding the faces of all dimensions from this one on.

Examples
--------
>>> import delone
>>> sorted(delone.Delaunay([[0, 0], [2, 0], [0, 2]]).faces(1).vertices.tolist())
[[0, 1], [0, 2], [1, 2]])";

inline constexpr const char* qualities = R"(
Measure the quality of each cell.

With the circumradius R, the inradius r, the volume V and the edges l of a cell, and V1 the volume of the regular cell with edges
of length 1: 'radius_ratio' is k r / R, and 'mean_ratio' is k(k+1)/2 (V/V1)^(2/k) / sum l^2, both from 0 (flat) to 1 (regular);
'radius_edge_ratio' is R over the shortest edge, at least sqrt(k/(2k+2)).

Parameters
----------
measure : {'radius_ratio', 'mean_ratio', 'radius_edge_ratio'}
    The measure. None depends on the scale.

Returns
-------
(m,) ndarray of float64
    The qualities. The relative error is certified to be below 1e-9.

Raises
------
ValueError
    If there is no such measure.

Notes
-----
Liu and Joe, doi:10.1007/BF01955874, and Shewchuk, doi:10.1145/276884.276894. Cost: O(m k^3).)";

inline constexpr const char* alpha_complex = R"(
Compute the alpha complex below a radius.

It consists of the faces with an alpha value of at most radius^2. Its union has the shape of the union of the balls of that radius
about the points; for `Regular`, of the balls with the squared radii radius^2 + weight.

Parameters
----------
radius : float, optional
    The radius, >= 0, in the unit of the coordinates; infinity gives all faces.
squared_radius : float, optional
    The squared radius instead, any number; for `Regular` also below 0.

Returns
-------
AlphaComplex
    The complex.

Raises
------
ValueError
    If the radius is negative or NaN, or both or neither are given.
Error
    If the triangulation is a `FurthestSite`.

Notes
-----
Exact: rounding never decides, and cospherical cells belong to the same complexes. Edelsbrunner and Muecke,
doi:10.1145/174462.156635. Cost: O(m k^3).

Examples
--------
>>> import delone
>>> t = delone.Delaunay([[0, 0], [1, 0], [0, 1], [9, 9]])
>>> t.alpha_complex(1).cells.tolist()
[[0, 1, 2]])";

inline constexpr const char* alpha_values = R"(
Compute the alpha values of the faces of one dimension.

The alpha value of a face is the least squared radius of a sphere that passes through its vertices and has no point strictly
inside (with weights: that is orthogonal to them, with no point nearer than that).

Parameters
----------
dimension : int
    The dimension, 0 to d.

Returns
-------
ndarray of float64
    The values, in the order of ``faces(dimension)``: each is the least double that is not below the exact one.

Raises
------
ValueError
    If the dimension is out of range.
Error
    If the triangulation is a `FurthestSite`.

Notes
-----
``values <= s`` tells exactly which faces are in ``alpha_complex(squared_radius=s)``. Equal exact values are equal, and no face has
a greater value than one that contains it. Cost: that of ``faces(dimension)``, and small systems of equations for each face.)";

inline constexpr const char* alpha_filtration = R"(
Compute the faces and alpha values of all dimensions at once.

Returns
-------
list of (Faces, ndarray)
    ``faces(j)`` and ``alpha_values(j)`` for j from 0 to k.

Raises
------
Error
    If the triangulation is a `FurthestSite`.)";

inline constexpr const char* optimal_alpha_value = R"(
Compute the least squared radius whose alpha complex covers all points in few pieces.

Parameters
----------
num_components : int or None, default 1
    The most pieces, >= 1: sets of cells that common facets connect, so cells that only touch count as apart. None: any number.

Returns
-------
float
    The least double s for which ``alpha_complex(squared_radius=s)`` has each vertex in a cell, and at most so many pieces. -inf without
    points.

Raises
------
ValueError
    If `num_components` is less than 1.
Error
    If the triangulation is a `FurthestSite`.

Notes
-----
This is the optimal alpha of CGAL. A larger radius may give more pieces again, as a cell may come before its neighbors. One point far from
all others makes it large. Exact, as `alpha_values` are. Cost: that of ``alpha_values(k)``, and O(m log m).

Examples
--------
>>> import delone
>>> t = delone.Delaunay([[0, 0], [1, 0], [0, 1], [1, 1], [4, 0], [5, 0], [4, 1]])
>>> t.optimal_alpha_value(None)
0.5
>>> len(t.alpha_complex(squared_radius=t.optimal_alpha_value(num_components=2)))
3)";

inline constexpr const char* polygons = R"(
Find the outline of the complex in the plane, as polygons.

Returns
-------
list of list of ndarray
    The rings of each polygon, as arrays of input rows in order, whose first one is not repeated: first the outer ring, counterclockwise,
    then one around each hole, clockwise.

Raises
------
Error
    If the points are not in the plane, d = 2.
RuntimeError
    If points have been added to the triangulation since.

Notes
-----
The polygons are the union of the cells; singular edges do not belong to it. Each polygon is the union of the triangles that common edges
connect. No ring visits a point twice: a polygon that touches itself has a hole there, and polygons that touch each other are apart. So
they are valid in the sense of Simple Features, as shapely and GeoJSON want them. Each ring begins with its least row, and these rows
order polygons and holes. Exact.

Examples
--------
>>> import delone
>>> points = [[0, 0], [1, 0], [2, 0], [0, 1], [2, 1], [0, 2], [1, 2], [2, 2]]
>>> [[outer.tolist(), [hole.tolist() for hole in holes]]
...  for outer, *holes in delone.Delaunay(points).alpha_complex(0.75).polygons()]
[[[0, 1, 3], []], [[1, 2, 4], []], [[3, 6, 5], []], [[4, 7, 6], []]])";

inline constexpr const char* boundary_components = R"(
Separate the boundary into closed surfaces.

Returns
-------
components : (b,) ndarray of int
    The surface that each facet of `boundary` belongs to.
bodies : (c,) ndarray of int
    The body that each of the c surfaces encloses, or is a cavity of: the cells that common facets connect.
neighbors : (b, k) ndarray of int
    The facet across the face opposite vertex i of each facet.

Raises
------
RuntimeError
    If points have been added to the triangulation since.

Notes
-----
Each component is closed: neighbors are mutual, so in space two triangles meet at each edge. Around an edge that has more triangles those
that enclose the same cells are neighbors, and bodies that only touch are not joined. The boundary of a cavity is a component of its own
unless the cavity touches the outside in an edge. Exact.

Examples
--------
>>> import delone
>>> points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [9, 9, 9], [9, 8, 9], [8, 9, 9], [9, 9, 8]]
>>> components, bodies, neighbors = delone.Delaunay(points).alpha_complex(1).boundary_components()
>>> components.tolist(), bodies.tolist()
([0, 0, 0, 0, 1, 1, 1, 1], [0, 1]))";

inline constexpr const char* result = R"(
Faces of one dimension of a triangulation, read-only.

Returned by `Delaunay.faces`.

Examples
--------
>>> import delone
>>> faces = delone.Delaunay([[0, 0], [2, 0], [0, 2]]).faces(1)
>>> faces.on_hull
array([ True,  True,  True]))";

inline constexpr const char* alpha_class = R"(
Alpha complex of a triangulation, read-only.

Returned by `Delaunay.alpha_complex`. len() is the number m' of its cells.

Examples
--------
>>> import delone
>>> complex = delone.Delaunay([[0, 0], [1, 0], [0, 1], [9, 9]]).alpha_complex(1)
>>> len(complex), len(complex.boundary)
(1, 3))";

inline constexpr const char* boundary = R"(
The facets that belong to exactly one of its cells, (b, k) input rows.

With a point of the interior of that cell put first they are positively oriented when k = d > 1: counterclockwise as seen from
outside in space.)";

inline constexpr const char* alpha_faces = R"(
Enumerate the faces of one dimension.

Parameters
----------
dimension : int
    The dimension, 0 to d.

Returns
-------
Faces
    The faces, in the order of `Delaunay.faces`.

Raises
------
ValueError
    If the dimension is out of range.
RuntimeError
    If points have been added to the triangulation since.)";

inline constexpr const char* circumradii = R"(
The radius of the sphere through the vertices of each cell, (m,) float64.

The relative error is certified to be at most 2^-52. Weights are ignored. Cost: O(m k^3).)";

inline constexpr const char* circumcenters = R"(
The center of the sphere through the vertices of each cell, (m, d) float64.

Each coordinate is the double nearest to the exact one. Weights are ignored. Cost: O(m k^3).)";

}  // namespace delone::python::docs::faces
