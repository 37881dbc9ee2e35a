// SPDX-License-Identifier: BSD-3-Clause
// Docstrings: delone.Polyhedron. In the form of numpydoc; text() removes the line break in front.
#pragma once

#include "docstring.hpp"

/// The arguments of all that makes a polyhedron, as a part of literals.
#define DELONE_DOC_OF_CALL_ARGUMENTS                                                                      \
  "threads : int, default 0\n"                                                                            \
  "    The most threads to use; 0: one per core if the work is large enough to gain by it.\n"             \
  "progress : bool or callable, optional\n"                                                               \
  "    True shows a progress bar. A function is called about ten times a second with the fraction done, " \
  "0 to 1;\n"                                                                                             \
  "    returning a false value other than None cancels the call.\n"                                       \
  "memory_limit : float, optional\n"                                                                      \
  "    The most bytes that the process may use during the call.\n"                                        \
  "time_limit : float, optional\n"                                                                        \
  "    The most seconds that the call may take.\n"
#define DELONE_DOC_OF_CALL_ERRORS                      \
  "CancelledError, OutOfMemoryError, TimeLimitError\n" \
  "    If the progress function cancels the call, or a limit is reached."
#define DELONE_DOC_OF_OTHER \
  "other : Polyhedron\n"    \
  "    Another one, of the same d.\n" DELONE_DOC_OF_CALL_ARGUMENTS

/// Of a method that lists rows of `found` for a row of `given`.
#define DELONE_DOC_OF_INCIDENCE(summary, name, given, found)                      \
  "\n" summary "\n\nParameters\n----------\n" name " : int\n    A row of `" given \
  "`.\n\nReturns\n-------\nndarray of int\n    Rows of `" found                   \
  "`, increasing.\n\nRaises\n------\nInputError\n    If there is no such " name "."

namespace delone::python::docs::polyhedra {

inline constexpr const char* polyhedron = R"(
Exact polyhedron in any dimension: the points x with A x <= b that satisfy the equations.

Both descriptions are there, minimal and canonical: inequalities and equations, and vertices, rays and lines. The polyhedron may
be empty, one point, flat, unbounded, contain lines, or be all of space; d may be 0. It does not change. v is the number of
vertices, r that of rays, l of lines, f of facets, e of equations; arrays are read-only.

Parameters
----------
A : (m, d) array_like, optional
    The left sides of the inequalities. Rows may be redundant, duplicate or contradictory.
b : (m,) array_like, optional
    The right sides.
equations : tuple of (p, d) array_like and (p,) array_like, optional
    The equations C x = e, a pair (C, e).
)" DELONE_DOC_OF_CALL_ARGUMENTS R"(
Raises
------
InputError
    If a number is NaN or infinite, is no rational number, or has the denominator 0; `rows` of the error names the row.
ValueError
    If an array has another shape, or an argument is missing or out of range.
)" DELONE_DOC_OF_CALL_ERRORS R"(

See Also
--------
read_polyhedron : The polyhedron of an .ine or .ext file.
polyhedra_vertices : The vertices of many small polyhedra at once.
HalfspaceIntersection : Intersections with a point inside, by insertion: faster for simple polytopes of many facets.

Notes
-----
Numbers are taken as they are: doubles, integers of any size, fractions.Fraction, decimal.Decimal, text such as "3/7" or "0.1",
objects with `as_integer_ratio`; or a pair (numerators, denominators) of arrays of integers in place of an array. The float 0.1
is not the text "0.1", and no tolerance makes up for rounding.

Results are there in three forms. `vertices`, `inequalities` and the like are float64: the exact numbers, rounded once.
`vertex_integers`, `inequality_integers`, ... are exact integers without a common divisor; of a vertex the last one is the
denominator. `vertex_fractions` are fractions.Fraction. Rows have one canonical form and order, so equal sets have equal arrays and
the same `hash`; ``==`` compares sets. With lines, "vertices" stand for the minimal faces.

Method: double description, Motzkin, Raiffa, Thompson and Thrall (1953); Fukuda and Prodon (1996), doi:10.1007/3-540-61576-8_77;
in integers of 64 bits, of 128, or of any size. Cost: for a polytope of m inequalities in R^d with v vertices on d facets each
O(d m v) at least; it grows with the intermediate polyhedra, which can have more vertices than the result. Limits, progress and
Ctrl-C end it. The result is the same for every number of `threads`.

Examples
--------
>>> import delone
>>> square = delone.Polyhedron([[1, 0], [0, 1], [-1, 0], [0, -1], [1, 1]], [1, 1, 0, 0, 5])
>>> square
<delone.Polyhedron: dimension 2, 4 vertices, 4 facets>
>>> square.vertices
array([[0., 0.],
       [0., 1.],
       [1., 0.],
       [1., 1.]])
>>> square.redundant_rows
array([4], dtype=int32)
>>> third = delone.Polyhedron([[3, 1], [-1, 0], [0, -1]], ["1", "0", "0"])
>>> third.vertex_fractions[2, 0]
Fraction(1, 3))";

