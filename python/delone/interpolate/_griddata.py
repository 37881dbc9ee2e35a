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
    """Interpolate scattered values once, with the interface of `scipy.interpolate.griddata`.

    Parameters
    ----------
    points : (npoints, ndim) array_like, or tuple of (npoints,) array_like
        Where the values are.
    values : (npoints, ...) array_like
        The values, real or complex.
    xi : (..., ndim) array_like, or tuple of array_like
        The queries: one array, or ndim arrays of coordinates that broadcast against each other.
    method : {'nearest', 'linear', 'cubic'}
        `NearestNDInterpolator`, `LinearNDInterpolator`, or in the plane `CloughTocher2DInterpolator`. In one dimension scipy's
        interp1d.
    fill_value : number, default nan
        The value outside the convex hull; without effect for 'nearest'.
    rescale : bool, default False
        Interpolate with points scaled to a unit cube.
    simplex_tolerance : float, default 1.0
        Factor of the tolerances, see `LinearNDInterpolator`.

    Returns
    -------
    ndarray
        The values: the shape of the queries, followed by that of one value.

    Raises
    ------
    ValueError
        If there is no such method for this dimension.
    delone.spatial.QhullError
        If the points are flat.
    ImportError
        If scipy is needed (one dimension) and missing.

    Examples
    --------
    >>> from delone.interpolate import griddata
    >>> griddata([[0, 0], [1, 0], [0, 1]], [0, 1, 2], [[0.25, 0.25], [2, 2]])
    array([0.75,  nan])
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
