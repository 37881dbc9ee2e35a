// SPDX-License-Identifier: BSD-3-Clause
// Docstrings: what makes and changes triangulations. In the form of numpydoc; text() removes the line break
// in front.
#pragma once

#include "docstring.hpp"

namespace delone::python::docs::edits {

inline constexpr const char* remove = R"(
Remove rows: all of them, or none if it raises.

The result is that of the remaining rows. They keep their numbers, and removed numbers are not reused: see `has_row`, `num_rows`
and `compact_ids`. Arrays that were taken before do not change.

Parameters
----------
rows : int or array_like of int, or (num_rows,) array_like of bool
    The rows to remove.
progress : bool or callable, optional
    As for the constructor.

Raises
------
InputError
    If a row does not exist or is listed twice, or a number is NaN or infinite. The message names it.
ValueError
    If arrays have other shapes.
CancelledError, OutOfMemoryError, TimeLimitError
    If the progress function cancels the call, or a limit is reached.

Notes
-----
Removing a row that is alone at its place costs about as much as 0.7 insertions there in 2D, and up to five in 6D.

Examples
--------
>>> import delone
>>> t = delone.Delaunay([[0, 0], [2, 0], [0, 2], [0.5, 0.5]])
>>> t.remove(3)
>>> t.num_points, t.num_rows, t.num_cells
(3, 4, 1))";

inline constexpr const char* move = R"(
Move rows: all of them, or none if it raises.

Parameters
----------
rows : int or (m,) array_like of int, or (num_rows,) array_like of bool
    The rows to move.
points : (d,) or (m, d) array_like or pandas.DataFrame
    Their new coordinates.
progress : bool or callable, optional
    As for the constructor.

Raises
------
InputError
    If a row does not exist or is listed twice, or a number is NaN or infinite. The message names it.
ValueError
    If arrays have other shapes.
CancelledError, OutOfMemoryError, TimeLimitError
    If the progress function cancels the call, or a limit is reached.

Notes
-----
A small step that leaves the cells around it valid costs about as much as an insertion, any other as much as a removal and an
insertion.)";

inline constexpr const char* set_weights = R"(
Reweight rows: all of them, or none if it raises.

Parameters
----------
rows : int or (m,) array_like of int, or (num_rows,) array_like of bool
    The rows.
weights : float or (m,) array_like
    Their new weights.
progress : bool or callable, optional
    As for the constructor.

Raises
------
InputError
    If a row does not exist or is listed twice, or a number is NaN or infinite. The message names it.
ValueError
    If arrays have other shapes.
CancelledError, OutOfMemoryError, TimeLimitError
    If the progress function cancels the call, or a limit is reached.

Notes
-----
Cost: as for `move`.)";

inline constexpr const char* edit = R"(
Insert, remove and move points at once: everything, or nothing if it raises.

A row may appear at most once per list; a removed row must not appear in another list.

Parameters
----------
insert : (n, d) or (d,) array_like or pandas.DataFrame, optional
    Points to insert as the next rows.
remove : int or array_like of int, or (num_rows,) array_like of bool, optional
    Rows to remove.
move : (rows, points), optional
    Rows to move and their new coordinates, as for `move`.
progress : bool or callable, optional
    As for the constructor.

Raises
------
InputError
    If a row does not exist or is listed twice, or a number is NaN or infinite. The message names it.
ValueError
    If arrays have other shapes.
CancelledError, OutOfMemoryError, TimeLimitError
    If the progress function cancels the call, or a limit is reached.

Notes
-----
If much changes, all cells are rebuilt, by several threads.)";

inline constexpr const char* edit_regular = R"(
Insert, remove, move and reweight points at once: everything, or nothing if it raises.

A row may appear at most once per list; a removed row must not appear in another list. A row may be moved and reweighted.

Parameters
----------
insert : (n, d) or (d,) array_like or pandas.DataFrame, optional
    Points to insert as the next rows.