inline constexpr const char* from_generators = R"(
Make the convex hull of points, plus the cone of rays and the space of lines.

Parameters
----------
vertices : (n, d) array_like, optional
    The points. Without any, and with rays or lines, the origin is one: a cone.
rays : (n, d) array_like, optional
    Directions of which all nonnegative multiples are added.
lines : (n, d) array_like, optional
    Directions of which all multiples are added.
)" DELONE_DOC_OF_CALL_ARGUMENTS R"(
Returns
-------
Polyhedron
    The polyhedron. Rows may be redundant or duplicate.

Raises
------
InputError
    If a number is NaN or infinite, is no rational number, or has the denominator 0; `rows` of the error names the row.
ValueError
    If no array is given, or one has another number of columns.
)" DELONE_DOC_OF_CALL_ERRORS R"(

Examples
--------
>>> import delone
>>> delone.Polyhedron.from_generators([[0, 0], [1, 0], [0, 1]]).inequality_integers
array([[-1,  0,  0],
       [ 0, -1,  0],
       [ 1,  1,  1]])
>>> delone.Polyhedron.from_generators(rays=[[1, 0], [1, 1]])
<delone.Polyhedron: dimension 2, 1 vertex, 2 rays, 2 facets>)";

inline constexpr const char* empty = R"(
Make the empty set.

Parameters
----------
dimension : int
    The number d >= 0 of coordinates.

Returns
-------
Polyhedron
    The empty set.

Raises
------
InputError
    If the dimension is out of range.)";

inline constexpr const char* space = R"(
Make all of space.

Parameters
----------
dimension : int
    The number d >= 0 of coordinates.

Returns
-------
Polyhedron
    R^d; a point if d is 0.

Raises
------
InputError
    If the dimension is out of range.)";

inline constexpr const char* vertices = R"(
The vertices, (v, d) float64, sorted by their coordinates.

Each coordinate is the double nearest to the exact one; infinite if it is beyond all doubles.)";

inline constexpr const char* vertex_integers = R"(
The vertices, (v, d+1) integers: numerators and their common denominator.

Without a common divisor; int64, or objects if they do not fit.)";

inline constexpr const char* rays = R"(
The directions of the rays, (r, d) float64.

The nearest doubles to `ray_integers`; a row with integers of more than 1000 bits is divided by a power of two.)";

inline constexpr const char* lines = R"(
The directions of the lines, (l, d) float64: a basis of the lineality space.

The nearest doubles to `line_integers`; a row with integers of more than 1000 bits is divided by a power of two.)";

inline constexpr const char* inequalities = R"(
The inequalities, (f, d+1) float64: rows (a, b) for a x <= b, one for each facet.

The nearest doubles to `inequality_integers`; a row with coefficients of more than 1000 bits is divided by a power of two.)";

inline constexpr const char* equations = R"(
The equations of the affine hull, (e, d+1) float64: rows (a, b) for a x = b.

The nearest doubles to `equation_integers`; a row with coefficients of more than 1000 bits is divided by a power of two. The
empty set has the equation 0 = 1.)";

inline constexpr const char* row_kinds = R"(
The kind of each row that the polyhedron was made of, (m,) uint8.

