# SPDX-License-Identifier: BSD-3-Clause
"""scipy.interpolate.griddata, on exact triangulations."""
from __future__ import annotations

import numpy as np

from delone import _core

from ._base import coordinates
from ._clough_tocher import CloughTocher2DInterpolator
from ._linear import LinearNDInterpolator
from ._nearest import NearestNDInterpolator


def griddata(points, values, xi, method="linear", fill_value=np.nan, rescale=False, simplex_tolerance=1.0):
    """Interpolates scattered values once, with the arguments of `scipy.interpolate.griddata`.

    points : (npoints, ndim) floats, or a tuple of ndim arrays (npoints,)
    values : (npoints, ...) real or complex
    xi : (…, ndim) queries, or a tuple of ndim arrays that broadcast against each other
    method : "nearest", "linear", or, in the plane, "cubic"; see `NearestNDInterpolator`, `LinearNDInterpolator` and
        `CloughTocher2DInterpolator`. In one dimension scipy's interp1d is called, with an ImportError where scipy is missing.
    fill_value : the value outside the convex hull; without effect for "nearest"
    rescale : interpolate with points scaled to a unit cube
    simplex_tolerance : see `LinearNDInterpolator.__call__`

    ValueError for other methods; QhullError for flat points.
    """
    if not simplex_tolerance > 0:
        raise ValueError("simplex_tolerance must be positive")
    points = coordinates(points)
    ndim = points.shape[-1]
    if ndim == 1 and method in ("nearest", "linear", "cubic"):
        return _on_line(points.ravel(), np.asarray(values), xi, method, fill_value)
    if method == "nearest":
        return NearestNDInterpolator(points, values, rescale=rescale)(xi)
    if method == "linear":
        return LinearNDInterpolator(points, values, fill_value, rescale)(xi, simplex_tolerance=simplex_tolerance)
    if method == "cubic" and ndim == 2:
        return CloughTocher2DInterpolator(points, values, fill_value, rescale=rescale)(xi, simplex_tolerance=simplex_tolerance)
    raise ValueError(f"Unknown interpolation method {_core._represented(method)} for {ndim} dimensional data")


def _on_line(points, values, xi, method, fill_value):
    try:
        from scipy.interpolate import interp1d
    except ImportError as error:
        raise ImportError(f"griddata in one dimension calls scipy.interpolate.interp1d, which cannot be imported: {error}") from error
    if isinstance(xi, tuple):
        if len(xi) != 1:
            raise ValueError("invalid number of dimensions in xi")
        xi, = xi
    order = np.argsort(points)
    fill_value = "extrapolate" if method == "nearest" else fill_value
    return interp1d(points[order], values[order], kind=method, axis=0, bounds_error=False, fill_value=fill_value)(xi)
