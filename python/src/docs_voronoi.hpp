// SPDX-License-Identifier: BSD-3-Clause
// Docstrings: diagrams. In the form of numpydoc; text() removes the line break in front.
#pragma once

#include "docstring.hpp"

namespace delone::python::docs::voronoi {

inline constexpr const char* diagram = R"(
Common base of `Voronoi`, `PowerDiagram` and `FurthestVoronoi`.

k is the affine dimension of the points: those of a k-flat have their diagram inside the flat. v is the number of vertices, r that
of ridges. Which regions, ridges and vertices there are is exact, and then simplified by the tolerance if it is not 0. In lists of
vertices -1 stands for infinity. Index arrays are int32, and all arrays are read-only.)";

inline constexpr const char* displacement = R"(
A bound, rounded up, on the distance of an exact vertex from the one that replaced it.

Also of a vertex that was removed from straight edges from these edges. At most the tolerance; 0 if nothing was merged.)";

inline constexpr const char* axis_tolerances = R"(
How far a vertex may have moved along each axis, (d,) float64.

`tolerance` for all axes, or, if axes have tolerances of their own, those that are used: what was given, lowered by less than half
of it.)";

inline constexpr const char* vertices = R"(
The vertices, (v, d) float64: the distinct centers of the cells' spheres.

Each coordinate is the double nearest to the exact one; infinite beyond the range of doubles.)";

inline constexpr const char* ridge_vertices = R"(
The vertices of each ridge.

Those of ridge i are ``ridge_vertices[ridge_offsets[i]:ridge_offsets[i+1]]``, -1 first if it is unbounded: in cyclic order for
k = 3, counterclockwise about the direction between its sites when k = d; increasing for k > 3.)";

inline constexpr const char* region_vertices = R"(
The vertices of each region.

Those of region i are ``region_vertices[region_offsets[i]:region_offsets[i+1]]``, -1 first if it is unbounded: in cyclic order for
k = 2, counterclockwise when k = d; otherwise increasing.)";

inline constexpr const char* ridge = R"(
Return the vertices of a ridge.

Parameters
----------
i : int
    The number of the ridge.

Returns
-------
ndarray of int
    Its vertices, see `ridge_vertices`.

Raises
------
IndexError
    Unless ``0 <= i < num_ridges``.)";

inline constexpr const char* region = R"(
Return the vertices of a region.

Parameters
----------
i : int
    The number of the region.

Returns
-------
ndarray of int
    Its vertices, see `region_vertices`.

Raises
------
IndexError
    Unless ``0 <= i < num_regions``.)";

inline constexpr const char* region_volumes = R"(
Compute the volume of each region.

Parameters
----------
box : (low, high), optional
    Two arrays (d,) of finite numbers: the d-volume of the part in this box. By default the k-volume of the whole region.
at : {'regions', 'points'}
    Whether there is one volume for each region, or for each row, that of its region: rows that are equal share one, and hidden rows
    have 0, removed rows NaN.

Returns
-------
(regions,) or (n,) ndarray of float64
    The volumes; infinite for unbounded regions without a box. Rounded, with a relative error of about 1e-15 times the condition of
    the shape.

Raises
------
InputError
    If the box does not have finite limits low < high.
Error
    If a box is given and d > 12.

Notes
-----
Cost: O(output) for k <= 3; beyond, at most (k-1)! simplices for each cell and ridge; regions that the box cuts one by one.

Examples
--------
>>> import delone
>>> delone.Voronoi([[0, 0], [2, 0]]).region_volumes(([-1, -1], [3, 1]))
array([4., 4.]))";

inline constexpr const char* ridge_volumes = R"(
Compute the (k-1)-volume of each ridge.

Returns
-------
(r,) ndarray of float64
    The volumes, rounded; infinite for unbounded ridges, 1 for k = 1.)";

inline constexpr const char* bounding_box = R"(
Compute the bounding box of the sites, enlarged.

Parameters
----------
margin : float, default 0.1
    The box is enlarged on each side by this number, >= 0, times its longest side (by 1 if that is 0).

Returns
-------
low : (d,) ndarray of float64
    The lower corner.
high : (d,) ndarray of float64
    The upper corner.

Raises
------
InputError
    If the margin is negative or NaN.)";

inline constexpr const char* voronoi = R"(
Voronoi diagram of points in any dimension.

The region of each distinct point consists of the points that are not nearer to any other. Exact; regions are numbered by the first
rows of their sites.

