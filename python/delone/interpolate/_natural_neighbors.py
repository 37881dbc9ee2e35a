# SPDX-License-Identifier: BSD-3-Clause
"""Natural neighbor interpolation with the arguments of the other interpolators. scipy has none."""
from __future__ import annotations

import numpy as np

import delone

from ._base import OnTriangulation


class NaturalNeighborInterpolator(OnTriangulation):
    """Natural neighbor interpolation (Sibson) in two or more dimensions, with the arguments of `LinearNDInterpolator`.

    Parameters
    ----------
    points : (npoints, ndim) floats, a tuple of ndim arrays (npoints,), or a triangulation
        Where the values are; of equal points the first value counts. A `delone.spatial.Delaunay` or a `delone.Delaunay` is used as it
        is. Flat points are a QhullError, a flat triangulation interpolates within its flat.
    values : (npoints, ...) real or complex
    fill_value : number
        The value outside the convex hull.
    rescale : bool
        Interpolate with points scaled to a unit cube, which changes who is a neighbor. Not with a triangulation.
    smooth : bool
        Differentiable at the points, too, with estimated gradients; otherwise differentiable elsewhere.

    Attributes
    ----------
    tri : the triangulation
    points, values, fill_value : the (scaled) points, and (npoints, c) values, which may be assigned

    Method and cost: see `delone.NaturalNeighborInterpolator`.
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
        """The gradients at queries, given as for a call: their shape, followed by that of one value and (ndim,). NaN outside; see
        `delone.NaturalNeighborInterpolator.gradient`."""
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
