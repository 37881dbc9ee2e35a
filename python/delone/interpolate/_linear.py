# SPDX-License-Identifier: BSD-3-Clause
"""scipy.interpolate.LinearNDInterpolator, on an exact triangulation."""
from __future__ import annotations

import numpy as np

import delone

from ._base import OnTriangulation


class LinearNDInterpolator(OnTriangulation):
    """Interpolation that is linear in every simplex, with the interface of `scipy.interpolate.LinearNDInterpolator`.

    Parameters
    ----------
    points : (npoints, ndim) array_like, tuple of (npoints,) array_like, or triangulation
        Where the values are; of equal points the first value counts. A `delone.spatial.Delaunay` or a `delone.Delaunay` is used
        as it is. A flat triangulation interpolates within its flat.
    values : (npoints, ...) array_like
        The values, real or complex.
    fill_value : number, default nan
        The value outside the convex hull.
    rescale : bool, default False
        Interpolate with points scaled to a unit cube. Not with a triangulation.

    Attributes
    ----------
    tri : delone.spatial.Delaunay or delone.Delaunay
        The triangulation.
    points : (npoints, ndim) ndarray of float64
        The (scaled) points.
    fill_value : number
        The value outside the convex hull.

    Raises
    ------
    ValueError
        If the numbers of values and points differ, or `rescale` is given with a triangulation.
    delone.spatial.QhullError
        If the points are flat or infinite.

    See Also
    --------
    delone.LinearInterpolator : The interface of delone, with gradients and other policies outside.

    Notes
    -----
    Cost: that of `delone.Delaunay`, and a walk per query.

    Examples
    --------
    >>> from delone.interpolate import LinearNDInterpolator
    >>> f = LinearNDInterpolator([[0, 0], [1, 0], [0, 1]], [0, 1, 2])
    >>> f([[0.25, 0.25], [2, 2]])
    array([0.75,  nan])
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
