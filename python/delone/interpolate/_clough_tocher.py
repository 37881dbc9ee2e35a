# SPDX-License-Identifier: BSD-3-Clause
"""scipy.interpolate.CloughTocher2DInterpolator, on an exact triangulation."""
from __future__ import annotations

import warnings

import numpy as np

from delone import _core

from ._base import GradientEstimationWarning, OnTriangulation


class CloughTocher2DInterpolator(OnTriangulation):
    """Smooth interpolation in the plane, with the interface of `scipy.interpolate.CloughTocher2DInterpolator`.

    Cubic on the thirds of every triangle, with continuous gradients, and least curvature along the edges.

    Parameters
    ----------
    points : (npoints, 2) array_like, tuple of (npoints,) array_like, or triangulation
        Where the values are; of equal points the first value counts. A `delone.spatial.Delaunay` or a `delone.Delaunay` is used
        as it is.
    values : (npoints, ...) array_like
        The values, real or complex.
    fill_value : number, default nan
        The value outside the convex hull.
    tol : float, default 1e-6
        The gradients at the points are relaxed until none changes by more than this, relative to those above 1.
    maxiter : int, default 400
        The most rounds of relaxation; after that a GradientEstimationWarning.
    rescale : bool, default False
        Interpolate with points scaled to a unit square. Not with a triangulation.

    Attributes
    ----------
    tri : delone.spatial.Delaunay or delone.Delaunay
        The triangulation.
    points : (npoints, ndim) ndarray of float64
        The (scaled) points.
    fill_value : number
        The value outside the convex hull.
    grad : (npoints, c, 2) ndarray
        The gradients at the (scaled) points, two numbers for each of the c numbers of a value; 0 at points that repeat earlier ones.

    Raises
    ------
    ValueError
        If the numbers of values and points differ, or `rescale` is given with a triangulation.
    delone.spatial.QhullError
        If the points are flat or infinite.

    Notes
    -----
    Method: P. Alfeld, doi:10.1016/0167-8396(84)90029-3; G. Farin, doi:10.1016/0167-8396(86)90016-6; gradients by G. M. Nielson,
    doi:10.1090/S0025-5718-1983-0679444-7, and R. J. Renka and A. K. Cline, doi:10.1216/RMJ-1984-14-1-223; in the variant of
    scipy. Cost: that of `delone.Delaunay`, O(npoints) per round of relaxation and value, and a walk per query. The order of the
    points matters within `tol`.

    Examples
    --------
    >>> from delone.interpolate import CloughTocher2DInterpolator
    >>> f = CloughTocher2DInterpolator([[0, 0], [1, 0], [0, 1], [1, 1]], [0, 1, 1, 2])
    >>> float(f(0.25, 0.5).round(4))
    0.75
    """

    def __init__(self, points, values, fill_value=np.nan, tol=1e-6, maxiter=400, rescale=False):
        self._tol, self._maxiter = float(tol), int(maxiter)
        super().__init__(points, values, fill_value, rescale)

    def _prepare(self):
        if self.points.shape[1] != 2:
            raise ValueError("this mode of interpolation available only for 2-D data")
        if self._tri.affine_dimension != 2:
            raise ValueError("points: a triangulation of a line has no gradients in the plane")
        gradients, converged = _core._least_curvature_gradients(self.points, *self._tri._core.vertex_neighbors, self._columns, self._tol,
                                                                self._maxiter)
        if not converged:
            warnings.warn("Gradient estimation did not converge, the results may be inaccurate", GradientEstimationWarning, stacklevel=4)
        self._gradients = gradients
        parts = gradients.reshape(len(gradients), -1, 2, 2) if self.is_complex else gradients
        self.grad = parts[:, :, 0] + 1j * parts[:, :, 1] if self.is_complex else gradients

    def gradient(self, *args) -> np.ndarray:
        """Compute the gradients at queries.

        Parameters
        ----------
        *args : (..., 2) array_like, or 2 array_like
            The queries: one array, or 2 arrays of coordinates that broadcast against each other.

        Returns
        -------
        ndarray
            The gradients: the shape of the queries, that of one value, and (2,). NaN outside.

        Raises
        ------
        RuntimeError
            If points were added to the triangulation since.
        ValueError
            If queries have another number of coordinates.

        Notes
        -----
        They are the derivatives of what a call gives, and continuous; at the points they are `grad`, or with `rescale` `grad` divided by the
        scale. In a thin triangle their rounding errors are larger than those of the values, by the ratio of its length to the height.

        Examples
        --------
        >>> from delone.interpolate import CloughTocher2DInterpolator
        >>> f = CloughTocher2DInterpolator([[0, 0], [1, 0], [0, 1], [1, 1]], [0, 2, 3, 5])
        >>> f.gradient(0.25, 0.5).round(4)
        array([2., 3.])
        """
        self._require_unchanged()
        queries, shape = self._queries(args)
        finite = np.isfinite(queries).all(axis=1)
        found = np.full((len(queries), self._columns.shape[1], 2), np.nan)
        found[finite] = self._cubics(queries[finite], 1.0, np.full(2 * self._columns.shape[1], np.nan), True).reshape(-1, *found.shape[1:])
        if self.scale is not None:
            found /= self.scale
        if self.is_complex:
            found = found[:, 0::2] + 1j * found[:, 1::2]
        return found.reshape(shape + self.values_shape + (2,))

    def _evaluate(self, queries, factor):
        return self._cubics(queries, factor, self._fill, False)

    def _cubics(self, queries, factor, fill, wants_gradients):
        """The values at queries, or the gradients there; `fill` outside."""
        core = self._tri._core
        found, weights = core.barycentric(queries, tolerance=self._distance * factor)
        outside = np.flatnonzero(found < 0)
        if len(outside):
            found, weights = np.array(found), np.array(weights)
            found[outside], weights[outside] = self._beyond(queries[outside], factor)
        return _core._clough_tocher(self.points, core.cells, core.neighbors, self._columns, self._gradients, found, weights, fill,
                                    wants_gradients)
