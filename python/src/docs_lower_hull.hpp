// SPDX-License-Identifier: BSD-3-Clause
// Docstrings: delone.LowerHull. In the form of numpydoc; text() removes the line break in front.
#pragma once

#include "docstring.hpp"

namespace delone::python::docs::lower_hull {

inline constexpr const char* hull = R"(
Lower or upper part of a convex hull with respect to the last coordinate.

The convex envelope of heights over compositions, as in phase diagrams. The first d-1 coordinates of a point are its composition,
the last one is its height, such as an energy. The hull consists of m simplices of c+1 points, the cells, where c is the affine
dimension of the compositions. Seen along the last axis they triangulate the domain, the hull of the compositions.

Parameters
----------
points : (n, d) array_like or pandas.DataFrame
    The points, finite numbers that are exact in float64, d >= 2. Duplicates, flat compositions and points above the hull are allowed.
side : {'lower', 'upper'}
    Which part.
tolerance : float, default 0.0
    The largest height, >= 0 in the unit of the last coordinate, of a point below the lower hull; 0 is exact. See Notes.
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
ConvexHull : The whole hull.

Notes
-----
Exact for all finite doubles. Immutable; methods release the GIL. With a tolerance the hull is the exact lower hull of some of the
points over the same domain, such that no point is farther below it along the last axis; no vertex can be omitted. ValueError if the
tolerance is negative, not finite, or larger than the range of the heights. Cost: that of a convex hull of n+1 points.

Examples
--------
>>> import delone
>>> hull = delone.LowerHull([[0.0, 0], [0.4, 1], [0.5, -1], [1, 0]])
>>> hull.vertices
array([0, 2, 3], dtype=int32)
>>> hull.height_above([[0.4, 1]])
array([1.8]))";

inline constexpr const char* find_simplex = R"(
Find the cell whose domain contains each composition, exactly.

Parameters
----------
compositions : (..., d-1) array_like or pandas.DataFrame
    The compositions, finite numbers.

Returns
-------
(...) ndarray of int, or int
    The cells; -1 outside the domain.

Raises
------
InputError
    If a number is NaN or infinite.
ValueError
    If the queries have another shape.

Notes
-----
Cost: a walk over cells for each query.)";

inline constexpr const char* heights = R"(
Compute the height of the hull over each composition.

Parameters
----------
compositions : (..., d-1) array_like or pandas.DataFrame
    The compositions, finite numbers.

Returns
-------
(...) ndarray of float64, or float
    The heights, off by no more than a rounding and 2^-36 of the range of the heights of the smallest face there. Outside the domain
    inf (-inf for an upper hull).

Raises
------
InputError
    If a number is NaN or infinite.
ValueError
    If the queries have another shape.

Notes
-----
Cost: a walk over cells for each query.)";

inline constexpr const char* height_above = R"(
Compute the height of each point above the hull along the last axis ("energy above hull").

Parameters
----------
points : (..., d) array_like or pandas.DataFrame
    The points, finite numbers.
tolerance : float, default 0.0
    Heights of a magnitude up to this are 0, decided exactly.

Returns
-------
(...) ndarray of float64, or float
    The heights. The sign is exact: 0 only for points exactly on the hull, negative below it. The magnitude is off by no more than a
    relative 2^-36. Outside the domain -inf (inf for an upper hull).

Raises
------
InputError
    If a number is NaN or infinite.
ValueError
    If the queries have another shape, or the tolerance is negative or not finite.

Notes
-----
Cost: a walk over cells for each query.)";

}  // namespace delone::python::docs::lower_hull
