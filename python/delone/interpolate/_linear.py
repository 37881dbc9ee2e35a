# SPDX-License-Identifier: BSD-3-Clause
"""scipy.interpolate.LinearNDInterpolator, on an exact triangulation."""
from __future__ import annotations

import numpy as np

import delone

from ._base import OnTriangulation


class LinearNDInterpolator(OnTriangulation):
    """Interpolation that is linear in every simplex, in two or more dimensions, with the arguments of `scipy.interpolate`.

    Parameters
    ----------
    points : (npoints, ndim) floats, a tuple of ndim arrays (npoints,), or a triangulation
        Where the values are; of equal points the first value counts. A `delone.spatial.Delaunay` or a `delone.Delaunay` is used as it
        is. Flat points are a QhullError, a flat triangulation interpolates within its flat.
    values : (npoints, ...) real or complex
    fill_value : number
        The value outside the convex hull.
    rescale : bool
        Interpolate with points scaled to a unit cube. Not with a triangulation.

    Attributes
    ----------
    tri : the triangulation
    points, values, fill_value : the (scaled) points, and (npoints, c) values, which may be assigned

    Cost: that of `delone.Delaunay`, and a walk per query.
    """

    def __init__(self, points, values, fill_value=np.nan, rescale=False):
        super().__init__(points, values, fill_value, rescale)

    def _prepare(self):
        self._function = delone.LinearInterpolator(self._tri._core, self._columns, tolerance=self._distance)

    def _evaluate(self, queries, factor):
        function = self._function
        if factor != 1:
            function = delone.LinearInterpolator(self._tri._core, self._columns, tolerance=self._distance * factor)
        result = function(queries)
        outside = self._outside(result, queries, factor, all_are=self._are_finite)
        if len(outside):
            found, weights = self._beyond(queries[outside], factor)
            result[outside] = np.einsum("qi,qic->qc", weights, self._columns[self._tri._own[0][found]])
            result[outside[found < 0]] = self._fill
        return result