Parameters
----------
points : (n, d) array_like, pandas.DataFrame or Delaunay
    The points, or their triangulation.
tolerance : float or (d,) array_like, default 0.0
    A distance >= 0, or one for each axis, all 0 or none: smaller vertices and ridges are left out, see Notes. 0 is exact.

Raises
------
InputError
    If a number is NaN or infinite, or the tolerance is negative, not finite, or larger than the longest side of the bounding box.
ValueError
    If the points have another shape.
TypeError
    If `points` is another triangulation.

See Also
--------
PowerDiagram : The dual of a regular triangulation.
FurthestVoronoi : The dual of a furthest-site triangulation.

Notes
-----
A tolerance, a distance >= 0, is for rounded points, whose slivers cause vertices and ridges that the unrounded points do not have.
Vertices become one of them, a representative, if each is within the tolerance of it and edges no longer than twice that connect
them (common ridges for k > 3). So there are no chains; `max_displacement` bounds how far one moved. Representatives are those of
most ridges, ties by coordinates. Bounded ridges are removed if their width is at most the tolerance, before or after that: their
length for k = 2, otherwise the least distance within which all vertices are from one of their facets (of the lines of their edges
for k = 3). For k = 3, vertices in the middle of edges that this leaves straight within the tolerance are removed, and so are
vertices in no ridge. Regions list the vertices of their ridges; a region without ridges keeps its site and lists none. Unbounded
ridges stay, unless their rays become one. All distances are upper bounds, rounding included; what is not certainly within the
tolerance stays. Volumes are those of the exact regions, so they add up as before. The order of the rows does not matter. Cost: a
pass over the ridges, and the memory of the exact diagram if anything changed.

With a tolerance for each axis no vertex moves further along an axis than that: axes are multiplied by powers of two for which the
tolerances agree but for a factor below 2, and are lowered to the least of them; distances are those after that.

The diagram owns its data, which do not change when points are added to the triangulation. Cost: a solve of k equations for each
cell, and the size of the output.

Examples
--------
>>> import delone
>>> vor = delone.Voronoi([[0, 0], [2, 0], [0, 2], [2, 2]])
>>> vor.vertices
array([[1., 1.]])
>>> vor.num_regions, vor.num_ridges
(4, 4))";

inline constexpr const char* furthest = R"(
Diagram of furthest sites of points in any dimension.

The region of each extreme point consists of the points that are not further from any other. All regions are unbounded, and
`ray_directions` point inward. The other points are hidden, and have no region.

Parameters
----------
points : (n, d) array_like, pandas.DataFrame or FurthestSite
    The points, or their triangulation.
tolerance : float or (d,) array_like, default 0.0
    A distance >= 0, or one for each axis, all 0 or none: smaller vertices and ridges are left out, see `Voronoi`. 0 is exact.

Raises
------
InputError
    If a number is NaN or infinite, or the tolerance is negative, not finite, or larger than the longest side of the bounding box.
ValueError
    If the points have another shape.
TypeError
    If `points` is another triangulation.

See Also
--------
Voronoi : The diagram of nearest sites.

Examples
--------
>>> import delone
>>> diagram = delone.FurthestVoronoi([[0, 0], [2, 0], [0, 2], [2, 2], [1, 0.5]])
>>> diagram.num_regions, bool(diagram.is_bounded.any()), int(diagram.point_region[4])
(4, False, -1))";

inline constexpr const char* power = R"(
Power diagram of weighted points in any dimension.

As `Voronoi`, with the power ``|x - p|^2 - weight`` in place of the squared distance. Hidden points have no region, and a region need
not contain its site.

Parameters
----------
points : (n, d) array_like, pandas.DataFrame or Regular
    The points, or their triangulation.
weights : (n,) array_like, optional
    The weights of points, in the unit of squared lengths.
tolerance : float or (d,) array_like, default 0.0
    A distance >= 0, or one for each axis, all 0 or none: smaller vertices and ridges are left out, as for `Voronoi`. 0 is exact.

Raises
------
InputError
    If a number is NaN or infinite, or the tolerance is negative, not finite, or larger than the longest side of the bounding box.
ValueError
    If the arrays have other shapes.
TypeError
    If `points` is another triangulation.

See Also
--------
Voronoi : The diagram without weights.

Examples
--------
>>> import delone
>>> diagram = delone.PowerDiagram([[0, 0], [4, 0]], [0, 8])
>>> diagram.region_volumes(([0, 0], [4, 1]))
array([1., 3.]))";

}  // namespace delone::python::docs::voronoi
