// SPDX-License-Identifier: BSD-3-Clause
// Docstrings: trimmed triangulations. In the form of numpydoc; text() removes the line break in front.
#pragma once

#include "docstring.hpp"

namespace delone::python::docs::trim {

inline constexpr const char* trim = R"(
Remove cells at the border that are so thin that all their points are near what remains.

The triangulation does not change.

Parameters
----------
tolerance : float
    The largest distance, >= 0, of a removed point from the remaining cells.

Returns
-------
TrimResult
    The remaining cells.

Raises
------
InputError
    If the tolerance is negative, not finite, or larger than the longest side of the bounding box.

Notes
-----
A facet is exposed if it is on the hull or the cell across it was removed. The depth of a cell is its height over its exposed
facets, away from all of them, plus the greatest depth of these: 0 on the hull, otherwise that of the cell removed there. The cell
of least depth is removed repeatedly while its depth is at most the tolerance; ties are broken by the coordinates of the vertices.
The last cell stays, and so does a cell all of whose facets are exposed. Heights are computed exactly and rounded up; the order of
the rows does not matter. Cost: O(m k d^2), and integers for thin cells at the border.

Examples
--------
>>> import delone
>>> t = delone.Delaunay([[0, 0], [1, 1e-9], [2, 0], [1, 2]])
>>> t.num_cells, len(t.trim(1e-6).cells)
(3, 2))";

inline constexpr const char* result = R"(
Result of `trim`, read-only.

m' is the number of remaining cells, m that of all cells of the triangulation.

Examples
--------
>>> import delone
>>> result = delone.Delaunay([[0, 0], [1, 1e-9], [2, 0], [1, 2]]).trim(1e-6)
>>> result.num_removed, result.orphans
(1, array([], dtype=int32)))";

}  // namespace delone::python::docs::trim
