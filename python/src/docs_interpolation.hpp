// SPDX-License-Identifier: BSD-3-Clause
// Docstrings: interpolators and natural neighbors. In the form of numpydoc; text() removes the line break in
// front.
#pragma once

#include "docstring.hpp"

namespace delone::python::docs::interpolation {

inline constexpr const char* linear = R"(
Interpolation that is linear in every cell of a triangulation.

Parameters
----------
points : (n, d) array_like, pandas.DataFrame, Delaunay, Regular or FurthestSite
    The points, or their triangulation, which must not change afterwards.
values : (n, ...) array_like
    The values, real or complex. Of equal points the first value counts. NaN affects the cells of its point.
outside : {'fill', 'nearest', 'error', 'project'}
    What queries outside get, those that are neither in the convex hull of the points nor within the tolerance of it: `fill_value`; the
    value of the nearest point; an InputError that names one of them; or the value at the nearest point of the hull, which continues the
    function without a jump. For flat points the hull is that within their flat.
fill_value : number, default nan
    The value outside, for 'fill'.
tolerance : float, default 0.0
    A distance >= 0. 0 is exact. Otherwise the value is that at a point within this distance of the query, such that slivers made by
    rounding of the points do not count; see `Delaunay.find_simplex`. The value at a point is the given one in any case.

Raises
------
InputError
    If a coordinate is NaN or infinite.
ValueError
    If arrays have other shapes, an argument is out of range, or the tolerance is negative or not finite; at the first query if it is
    larger than the set of points.

See Also
--------
NaturalNeighborInterpolator : A smoother function.
delone.interpolate.LinearNDInterpolator : The interface of scipy.

Notes
-----
Which cell contains a query is decided exactly: with tolerance 0 no query inside is missed. The value in a cell is off by at most
(k+1) 2^-35 times the largest magnitude of its values, mostly by a few roundings. Cost: a walk over a few cells for each query.

Examples
--------
>>> import delone
>>> f = delone.LinearInterpolator([[0, 0], [2, 0], [0, 2]], [0, 2, 4])
>>> f([[0.5, 0.5], [3, 3]])
array([1.5, nan]))";

inline constexpr const char* gradient = R"(
Compute the gradients at queries.

Parameters
----------
queries : (..., d) array_like or pandas.DataFrame
    The queries, finite numbers.

Returns
-------
ndarray of float64 or complex128
    The gradients: the shape (...), that of one value, and (d,). Where cells meet it is the gradient of one of them. Outside it is NaN, 0
    for 'nearest', and that of the cell of the nearest point for 'project'. For flat points it is tangent to their flat.

Raises
------
InputError
    If a query is NaN or infinite, or outside with ``outside='error'``.
ValueError
    If the queries have another shape, or the tolerance is larger than the set of points.
RuntimeError
    If the triangulation has changed.)";

inline constexpr const char* call = R"(
Evaluate the interpolant at queries.

Parameters
----------
queries : (..., d) array_like or pandas.DataFrame
    The queries, finite numbers.

Returns
-------
ndarray of float64 or complex128, or a number
    The values: the shape (...), followed by that of one value.

Raises
------
InputError
    If a query is NaN or infinite, or outside with ``outside='error'``.
ValueError
    If the queries have another shape, or the tolerance is larger than the set of points.
RuntimeError
    If the triangulation has changed.)";

inline constexpr const char* natural = R"(
Natural neighbor interpolation (Sibson) in any dimension.

The value at a query is the sum of the values times its Sibson coordinates: insert the query, then the fraction of its Voronoi region
that belonged to a point before is its coordinate with respect to that point.

Parameters
----------
points : (n, d) array_like, pandas.DataFrame or Delaunay
    The points, or their triangulation, which must not change afterwards.
values : (n, ...) array_like
    The values, real or complex. Of equal points the first value counts.
outside : {'fill', 'nearest', 'error', 'project'}
    What queries outside get, those that are neither in the convex hull of the points nor within the tolerance of it: `fill_value`; the
    value of the nearest point; an InputError that names one of them; or the value at the nearest point of the hull, which continues the
    function without a jump. For flat points the hull is that within their flat.
fill_value : number, default nan
    The value outside, for 'fill'.
smooth : bool, default False
    False: continuous, exact for linear functions, and differentiable except at the points. True: Sibson's interpolant, which is
    differentiable at the points, too, with the gradients there.
gradients : (n, ..., d) array_like, optional
    The gradients at the points; with them the interpolant is smooth. By default least squares over the neighbors estimate them (n small triangulations).
tolerance : float, default 0.0
    A distance >= 0. 0 is exact. Otherwise the value is that at the point x' of `Delaunay.find_simplex` within this distance of the
    query. See Notes.

