# SPDX-License-Identifier: BSD-3-Clause
"""Natural neighbor interpolation with the arguments of the other interpolators. scipy has none."""
from __future__ import annotations

import numpy as np

import delone

from ._base import OnTriangulation


class NaturalNeighborInterpolator(OnTriangulation):
    """Natural neighbor interpolation (Sibson), with the arguments of `LinearNDInterpolator`.

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
        Interpolate with points scaled to a unit cube, which changes the neighbors. Not with a triangulation.
    smooth : bool, default False
        Whether the interpolant is differentiable at the points, too, with estimated gradients.

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
    delone.NaturalNeighborInterpolator : The interface of delone; method and cost.

    Examples
    --------
    >>> from delone.interpolate import NaturalNeighborInterpolator
    >>> f = NaturalNeighborInterpolator([[0, 0], [1, 0], [0, 1], [1, 1]], [0, 1, 2, 3])
    >>> float(f(0.25, 0.5).round(12))
    1.25
    """

    def __init__(self, points, values, fill_value=np.nan, rescale=False, *, smooth=False):
        self._smooth = bool(smooth)
        super().__init__(points, values, fill_value, rescale)

    def _prepare(self):
        self._function = self._function_of(outside="fill", tolerance=self._distance)

    def _function_of(self, gradients=None, **options):
        return delone.NaturalNeighborInterpolator(self._tri._core, self._columns, smooth=self._smooth, gradients=gradients, **options)

    def _evaluate(self, queries, factor):
        function, known = self._function, self._function.site_gradients if self._smooth and factor != 1 else None
        if factor != 1:
            function = self._function_of(known, tolerance=self._distance * factor)
        result = function(queries)
        outside = self._outside(result, queries, factor)
        if len(outside):
            is_near = self._beyond(queries[outside], factor)[0] >= 0
            result[outside] = self._fill
            if is_near.any():  # the value at the nearest point of the hull
                known = self._function.site_gradients if self._smooth else None
                result[outside[is_near]] = self._function_of(known, outside="project")(queries[outside[is_near]])
        return result

    def gradient(self, *args) -> np.ndarray:
        """Compute the gradients at queries.

        Parameters
        ----------
        *args : (..., ndim) array_like, or ndim array_like
            The queries: one array, or ndim arrays of coordinates that broadcast against each other.

        Returns
        -------
        ndarray
            The gradients: the shape of the queries, that of one value, and (ndim,). NaN outside.

        Raises
        ------
        RuntimeError
            If points were added to the triangulation since.
        ValueError
            If queries have another number of coordinates.

        See Also
        --------
        delone.NaturalNeighborInterpolator.gradient : What the gradient is at points and on the boundary.
        """
        self._require_unchanged()
        queries, shape = self._queries(args)
        finite = np.isfinite(queries).all(axis=1)
        found = np.full((len(queries), *self._columns.shape[1:], queries.shape[1]), np.nan)
        found[finite] = self._function.gradient(queries[finite])
        if self.scale is not None:
            found /= self.scale
        if self.is_complex:
            found = found[:, 0::2] + 1j * found[:, 1::2]
        return found.reshape(shape + self.values_shape + (queries.shape[1],))