insert_weights : (n,) array_like, optional
    The weights of these points.
remove : int or array_like of int, or (num_rows,) array_like of bool, optional
    Rows to remove.
move : (rows, points), optional
    Rows to move and their new coordinates, as for `move`.
weights : (rows, weights), optional
    Rows to reweight and their new weights, as for `set_weights`.
progress : bool or callable, optional
    As for the constructor.

Raises
------
InputError
    If a row does not exist or is listed twice, or a number is NaN or infinite. The message names it.
ValueError
    If arrays have other shapes.
CancelledError, OutOfMemoryError, TimeLimitError
    If the progress function cancels the call, or a limit is reached.

Notes
-----
If much changes, all cells are rebuilt, by several threads.)";

inline constexpr const char* clone = R"(
Return a copy in which cells and vertices have the same ids.

The copy has the same limits, and nothing to undo. Cost: O(n d + m k).

Returns
-------
Triangulation
    The copy, of the same class.)";

inline constexpr const char* record_changes = R"(
Let `changes` tell what each insertion, edit and undo does.

A single insertion or edit then takes up to twice as long. One thread inserts the points of `insert_range`. If there are more
of them than points in the triangulation, several threads rebuild all cells instead. The record of a change is kept in memory
until the next one.

Parameters
----------
wanted : bool, default True
    Whether to record; False ends it.)";

inline constexpr const char* changes = R"(
The changes by the last insertion, edit or undo, a `Changes`, or None.

None unless `record_changes` was called. A call without any row or point does not count. The arrays are made when you
first ask for them.)";

inline constexpr const char* vertex_ids = R"(
The id of the vertex at each row, (n,), from 1; -1 if it is hidden or was removed.

A vertex keeps its id as long as a row remains at its place, even while it is hidden. Ids are not reused.)";

inline constexpr const char* record_undo = R"(
Let `undo` take back the last insertion or edit.

Until the next change a record of the last one is kept in memory, and calls take longer, as for `record_changes`. A call without
any row or point does not count. After a call that is interrupted or runs out of memory nothing can be undone.

Parameters
----------
wanted : bool, default True
    Whether to record; False ends it.)";

inline constexpr const char* undo = R"(
Take back the last insertion or edit: all arrays and ids are as before it.

An undo cannot be undone. Ctrl-C waits for its end.

Raises
------
InputError
    If `can_undo` is False.

Examples
--------
>>> import delone
>>> t = delone.Delaunay([[0, 0], [2, 0], [0, 2]])
>>> t.record_undo()
>>> t.insert_range([[0.5, 0.5]])
>>> t.undo()
>>> t.num_points
3)";

inline constexpr const char* compact_ids = R"(
Renumber rows and vertices without gaps, in their present order.

Nothing can be undone afterwards. Cost: O(m k + n).

Returns
-------
vertices : ndarray of int
    The new id of each old vertex id, or -1.
rows : ndarray of int
    The new number of each old row, or -1.)";

inline constexpr const char* has_row = R"(
Return whether rows exist.

Parameters
----------
rows : int or array_like of int, or (num_rows,) array_like of bool
    The rows.

Returns
-------
bool or ndarray of bool
    False for removed rows.

Raises
------
InputError
    If a row was never inserted.)";

inline constexpr const char* insert_range = R"(
Insert points as the next rows: all of them, or none if it raises.

Arrays that were taken before do not change; cells have other numbers.

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
    If arrays have other shapes.
CancelledError, OutOfMemoryError, TimeLimitError
    If the progress function cancels the call, or a limit is reached.

Examples
--------
>>> import delone
>>> t = delone.Delaunay([[0, 0], [2, 0], [0, 2]])
>>> t.insert_range([[2, 2]])
>>> t.num_cells
2)";

inline constexpr const char* insert_range_regular = R"(
Insert points as the next rows: all of them, or none if it raises.