Raises
------
InputError
    If a coordinate is NaN or infinite.
ValueError
    If arrays have other shapes, an argument is out of range, or the tolerance is negative or not finite.
Error
    If `points` is a `Regular` or `FurthestSite` triangulation.

See Also
--------
natural_neighbors : The neighbors and their coordinates.

Notes
-----
No coordinate is off by more than 2^-36 in up to 3 dimensions, 2^-30 in more; mostly by 1e-15. The smooth interpolant is exact for
``a + b.x + c |x|^2`` if the gradients are; estimated ones are, inside the hull. On the boundary of the hull only points of the same face
count: that is the limit from inside. Sibson, doi:10.1017/S0305004100056589.

With a tolerance, slivers at the border that rounding of the points has made do not answer for queries in or near them. In a thick cell
x' is the query, and its coordinates are exact: at a depth like the height of a sliver, points at its far ends may be neighbors, and
gradients across the border are huge. Elsewhere x' is moved by up to 1e-9 of the way to the center of its cell, within the tolerance, so
that slivers across the border have no influence. In tilted flats, which rounding leaves, the value there is linear in each cell. The
value at a point is the given one in any case.

Cost: the centers of all cells are computed at once, d float64 each. A query in a batch takes about thirty times as long as linear
interpolation in the plane, a hundred times in space, and each further dimension more than ten times as long: milliseconds in 5. On the
boundary of the hull it takes two to four times as long as inside, and in flat input four to ten times as long as in the space of its
dimension.

Examples
--------
>>> import delone
>>> f = delone.NaturalNeighborInterpolator([[0, 0], [1, 0], [0, 1], [1, 1]], [0, 1, 2, 3])
>>> float(f([0.25, 0.5]).round(12))
1.25)";

inline constexpr const char* natural_gradient = R"(
Compute the gradients at queries.

Parameters
----------
queries : (..., d) array_like or pandas.DataFrame
    The queries, finite numbers.

Returns
-------
ndarray of float64 or complex128
    The gradients: the shape (...), that of one value, and (d,). At a point it is the given or estimated gradient. On the boundary of the hull only the part
    along the face is meaningful. Outside it is NaN, or 0 for 'nearest'.

Raises
------
InputError
    If a query is NaN or infinite, or outside with ``outside='error'``.
ValueError
    If the queries have another shape, or the tolerance is larger than the set of points.
RuntimeError
    If the triangulation has changed.)";

inline constexpr const char* neighbors = R"(
Find the natural neighbors of queries and their Sibson coordinates.

Parameters
----------
queries : (..., d) array_like or pandas.DataFrame
    The queries, finite numbers.

Returns
-------
indptr : (q+1,) ndarray of int64
    The neighbors of query i, in C order, are ``rows[indptr[i]:indptr[i+1]]``.
rows : ndarray of int
    The rows of the neighbors, increasing for each query.
weights : ndarray of float64
    Their Sibson coordinates, > 0 with sum 1 up to rounding. The query is the sum of the points times these. With a tolerance or
    ``outside='project'`` they are those of the point whose value a call gives.

Raises
------
InputError
    If a query is NaN or infinite.
ValueError
    If the queries have another shape.
RuntimeError
    If the triangulation has changed.)";

inline constexpr const char* site_gradients = R"(
The gradients at the points, given or estimated, (n, ..., d).

Without ``smooth=True`` they are estimated at each access.)";

inline constexpr const char* natural_neighbors = R"(
Find the natural neighbors of queries and their Sibson coordinates.

Parameters
----------
points : (n, d) array_like, pandas.DataFrame or Delaunay
    The points, or their triangulation.
queries : (..., d) array_like or pandas.DataFrame
    The queries, finite numbers.

Returns
-------
indptr : (q+1,) ndarray of int64
    The neighbors of query i, in C order, are ``rows[indptr[i]:indptr[i+1]]``.
rows : ndarray of int
    The rows of the neighbors, increasing for each query.
weights : ndarray of float64
    Their Sibson coordinates, > 0 with sum 1 up to rounding. The query is the sum of the points times these. At a point: that
    point. Outside the convex hull: none.

Raises
------
InputError
    If a coordinate is NaN or infinite.
ValueError
    If arrays have other shapes.
Error
    If `points` is a `Regular` or `FurthestSite` triangulation.

See Also
--------
NaturalNeighborInterpolator : Accuracy and cost; many calls for the same points.

Examples
--------
>>> import delone
>>> indptr, rows, weights = delone.natural_neighbors([[0, 0], [1, 0], [0, 1], [1, 1]], [[0.5, 0.5]])
>>> rows, weights
(array([0, 1, 2, 3], dtype=int32), array([0.25, 0.25, 0.25, 0.25])))";

}  // namespace delone::python::docs::interpolation