0: essential, the first row of a facet, vertex or ray; 1: a duplicate of an earlier one; 2: implicit, an inequality that holds with
equality everywhere, or a ray whose opposite is a direction, too; 3: redundant, also a row of zeros that always holds. Of inequalities, or of vertices and then rays; empty
for the results of operations.)";

inline constexpr const char* redundant_rows = R"(
The rows that are duplicate or redundant, increasing: all may be left out at once.

None for the empty set, where each row alone may be redundant.)";

inline constexpr const char* volume = R"(
The d-dimensional volume, rounded; 0 if flat or empty, infinite if unbounded.

Cost: at most that of listing all faces, at every call.)";

inline constexpr const char* bounding_box = R"(
The smallest box that contains it, (2, d) float64: lower and upper bounds.

Infinite where there is no bound; None for the empty set.)";

inline constexpr const char* integer_bounding_box = R"(
The smallest box with integer corners that contains it, (2, d): lower and upper bounds.

int64, or objects if bounds do not fit or are infinite, which are floats; None for the empty set.)";

inline constexpr const char* facets_of_vertex =
    DELONE_DOC_OF_INCIDENCE("Return the facets that a vertex lies on.", "vertex", "vertices", "inequalities");
inline constexpr const char* facets_of_ray =
    DELONE_DOC_OF_INCIDENCE("Return the facets that contain a ray.", "ray", "rays", "inequalities");
inline constexpr const char* vertices_of_facet =
    DELONE_DOC_OF_INCIDENCE("Return the vertices of a facet.", "facet", "inequalities", "vertices");
inline constexpr const char* rays_of_facet =
    DELONE_DOC_OF_INCIDENCE("Return the rays of a facet.", "facet", "inequalities", "rays");

inline constexpr const char* adjacent_vertices = R"(
Pairs of vertices that a bounded edge joins, (n, 2), increasing, the smaller one first.

Cost: O(v^2) comparisons of sets of facets, and fewer for simple polyhedra.)";

inline constexpr const char* adjacent_facets = R"(
Pairs of facets that meet in a ridge, (n, 2), increasing, the smaller one first.

A ridge is a face of dimension k-2, which has a point. Cost: as that of `adjacent_vertices`.)";

inline constexpr const char* f_vector = R"(
The numbers of faces of dimensions 0 to k-1, a tuple.

With l lines there are none of dimensions below l. Cost: that of listing all faces, at every call.)";

inline constexpr const char* contains = R"(
Whether points are in the polyhedron.

Parameters
----------
points : (..., d) array_like
    Points, of numbers of any kind but pairs of arrays.

Returns
-------
(...) ndarray of bool
    Exact answers, the boundary included; a single bool for a point (d,).

Raises
------
InputError
    If a number is NaN or infinite, or is no rational number.
ValueError
    If points have another number of coordinates.)";

inline constexpr const char* includes = R"(
Return whether each point of another polyhedron is in this one.

Parameters
----------
other : Polyhedron
    Another one, of the same d.

Returns
-------
bool
    The exact answer.

Raises
------
InputError
    If it has another dimension.)";

inline constexpr const char* maximize = R"(
Find the largest value of a linear function, and where it is attained.

Parameters
----------
c : (d,) array_like
    The coefficients.

Returns
-------
Optimum
    The value, and the face at which it is attained.

Raises
------
InputError
    If a number is NaN or infinite, or is no rational number.
ValueError
    If there is another number of coefficients.

See Also
--------
minimize : The smallest value.

Notes
-----
All vertices and rays are compared. Cost: O(d (v + r)).)";

inline constexpr const char* minimize = R"(
Find the smallest value of a linear function, and where it is attained.

Parameters
----------
c : (d,) array_like
    The coefficients.

Returns
-------
Optimum
    The value, and the face at which it is attained.

Raises
------
InputError
    If a number is NaN or infinite, or is no rational number.
ValueError
    If there is another number of coefficients.

See Also
--------
maximize : The largest value.)";

inline constexpr const char* intersection = R"(
Return the set of the points that are in both.