Arrays that were taken before do not change; cells have other numbers.

Parameters
----------
points : (n, d) or (d,) array_like or pandas.DataFrame
    The points, or one.
weights : (n,) array_like or float
    Their weights, or that of one.
progress : bool or callable, optional
    As for the constructor.

Raises
------
InputError
    If a number is NaN or infinite.
ValueError
    If arrays have other shapes.
CancelledError, OutOfMemoryError, TimeLimitError
    If the progress function cancels the call, or a limit is reached.)";

inline constexpr const char* delaunay = R"(
Delaunay triangulation of points in any dimension.

Exact: a function of the set of points.

Parameters
----------
points : (n, d) array_like or pandas.DataFrame
    The points, finite numbers that are exact in float64, d >= 1. Duplicates are merged; flat points are triangulated in their
    flat.
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

Warns
-----
RuntimeWarning
    If the triangulation is expected to need more memory than is available, and there is no `memory_limit`, nor a `time_limit` of
    less than a minute. Only large sets are examined, for about a second.

See Also
--------
estimate : Predict the cost.
Regular : Weighted points.
delone.tiles : More points than memory holds.

Notes
-----
Method: incremental insertion with symbolic perturbation of ties; Hornus and Boissonnat, INRIA RR-6743 (2008), and Devillers and
Teillaud, doi:10.1016/j.comgeo.2010.09.010. Expected cost for evenly spread points: O(n) cells and time in each dimension; worst
case O(n^ceil(d/2)) cells.

Methods release the GIL; any number of threads may call them at once. `threads` also bounds the threads that answer queries; no
array depends on it. A copy by pickling has no limits.

Examples
--------
>>> import delone
>>> t = delone.Delaunay([[0, 0], [2, 0], [0, 2], [3, 3]])
>>> t
<delone.Delaunay: 4 points in dimension 2, 2 cells>
>>> t.find_simplex([[0.5, 0.5], [9, 9]]) >= 0
array([ True, False]))";

inline constexpr const char* regular = R"(
Regular (weighted Delaunay) triangulation of points in any dimension.

Points above the lower boundary of the lifted points ``(x, |x|^2 - weight)`` are hidden: they are not vertices. All else is as for
`Delaunay`.

Parameters
----------
points : (n, d) array_like or pandas.DataFrame
    The points, finite numbers that are exact in float64, d >= 1. Duplicates are merged; flat points are triangulated in their
    flat.
weights : (n,) array_like
    The weights, any finite numbers, in the unit of squared lengths.
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
Delaunay : Points without weights; notes on threads and cost.
PowerDiagram : The dual.

Notes
-----
Edelsbrunner and Shah, doi:10.1007/BF01975867; ties as for `Delaunay`. Each hidden point costs a walk.

Examples
--------
>>> import delone
>>> t = delone.Regular([[0, 0], [2, 0], [0, 2], [0.5, 0.5]], [0, 0, 0, -5])
>>> t.hidden
array([3], dtype=int32))";

inline constexpr const char* furthest_site = R"(
Furthest-site Delaunay triangulation of points in any dimension.

The cells have no point outside their spheres. The vertices are the extreme points; all others are hidden. All else is as for
`Delaunay`.

Parameters
----------
points : (n, d) array_like or pandas.DataFrame
    The points, finite numbers that are exact in float64, d >= 1. Duplicates are merged; flat points are triangulated in their
    flat.
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
Delaunay : Notes on threads.
Voronoi : The dual, a diagram of furthest sites.

Notes
-----
One thread builds it. Cost: that of the convex hull of the points, and a walk for each hidden point. See Aurenhammer,
doi:10.1145/116873.116880.

Examples
--------
>>> import delone
>>> delone.FurthestSite([[0, 0], [4, 0], [0, 4], [1, 1]]).hidden
array([3], dtype=int32))";

}  // namespace delone::python::docs::edits