Parameters
----------
)" DELONE_DOC_OF_OTHER R"(
Returns
-------
Polyhedron
    The intersection.

Raises
------
InputError
    If the other one has another dimension.
)" DELONE_DOC_OF_CALL_ERRORS;

inline constexpr const char* convex_union = R"(
Return the smallest polyhedron that contains both.

Parameters
----------
)" DELONE_DOC_OF_OTHER R"(
Returns
-------
Polyhedron
    The closed convex hull of both.

Raises
------
InputError
    If the other one has another dimension.
)" DELONE_DOC_OF_CALL_ERRORS;

inline constexpr const char* minkowski_sum = R"(
Return the set of the sums of a point of each.

Parameters
----------
)" DELONE_DOC_OF_OTHER R"(
Returns
-------
Polyhedron
    The sum; empty if one of them is.

Raises
------
InputError
    If the other one has another dimension.
)" DELONE_DOC_OF_CALL_ERRORS R"(

Notes
-----
Cost: a conversion of all sums of a vertex of each.)";

inline constexpr const char* product = R"(
Return the set of the points (x, y), x of this one and y of the other.

Parameters
----------
other : Polyhedron
    Another one, of any dimension.

Returns
-------
Polyhedron
    The product, whose dimension is the sum of theirs.)";

inline constexpr const char* polar = R"(
Return the set of the points y with x y <= 1 for each point x of this one.

Parameters
----------
)" DELONE_DOC_OF_CALL_ARGUMENTS R"(
Returns
-------
Polyhedron
    The polar; all of space for the empty set.

Raises
------
)" DELONE_DOC_OF_CALL_ERRORS;

inline constexpr const char* of_intersection = R"(
Return the intersection as a `Polyhedron`: flat ones, too, have vertices, rays, lines and equations there, as exact numbers.

Parameters
----------
)" DELONE_DOC_OF_CALL_ARGUMENTS R"(
Returns
-------
Polyhedron
    The set of all halfspaces; its `row_kinds` refer to their rows.

Raises
------
)" DELONE_DOC_OF_CALL_ERRORS;

inline constexpr const char* of_hull = R"(
Return the hull as a `Polyhedron`, with its inequalities and equations as exact numbers.

Parameters
----------
)" DELONE_DOC_OF_CALL_ARGUMENTS R"(
Returns
-------
Polyhedron
    The convex hull of the extreme points; with a tolerance, of the vertices of the cells.

Raises
------
)" DELONE_DOC_OF_CALL_ERRORS;

inline constexpr const char* projection = R"(
Return the projection onto some of the coordinates.

Parameters
----------
axes : sequence of int or of bool
    The coordinates to keep, in this order; each at most once. Or d flags: whether to keep each.
)" DELONE_DOC_OF_CALL_ARGUMENTS R"(
Returns
-------
Polyhedron
    The projection, of dimension ``len(axes)``.

Raises
------
InputError
    If an axis does not exist or comes twice, or there are not d flags.
)" DELONE_DOC_OF_CALL_ERRORS;

inline constexpr const char* image = R"(
Return the set of the points M x + t, x of this one.

Parameters
----------
matrix : (n, d) array_like
    The matrix M.
translation : (n,) array_like, optional
    The vector t; 0 by default.
)" DELONE_DOC_OF_CALL_ARGUMENTS R"(
Returns
-------
Polyhedron
    The image, of dimension n.

Raises
------
InputError
    If a number is NaN or infinite, or is no rational number.
ValueError
    If the matrix or the vector has another shape.
)" DELONE_DOC_OF_CALL_ERRORS;

inline constexpr const char* preimage = R"(
Return the set of the points y for which M y + t is in this one.

Parameters
----------
matrix : (d, n) array_like
    The matrix M.
translation : (d,) array_like, optional
    The vector t; 0 by default.
)" DELONE_DOC_OF_CALL_ARGUMENTS R"(
Returns
-------
Polyhedron
    The preimage, of dimension n.

Raises
------
InputError
    If a number is NaN or infinite, or is no rational number.
ValueError
    If the matrix or the vector has another shape.
)" DELONE_DOC_OF_CALL_ERRORS;

}  // namespace delone::python::docs::polyhedra
